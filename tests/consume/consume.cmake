# Installs BUILD into a folder of its own, builds the stranger's project against it, and runs that.
cmake_minimum_required(VERSION 3.25)
set(prefix ${WORK}/prefix)
file(REMOVE_RECURSE ${WORK})
foreach(step IN ITEMS
    "${CMAKE_COMMAND};--install;${BUILD};--prefix;${prefix}"
    "${CMAKE_COMMAND};-S;${SOURCE};-B;${WORK}/build;-G;Ninja;-DCMAKE_PREFIX_PATH=${prefix};-DCMAKE_BUILD_TYPE=Debug;-Wno-dev"
    "${CMAKE_COMMAND};--build;${WORK}/build"
    "${WORK}/build/stranger"
    "${prefix}/bin/insonify;sonars;p900-45")
  execute_process(COMMAND ${step} RESULT_VARIABLE result OUTPUT_VARIABLE out ERROR_VARIABLE out)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "failed: ${step}\n${out}")
  endif()
endforeach()
