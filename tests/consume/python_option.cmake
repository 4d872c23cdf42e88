# SPDX-License-Identifier: BSD-3-Clause
# A tree that was configured without pybind11 has Python's module once its package is there, unless its user said otherwise.
cmake_minimum_required(VERSION 3.25)
file(REMOVE_RECURSE ${WORK})
foreach(step IN ITEMS "OFF:-DCMAKE_DISABLE_FIND_PACKAGE_pybind11=ON" "ON:-UCMAKE_DISABLE_FIND_PACKAGE_pybind11" "OFF:-DINSONIFY_PYTHON=OFF"
    "OFF:-DBUILD_TESTING=OFF")
  string(REGEX MATCH "(.*):(.*)" matched ${step})
  set(wanted ${CMAKE_MATCH_1})
  execute_process(COMMAND ${CMAKE_COMMAND} -G Ninja -DBUILD_TESTING=OFF ${CMAKE_MATCH_2} -Wno-dev -S ${SOURCE} -B ${WORK} RESULT_VARIABLE result
    OUTPUT_QUIET ERROR_VARIABLE out)
  file(STRINGS ${WORK}/build.ninja rules REGEX "^build _insonify:")
  if(NOT result EQUAL 0 OR (wanted AND NOT rules) OR (rules AND NOT wanted))
    message(FATAL_ERROR "after ${CMAKE_MATCH_2} the module is not ${wanted}: ${rules} ${out}")
  endif()
endforeach()
