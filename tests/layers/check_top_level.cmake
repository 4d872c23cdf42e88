# SPDX-License-Identifier: BSD-3-Clause
# Fails if the repository holds a file at its top level that does not belong there: what a test or a run left.
cmake_minimum_required(VERSION 3.25)
set(BELONG .ci .clang-format .clang-tidy .gitignore CITATION.cff CMakeLists.txt CMakePresets.json LICENSE README.md apps data docs modules pyproject.toml tests)
execute_process(COMMAND git ls-files WORKING_DIRECTORY ${ROOT} RESULT_VARIABLE result OUTPUT_VARIABLE files ERROR_QUIET)
if(NOT result EQUAL 0)
  return() # not a repository, but a copy of its files
endif()
string(REGEX REPLACE "\n" ";" files "${files}")
foreach(file IN LISTS files)
  string(REGEX REPLACE "/.*" "" top "${file}")
  if(top AND NOT top IN_LIST BELONG)
    message(SEND_ERROR "${top}: does not belong at the top level")
  endif()
endforeach()
