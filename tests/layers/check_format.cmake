# SPDX-License-Identifier: BSD-3-Clause
# Fails if a source file is not as .clang-format would have it.
cmake_minimum_required(VERSION 3.25)
file(GLOB_RECURSE sources "${ROOT}/modules/*.[ch]pp" "${ROOT}/apps/*.[ch]pp" "${ROOT}/tests/*.[ch]pp")
execute_process(COMMAND ${CLANG_FORMAT} --dry-run -Werror ${sources} RESULT_VARIABLE result ERROR_VARIABLE out)
if(NOT result EQUAL 0)
  message(FATAL_ERROR "run: clang-format -i on the files named here\n${out}")
endif()
