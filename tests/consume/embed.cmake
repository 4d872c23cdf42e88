# SPDX-License-Identifier: BSD-3-Clause
# Builds a stranger's project that has the clone SOURCE within it, in both ways of the same objects, and runs its program; an
# installation of the project has the program alone. FLAGS are those of the compiler, e.g. -fsanitize=thread.
cmake_minimum_required(VERSION 3.25)
file(REMOVE_RECURSE ${WORK}/prefix)
foreach(way IN ITEMS add_subdirectory FetchContent)
  foreach(step IN ITEMS
      "-G;Ninja;-DWAY=${way};-DINSONIFY=${SOURCE};-DCMAKE_CXX_FLAGS=${FLAGS};-DCMAKE_UNITY_BUILD=ON;-DCMAKE_UNITY_BUILD_BATCH_SIZE=20;-DCMAKE_CXX_COMPILER_LAUNCHER=${LAUNCHER};-Wno-dev;-S;${SOURCE}/tests/consume/embedded;-B;${WORK}/build"
      "--build;${WORK}/build" "--install;${WORK}/build;--prefix;${WORK}/prefix")
    execute_process(COMMAND ${CMAKE_COMMAND} ${step} RESULT_VARIABLE result OUTPUT_VARIABLE out ERROR_VARIABLE out)
    if(NOT result EQUAL 0)
      message(FATAL_ERROR "${way}: ${step}\n${out}")
    endif()
  endforeach()
  execute_process(COMMAND ${WORK}/build/eight_threads RESULT_VARIABLE result ERROR_VARIABLE out)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "${way}: the program ends with ${result}: ${out}")
  endif()
  file(STRINGS ${WORK}/build/CMakeCache.txt cached REGEX "^(Python3_EXECUTABLE|CPACK_[A-Z_]+|BUILD_TESTING):")
  file(GLOB_RECURSE installed RELATIVE ${WORK}/prefix ${WORK}/prefix/*)
  if(cached OR NOT installed STREQUAL "bin/eight_threads")
    message(FATAL_ERROR "${way}: caches ${cached} and installs ${installed}")
  endif()
endforeach()
