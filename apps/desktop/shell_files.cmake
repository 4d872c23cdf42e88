# SPDX-License-Identifier: BSD-3-Clause
# Writes into FOLDER, where Debian looks for them below /usr/share, what TOOL says of itself and its VERBS: man pages, and
# completions of bash, zsh and fish.
cmake_minimum_required(VERSION 3.25)
file(REMOVE_RECURSE ${FOLDER})
function(write_output file)
  cmake_path(GET file PARENT_PATH parent)
  file(MAKE_DIRECTORY ${FOLDER}/${parent})
  execute_process(COMMAND ${TOOL} ${ARGN} OUTPUT_FILE ${FOLDER}/${file} COMMAND_ERROR_IS_FATAL ANY)
endfunction()
write_output(man/man1/insonify.1 man)
foreach(verb IN LISTS VERBS)
  write_output(man/man1/insonify-${verb}.1 man ${verb})
endforeach()
write_output(bash-completion/completions/insonify completion bash)
write_output(zsh/vendor-completions/_insonify completion zsh)
write_output(fish/vendor_completions.d/insonify.fish completion fish)
