#pragma once

namespace insonify::tool {

/// Parses the command line and runs the verb that it names. Returns the exit code: 0, or 2 for an error of usage, which
/// is on stderr. Throws what the verb throws.
int run_command_line(int argc, char** argv);

}  // namespace insonify::tool
