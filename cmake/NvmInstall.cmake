# Install rules, the CMake package with its components, nvm.pc and the Debian packages.

include(CMakePackageConfigHelpers)

set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME dev)
set(nvm_package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/nvm)
set(nvm_generated_dir ${PROJECT_BINARY_DIR}/package)
get_property(nvm_compiled GLOBAL PROPERTY NVM_COMPONENTS)
get_property(nvm_adapters GLOBAL PROPERTY NVM_ADAPTERS)
list(JOIN nvm_compiled " " nvm_component_names)
list(JOIN nvm_adapters " " nvm_adapter_names)

install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/nvm DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(TARGETS nvm EXPORT nvm-targets)
install(EXPORT nvm-targets NAMESPACE nvm:: DESTINATION ${nvm_package_dir})

# nvm_component_needs(NAME components_variable packages_variable): what a component links to,
# read from its target, so that the package never names a dependency that the build does not.
function(nvm_component_needs name components_variable packages_variable)
  set(libraries "")
  foreach(property LINK_LIBRARIES INTERFACE_LINK_LIBRARIES)
    get_target_property(values nvm_${name} ${property})
    list(APPEND libraries ${values})
  endforeach()
  list(FILTER libraries EXCLUDE REGEX "(^nvm::nvm|NOTFOUND|>)$|^[-/$]")
  list(REMOVE_DUPLICATES libraries)
  set(components ${libraries})
  list(FILTER components INCLUDE REGEX "^nvm::")
  list(TRANSFORM components REPLACE "^nvm::" "")
  set(packages ${libraries})
  list(FILTER packages EXCLUDE REGEX "^nvm::")
  list(TRANSFORM packages REPLACE "::.*" "")
  list(REMOVE_DUPLICATES packages)
  set(${components_variable} ${components} PARENT_SCOPE)
  set(${packages_variable} ${packages} PARENT_SCOPE)
endfunction()

# nvm_install_component(NAME): the target nvm_NAME as what find_package(nvm COMPONENTS NAME) gives.
function(nvm_install_component component)
  nvm_component_needs(${component} needed_components needed_packages)
  configure_file(${PROJECT_SOURCE_DIR}/cmake/nvm-component.cmake.in
                 ${nvm_generated_dir}/nvm-component-${component}.cmake @ONLY)
  install(FILES ${nvm_generated_dir}/nvm-component-${component}.cmake DESTINATION ${nvm_package_dir})
  install(TARGETS nvm_${component} EXPORT nvm-component-${component}-targets)
  install(EXPORT nvm-component-${component}-targets NAMESPACE nvm:: DESTINATION ${nvm_package_dir})
endfunction()

set(nvm_component_headers ${CMAKE_INSTALL_INCLUDEDIR}/nvm/components)
foreach(component IN LISTS nvm_compiled)
  nvm_install_component(${component})
endforeach()
foreach(room IN LISTS nvm_compiled ITEMS common) # common is headers alone
  install(
    DIRECTORY ${PROJECT_SOURCE_DIR}/src/${room}
    DESTINATION ${nvm_component_headers}
    FILES_MATCHING PATTERN "*.hpp")
endforeach()
foreach(adapter IN LISTS nvm_adapters)
  nvm_install_component(${adapter})
endforeach()
install(
  DIRECTORY ${PROJECT_SOURCE_DIR}/adapters
  DESTINATION ${nvm_component_headers}
  FILES_MATCHING PATTERN "*.hpp" PATTERN "*.h")

if(TARGET nvm_program)
  install(TARGETS nvm_program COMPONENT tools)
  install(FILES ${PROJECT_SOURCE_DIR}/docs/nvm.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT tools)
  install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/nvm-tools
          RENAME copyright COMPONENT tools)
endif()

configure_package_config_file(
  ${PROJECT_SOURCE_DIR}/cmake/nvm-config.cmake.in ${nvm_generated_dir}/nvm-config.cmake
  INSTALL_DESTINATION ${nvm_package_dir} NO_SET_AND_CHECK_MACRO NO_CHECK_REQUIRED_COMPONENTS_MACRO)
# While the major version is 0, each minor version may change the interface.
write_basic_package_version_file(
  ${nvm_generated_dir}/nvm-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${nvm_generated_dir}/nvm-config.cmake ${nvm_generated_dir}/nvm-config-version.cmake
        DESTINATION ${nvm_package_dir})

configure_file(${PROJECT_SOURCE_DIR}/cmake/nvm.pc.in ${nvm_generated_dir}/nvm.pc @ONLY)
install(FILES ${nvm_generated_dir}/nvm.pc DESTINATION ${CMAKE_INSTALL_DATADIR}/pkgconfig)
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/libnvm-dev
        RENAME copyright)

# `cpack -G DEB --config build/release/CPackConfig.cmake`: libnvm-dev, and nvm-tools where the program is built.
set(CPACK_PACKAGE_CONTACT "The nvm authors <nvm@users.noreply.github.com>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY ${PROJECT_DESCRIPTION})
set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_ALL dev)
if(TARGET nvm_program)
  list(APPEND CPACK_COMPONENTS_ALL tools)
else()
  set(CPACK_DEBIAN_DEV_PACKAGE_ARCHITECTURE all)
endif()
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_DEV_PACKAGE_NAME libnvm-dev)
set(CPACK_DEBIAN_DEV_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEV_PACKAGE_DEPENDS "libeigen3-dev (>= 3.3), libnanoflann-dev (>= 1.4)")
# What the compiled components are linked with; the core needs none of it.
set(CPACK_DEBIAN_DEV_PACKAGE_SUGGESTS
    "libassimp-dev, libbz2-dev, libembree-dev, libfmt-dev, liblz4-dev, librosbag-storage-dev, libtbb-dev, libyaml-cpp-dev, nlohmann-json3-dev")
set(CPACK_DEBIAN_TOOLS_PACKAGE_NAME nvm-tools)
set(CPACK_DEBIAN_TOOLS_PACKAGE_SECTION science)
set(CPACK_DEBIAN_TOOLS_PACKAGE_SHLIBDEPS ON)
include(CPack)
