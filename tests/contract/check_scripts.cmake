# cmake -D root=SOURCE_DIR -P check_scripts.cmake
# Refuses a script that takes up its environment before setup.sh has made it: on a new machine it would do
# without what was just installed.
cmake_minimum_required(VERSION 3.22)

file(GLOB scripts ${root}/scripts/*.sh)
list(REMOVE_ITEM scripts ${root}/scripts/setup.sh)
set(checked 0)
foreach(script IN LISTS scripts)
  file(READ ${script} text)
  string(FIND "${text}" "/setup.sh" setup)
  string(FIND "${text}" "\nsource \"$(dirname \"$0\")/environment.sh\"" environment)
  if(setup GREATER -1 AND environment GREATER -1)
    math(EXPR checked "${checked} + 1")
    if(environment LESS setup)
      message(SEND_ERROR "${script}: setup.sh must come before environment.sh")
    endif()
  endif()
endforeach()
if(checked LESS 5)
  message(SEND_ERROR "only ${checked} scripts were found that call setup.sh")
endif()
