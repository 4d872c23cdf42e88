#pragma once
#include <functional>

namespace insonify::tool {

/// What the command line asks for: run(), or nothing more than to exit with `exit_code` (help, version, bad usage).
struct Command {
  std::function<void()> run;
  int exit_code = 0;
};

/// Parses the command line. Help and version go to stdout with exit code 0, usage errors to stderr with 2.
Command parse_command_line(int argc, char** argv);

}  // namespace insonify::tool
