# cmake -D compiler=... -D source=... -D prefix=... -D program=... -P pkg_config.cmake
# A project without CMake: one call of the compiler with the flags of pkg-config.
set(ENV{PKG_CONFIG_PATH} ${prefix}/share/pkgconfig)
execute_process(
  COMMAND pkg-config --cflags nvm
  OUTPUT_VARIABLE flags
  OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
separate_arguments(flags)
execute_process(COMMAND ${compiler} -std=c++17 ${flags} ${source} -o ${program}
                        COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${program} COMMAND_ERROR_IS_FATAL ANY)
