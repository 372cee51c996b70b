# cmake -D nm=NM -D object=FILE -P check_shared_code.cmake
# Refuses a function of nvm in an object for AVX2 and FMA that the linker could put in the place of
# another instruction set's (nvm/core/target.hpp): one of no namespace that says so.
cmake_minimum_required(VERSION 3.22)

execute_process(COMMAND ${nm} -C ${object} OUTPUT_VARIABLE symbols COMMAND_ERROR_IS_FATAL ANY)
string(REGEX MATCHALL "[^\n]* [WVu] (void |bool |int |float |double )?nvm::[^\n]*" shared "${symbols}")
list(FILTER shared EXCLUDE REGEX "for_avx2_fma")
list(FILTER shared EXCLUDE REGEX "NormalResult::~NormalResult") # frees memory and no more
if(NOT symbols MATCHES "for_avx2_fma")
  message(FATAL_ERROR "no function of ${object} is named after what it is compiled for")
endif()
if(shared)
  list(JOIN shared "\n  " shared)
  message(FATAL_ERROR "shared with units for other instruction sets:\n  ${shared}")
endif()
