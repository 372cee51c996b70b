# cmake -D objdump=OBJDUMP -D object=FILE -P check_kernels.cmake
# Refuses an instruction of AVX or of bit manipulation in an object for plain x86-64, but in the
# kernels that the processor chooses (nvm/core/target.hpp): also in what they share with others.
cmake_minimum_required(VERSION 3.22)

execute_process(
  COMMAND ${objdump} --disassemble --demangle --no-show-raw-insn ${object}
  OUTPUT_VARIABLE code COMMAND_ERROR_IS_FATAL ANY)
string(REGEX REPLACE "[][;]" "," code "${code}")
string(REGEX MATCHALL "[^\n]+>:|\t(v[a-z0-9]+|andn|bls[ir]|bextr|s[ahr][lrx]x|popcnt)[ \n][^\n]*" lines "${code}")
set(function "")
set(kernels 0)
foreach(line IN LISTS lines)
  if(line MATCHES ">:$")
    set(function "${line}")
  elseif(function MATCHES "for_avx2_kernels")
    math(EXPR kernels "${kernels} + 1")
  else()
    message(FATAL_ERROR "${function} has${line}")
  endif()
endforeach()
if(kernels EQUAL 0)
  message(FATAL_ERROR "${object} has no kernels for AVX2")
endif()
message(STATUS "${kernels} instructions, all of them in kernels")
