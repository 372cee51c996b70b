# cmake -D root=SOURCE_DIR -P check_readme.cmake
# The code that the README shows is part of an example, which is compiled and run.
cmake_minimum_required(VERSION 3.22)

function(read_without_spaces variable path)
  file(READ ${path} text)
  string(REGEX REPLACE "[ \n;]+" " " text "${text}")
  set(${variable} "${text}" PARENT_SCOPE)
endfunction()

read_without_spaces(readme ${root}/README.md)
read_without_spaces(example ${root}/examples/01_two_sided_map.cpp)
if(NOT readme MATCHES "```cpp (.*) ```")
  message(FATAL_ERROR "README.md shows no code")
endif()
string(REGEX REPLACE "```.*" "" code "${CMAKE_MATCH_1}")
string(STRIP "${code}" code)
string(FIND "${example}" "${code}" position)
if(position EQUAL -1)
  message(FATAL_ERROR "README.md shows code that is not in examples/01_two_sided_map.cpp")
endif()
