// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace insonify::tool {

/// The program: parses the command line and runs its verb; errors go to stderr. Returns the exit code.
int run_tool(int argc, char** argv);

}  // namespace insonify::tool
