# cmake -D root=SOURCE_DIR -P check_includes.cmake
# Refuses an include against the direction of the layers, in the core a library beyond its two, a
# source file that does not include its own header first, and a file that has grown too long, tests included.
cmake_minimum_required(VERSION 3.22)

set(layers core geometry normal map registration adapters common config lio io sim eval survey merge app)
# The rooms of the layers that have some, lowest first: none may include a later one.
set(rooms_lio state map scan match place change imu pipeline)
set(rooms_io file cloud scan sequence message result)
set(rooms_eval trajectory walls report)

# What each layer may include beside itself.
set(below_core "")
set(below_geometry core)
set(below_normal core geometry)
set(below_map core geometry)
set(below_registration core geometry normal map)
set(below_adapters ${below_registration} registration)
set(below_common ${below_registration} registration)
set(below_config ${below_common})
set(below_lio ${below_common} common config)
set(below_io ${below_lio} lio)
set(below_sim ${below_lio} lio io)
set(below_eval ${below_lio} lio io)
set(below_survey ${below_eval} eval)
set(below_merge ${below_lio} lio io)
set(below_app ${below_survey} survey merge sim)

set(max_lines 300)
# The core has no streams, threads or libraries of its own: Eigen, nanoflann, and TBB where asked.
set(refused_in_core
    "<(iostream|fstream|thread|mutex|spdlog|fmt|yaml-cpp|pcl|ceres|omp|tbb)[./>]")
set(allowed_in_core include/nvm/core/executor_tbb.hpp include/nvm/map/serialization.hpp)

set(problems "")
foreach(layer IN LISTS layers)
  foreach(folder include/nvm src .)
    file(GLOB_RECURSE files RELATIVE ${root} ${root}/${folder}/${layer}/*.hpp
         ${root}/${folder}/${layer}/*.cpp)
    foreach(file IN LISTS files)
      file(READ ${root}/${file} text)
      string(REGEX MATCHALL "\n" line_ends "${text}")
      list(LENGTH line_ends line_count)
      file(STRINGS ${root}/${file} includes REGEX "^#include ")
      foreach(include IN LISTS includes)
        if(include MATCHES "\"(nvm/)?([a-z_]+)/"
           AND CMAKE_MATCH_2 IN_LIST layers
           AND NOT CMAKE_MATCH_2 IN_LIST below_${layer}
           AND NOT CMAKE_MATCH_2 STREQUAL layer)
          list(APPEND problems "${file}: ${include} (${layer} is not above ${CMAKE_MATCH_2})")
        endif()
        if(DEFINED rooms_${layer}
           AND "${file} ${include}" MATCHES "^src/${layer}/([a-z]+)/.*\"${layer}/([a-z]+)/")
          set(other_room ${CMAKE_MATCH_2})
          list(FIND rooms_${layer} ${CMAKE_MATCH_1} height)
          list(FIND rooms_${layer} ${other_room} other_height)
          if(height LESS 0 OR other_height LESS 0 OR other_height GREATER height)
            list(APPEND problems "${file}: ${include} (its room is not above ${other_room})")
          endif()
        endif()
        if(folder STREQUAL include/nvm
           AND include MATCHES ${refused_in_core}
           AND NOT file IN_LIST allowed_in_core)
          list(APPEND problems "${file}: ${include} (not in the core)")
        endif()
      endforeach()
      string(REGEX REPLACE "cpp$" "hpp" header ${file})
      string(REGEX MATCH "[^/]+$" header_name ${header})
      if(file MATCHES "cpp$"
         AND EXISTS ${root}/${header}
         AND NOT includes MATCHES "^#include \"[a-z_/]+/${header_name}\"")
        list(APPEND problems "${file}: does not include its own header first")
      endif()
      if(line_count GREATER max_lines)
        list(APPEND problems "${file}: longer than ${max_lines} lines")
      endif()
    endforeach()
  endforeach()
endforeach()

foreach(folder benchmarks examples ros tests)
  file(GLOB_RECURSE files RELATIVE ${root} ${root}/${folder}/*.hpp ${root}/${folder}/*.cpp)
  foreach(file IN LISTS files)
    file(READ ${root}/${file} text)
    string(REGEX MATCHALL "\n" line_ends "${text}")
    list(LENGTH line_ends line_count)
    if(line_count GREATER max_lines)
      list(APPEND problems "${file}: longer than ${max_lines} lines")
    endif()
  endforeach()
endforeach()

list(JOIN problems "\n  " problems)
if(problems)
  message(FATAL_ERROR "includes and file lengths:\n  ${problems}")
endif()
