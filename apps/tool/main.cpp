// SPDX-License-Identifier: BSD-3-Clause
#include "files/peak_memory.hpp"
#include "tool/command/program.hpp"

int main(int argc, char** argv) {
  insonify::keep_freed_memory();
  return insonify::tool::run_tool(argc, argv);
}
