// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "core/error.hpp"

namespace insonify::tool {

/// How a program ends.
enum ExitCode : int {
  exit_ok = 0,
  exit_failure = 1,
  exit_usage = 2,
  exit_content = 3,
  exit_file = 4,
  exit_some_failed = 5,
  exit_interrupted = 130,
  exit_no_reader = 141  ///< code that a shell reports for SIGPIPE
};

/// An exit code with its meaning in man pages and docs/troubleshooting.md.
struct ExitCodeText {
  ExitCode code;
  const char* meaning;
};
inline constexpr ExitCodeText exit_code_texts[] = {
    {exit_ok, "ok"},
    {exit_failure, "run-time failure"},
    {exit_usage, "wrong usage"},
    {exit_content, "unusable content"},
    {exit_file, "file missing or not writable, or too little memory"},
    {exit_some_failed, "some pings of a survey failed and all others are kept"},
    {exit_interrupted, "interrupted"},
    {exit_no_reader, "the reader of the output has gone"}};

/// The exit code of an error.
constexpr ExitCode exit_code_of(ErrorKind kind) {
  constexpr ExitCode codes[] = {exit_failure, exit_usage, exit_content, exit_file, exit_file};  // in the order of kinds
  return codes[static_cast<int>(kind)];
}

}  // namespace insonify::tool
