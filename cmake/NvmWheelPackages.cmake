# C++ libraries that come as Python wheels (build-system.requires of pyproject.toml), where pip builds the package. Links to
# them lie in the build folder: pip puts them into a new folder each time, which would make the compiler's cache and the
# build folder useless.

find_package(Python 3.10 COMPONENTS Interpreter Development.Module OPTIONAL_COMPONENTS Development.SABIModule)
if(NOT Python_FOUND)
  message(FATAL_ERROR "nvm needs Python 3.10 or later with its headers, on Debian and Ubuntu: apt install python3-dev")
endif()

# nvm_use_wheel_package(NAME FILE): finds what the wheel NAME brings, from the folder two above its FILE.
function(nvm_use_wheel_package name file)
  execute_process(
    COMMAND
      ${Python_EXECUTABLE} -c "
from importlib.metadata import distribution
found = next(f for f in distribution('${name}').files if f.match('${file}'))
print(found.locate().resolve().parent)"
    OUTPUT_VARIABLE folder
    OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET
    RESULT_VARIABLE failed)
  if(failed)
    return()
  endif()
  string(REGEX REPLACE "/(lib/cmake|share|include)/[^/]+(/cmake)?$" "" prefix ${folder})
  set(link ${PROJECT_BINARY_DIR}/wheels/${name})
  file(MAKE_DIRECTORY ${PROJECT_BINARY_DIR}/wheels)
  file(REMOVE ${link})
  file(CREATE_LINK ${prefix} ${link} SYMBOLIC)
  list(PREPEND CMAKE_PREFIX_PATH ${link})
  set(CMAKE_PREFIX_PATH ${CMAKE_PREFIX_PATH} PARENT_SCOPE)
endfunction()

# nvm_use_headers(PACKAGE FOLDER): headers that come without a CMake package, as find_package(PACKAGE) gives them elsewhere.
function(nvm_use_headers package folder)
  set(config_dir ${PROJECT_BINARY_DIR}/wheels/cmake)
  file(
    CONFIGURE
    OUTPUT ${config_dir}/${package}Config.cmake
    CONTENT "
if(NOT TARGET ${package}::${package})
  add_library(${package}::${package} INTERFACE IMPORTED)
  set_target_properties(${package}::${package} PROPERTIES INTERFACE_INCLUDE_DIRECTORIES \"${folder}\")
endif()"
    @ONLY)
  file(CONFIGURE OUTPUT ${config_dir}/${package}ConfigVersion.cmake CONTENT "set(PACKAGE_VERSION_COMPATIBLE TRUE)" @ONLY)
  set(${package}_DIR ${config_dir} PARENT_SCOPE)
endfunction()

# nvm_use_embree(LIBRARY): Embree's library, which its Python bindings bring without headers, as find_package(embree).
function(nvm_use_embree library)
  set(config_dir ${PROJECT_BINARY_DIR}/wheels/cmake)
  file(
    CONFIGURE
    OUTPUT ${config_dir}/embreeConfig.cmake
    CONTENT "
set(EMBREE_VERSION_MAJOR 4)
if(NOT TARGET embree)
  add_library(embree SHARED IMPORTED)
  set_target_properties(embree PROPERTIES IMPORTED_LOCATION \"${library}\"
                                          INTERFACE_INCLUDE_DIRECTORIES \"${PROJECT_SOURCE_DIR}/third_party/include\")
endif()"
    @ONLY)
  set(embree_DIR ${config_dir} PARENT_SCOPE)
endfunction()

nvm_use_wheel_package(cmeel-assimp "assimpConfig.cmake")
nvm_use_wheel_package(cmeel-eigen "Eigen3Config.cmake")
nvm_use_wheel_package(cmeel-fmt "fmt-config.cmake")
nvm_use_wheel_package(cmeel-yaml-cpp "yaml-cpp-config.cmake")
nvm_use_wheel_package(embreex "libembree4*")
nvm_use_wheel_package(nlohmann-json "nlohmann/json.hpp")
nvm_use_wheel_package(tbb-devel "TBBConfig.cmake")
if(EXISTS ${PROJECT_BINARY_DIR}/wheels/nlohmann-json)
  nvm_use_headers(nlohmann_json ${PROJECT_BINARY_DIR}/wheels/nlohmann-json/include)
endif()
file(GLOB embree_library ${PROJECT_BINARY_DIR}/wheels/embreex/libembree4*)
if(embree_library)
  nvm_use_embree(${embree_library})
endif()
nvm_use_headers(CLI11 ${PROJECT_SOURCE_DIR}/third_party/include)
nvm_use_headers(nanoflann ${PROJECT_SOURCE_DIR}/third_party/include)

find_package(TBB REQUIRED)
if(EXISTS ${PROJECT_BINARY_DIR}/wheels/tbb-devel) # TBBConfig.cmake names the folder behind the link
  set_target_properties(TBB::tbb PROPERTIES INTERFACE_INCLUDE_DIRECTORIES ${PROJECT_BINARY_DIR}/wheels/tbb-devel/include)
endif()

# The simulator, wherever there are wheels for it.
find_package(assimp QUIET)
find_package(embree QUIET)
if(NOT assimp_FOUND OR NOT embree_FOUND)
  list(REMOVE_ITEM NVM_COMPONENTS sim)
elseif(EXISTS ${PROJECT_BINARY_DIR}/wheels/cmeel-assimp) # its config asks for zlib, which only its library needs
  set_target_properties(assimp::assimp PROPERTIES INTERFACE_LINK_LIBRARIES "")
endif()

# Debian's yaml-cpp 0.7 has the short name only, 0.8 the long one.
find_package(yaml-cpp REQUIRED)
if(NOT TARGET yaml-cpp)
  add_library(yaml-cpp INTERFACE IMPORTED)
  target_link_libraries(yaml-cpp INTERFACE yaml-cpp::yaml-cpp)
endif()

execute_process(
  COMMAND ${Python_EXECUTABLE} -m nanobind --cmake_dir
  OUTPUT_VARIABLE nanobind_hints
  OUTPUT_STRIP_TRAILING_WHITESPACE)
