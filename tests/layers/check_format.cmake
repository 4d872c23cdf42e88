# SPDX-License-Identifier: BSD-3-Clause
# Fails if a source file is not as clang-format 14, that of Debian 12, has it by .clang-format: others break lines elsewhere.
cmake_minimum_required(VERSION 3.25)
execute_process(COMMAND ${CLANG_FORMAT} --version RESULT_VARIABLE result OUTPUT_VARIABLE version ERROR_QUIET)
if(NOT result EQUAL 0 OR NOT version MATCHES "version 14[.]")
  execute_process(COMMAND ${CMAKE_COMMAND} -E echo "skipped: the format is that of clang-format 14, which is not here: ${version}")
  return()
endif()
file(GLOB_RECURSE sources "${ROOT}/modules/*.[ch]pp" "${ROOT}/apps/*.[ch]pp" "${ROOT}/tests/*.[ch]pp")
execute_process(COMMAND ${CLANG_FORMAT} --dry-run -Werror ${sources} RESULT_VARIABLE result ERROR_VARIABLE out)
if(NOT result EQUAL 0)
  message(FATAL_ERROR "run: clang-format -i on the files named here\n${out}")
endif()
