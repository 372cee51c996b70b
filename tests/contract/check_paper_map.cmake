# cmake -D root=SOURCE_DIR -P check_paper_map.cmake
# Each test that docs/paper_map.md names exists.
cmake_minimum_required(VERSION 3.22)

file(GLOB_RECURSE sources ${root}/tests/*.cpp)
set(tests "")
foreach(source IN LISTS sources)
  file(STRINGS ${source} lines REGEX "^(TYPED_)?TEST(_P|_F)?\\(")
  list(APPEND tests ${lines})
endforeach()

file(READ ${root}/docs/paper_map.md page)
string(REGEX MATCHALL "`[A-Z][A-Za-z]+\\.([A-Z][A-Za-z]+|\\*)`" names "${page}")
foreach(name IN LISTS names)
  string(REGEX MATCH "`(.+)\\.(.+)`" ignored ${name})
  set(test "TEST(_P|_F)?\\(${CMAKE_MATCH_1}, *${CMAKE_MATCH_2}")
  string(REPLACE ", **" ", *" test "${test}")
  if(NOT tests MATCHES "${test}")
    message(SEND_ERROR "docs/paper_map.md names ${name}, which is no test")
  endif()
endforeach()
