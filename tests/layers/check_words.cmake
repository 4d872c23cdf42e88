# SPDX-License-Identifier: BSD-3-Clause
# Fails if a retired word of retired_words.txt stands in the tree below ROOT.
cmake_minimum_required(VERSION 3.25)
set(list "${CMAKE_CURRENT_LIST_DIR}/retired_words.txt")
file(STRINGS "${list}" words REGEX "^[^#]")
list(JOIN words "|" any)
execute_process(
  COMMAND grep -rnIE --exclude=retired_words.txt --exclude-dir=planted "${any}" modules apps tests docs data README.md
  WORKING_DIRECTORY "${ROOT}" RESULT_VARIABLE result OUTPUT_VARIABLE hits ERROR_QUIET)
if(NOT result EQUAL 1)
  message("${hits}")
  message(FATAL_ERROR "retired words, listed in tests/layers/retired_words.txt")
endif()
