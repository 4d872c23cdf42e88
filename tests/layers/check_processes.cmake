# SPDX-License-Identifier: BSD-3-Clause
# Fails if one of FILES, libraries and modules that other programs load, starts a process: in a program with threads, locks
# that one of them holds would stay taken there for ever.
cmake_minimum_required(VERSION 3.25)
set(found "")
foreach(file IN LISTS FILES)
  execute_process(COMMAND ${NM} -u ${file} OUTPUT_VARIABLE symbols COMMAND_ERROR_IS_FATAL ANY)
  string(REGEX MATCHALL " U (v?fork|_Fork|clone3?|posix_spawnp?|system|popen)[@\n]" starts "${symbols}")
  foreach(start IN LISTS starts)
    string(REGEX REPLACE " U ([a-z0-9_F]+).*" "\\1" name "${start}")
    string(APPEND found "${file}: calls ${name}, which only programs may (apps/tool/command/reader_server.cpp)\n")
  endforeach()
endforeach()
if(found)
  message(FATAL_ERROR "${found}")
endif()
