# Helpers for nvm's own targets; nothing here reaches a user's targets.

# gcc's -Wconversion leaves changes of sign out, GoogleTest's macros take no arguments, and points like PCL's are unions with
# structs that have no name. A unity build puts the constants of one file above the functions of the next.
set(nvm_clang_silences -Wno-sign-conversion -Wno-gnu-zero-variadic-macro-arguments -Wno-nested-anon-types)
add_library(nvm_warnings INTERFACE)
target_compile_options(
  nvm_warnings INTERFACE -Wall -Wextra -Wpedantic -Wconversion -Wshadow
                         "$<$<CXX_COMPILER_ID:Clang,AppleClang>:${nvm_clang_silences}>"
                         $<$<BOOL:${CMAKE_UNITY_BUILD}>:-Wno-shadow>
                         $<$<BOOL:${NVM_WARNINGS_AS_ERRORS}>:-Werror>)

# nvm_add_component(NAME sources...): a compiled part of nvm, src/NAME, as target nvm_NAME and nvm::NAME.
function(nvm_add_component name)
  add_library(nvm_${name} STATIC ${ARGN})
  add_library(nvm::${name} ALIAS nvm_${name})
  set_target_properties(nvm_${name} PROPERTIES EXPORT_NAME ${name})
  target_include_directories(
    nvm_${name} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/src>
                       $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/nvm/components>)
  target_link_libraries(nvm_${name} PUBLIC nvm::nvm PRIVATE $<BUILD_INTERFACE:nvm_warnings>)
  set_property(GLOBAL APPEND PROPERTY NVM_COMPONENTS ${name})
endfunction()

# nvm_add_test(NAME SOURCES files... THREADED files... LIBRARIES targets...): one GoogleTest program, each TEST a ctest.
# THREADED are those of its sources that use several threads, the only ones that ThreadSanitizer has something to say of:
# NVM_TEST_THREADS_ONLY makes tests of no others, and target nvm_thread_tests builds them.
option(NVM_TEST_THREADS_ONLY "Make only the tests that use several threads" OFF)
add_custom_target(nvm_thread_tests)
function(nvm_add_test name)
  cmake_parse_arguments(arg "" "" "SOURCES;THREADED;LIBRARIES;LABELS" ${ARGN})
  if(NVM_TEST_THREADS_ONLY AND arg_THREADED)
    set(arg_SOURCES "")
  endif()
  add_executable(${name} ${arg_SOURCES} ${arg_THREADED})
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR}/tests)
  target_compile_definitions(${name} PRIVATE NVM_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
  target_link_libraries(${name} PRIVATE nvm::nvm nvm_warnings GTest::gmock_main ${arg_LIBRARIES})
  if(arg_THREADED)
    add_dependencies(nvm_thread_tests ${name})
  endif()
  if(arg_THREADED OR NOT NVM_TEST_THREADS_ONLY)
    gtest_discover_tests(${name} DISCOVERY_TIMEOUT 60 PROPERTIES LABELS "${arg_LABELS}")
  endif()
endfunction()

# nvm_lint_headers(NAME ROOT FOLDERS folders... CHECKS checks): every header of the folders through clang-tidy
# (CMAKE_CXX_CLANG_TIDY), which else sees only those that some source file includes. CHECKS are added to .clang-tidy's.
function(nvm_lint_headers name root)
  cmake_parse_arguments(arg "" "CHECKS" "FOLDERS" ${ARGN})
  list(TRANSFORM arg_FOLDERS APPEND "/*.hpp" OUTPUT_VARIABLE patterns)
  list(TRANSFORM patterns PREPEND "${root}/")
  file(GLOB_RECURSE headers CONFIGURE_DEPENDS RELATIVE ${root} ${patterns})
  list(TRANSFORM headers REPLACE "(.+)" "#include \"\\1\"\n")
  list(JOIN headers "" content)
  set(source ${PROJECT_BINARY_DIR}/${name}.cpp)
  file(CONFIGURE OUTPUT ${source} CONTENT "${content}" @ONLY)
  add_library(${name} OBJECT ${source})
  target_include_directories(${name} PRIVATE ${root})
  target_link_libraries(${name} PRIVATE nvm::nvm nvm_warnings OpenMP::OpenMP_CXX TBB::tbb)
  # The generated file lies where no .clang-tidy is found.
  set(lint ${CMAKE_CXX_CLANG_TIDY} --config-file=${PROJECT_SOURCE_DIR}/.clang-tidy "--checks=${arg_CHECKS}")
  set_target_properties(${name} PROPERTIES CXX_CLANG_TIDY "${lint}")
endfunction()
