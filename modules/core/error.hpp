// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <sstream>
#include <stdexcept>
#include <string>

namespace insonify {

/// Category of an error; the command-line tool maps each to an exit code (docs/troubleshooting.md).
enum class ErrorKind {
  runtime,   ///< an operation failed at run time (exit code 1)
  argument,  ///< an argument violates a rule (2)
  content,   ///< the content of a file or scene is unusable (3)
  file,      ///< a file is missing, already exists, or cannot be written (4)
  memory     ///< the memory that this process may take is too small (4)
};

/// The exception type of all insonify functions. The text names the function or file, the value with its unit, the rule
/// it violates and a remedy.
class Error : public std::runtime_error {
 public:
  /// Constructs an error of this kind and text; fail() composes the text.
  Error(ErrorKind kind, const std::string& text) : std::runtime_error(text), kind_(kind) {}
  /// Returns the category.
  ErrorKind kind() const { return kind_; }

 private:
  ErrorKind kind_;
};

/// Throws Error whose text is the concatenation of the parts: fail(ErrorKind::argument, "range_gate: min_range = ", r,
/// " m, must be > 0").
template <typename... Parts>
[[noreturn]] void fail(ErrorKind kind, const Parts&... parts) {
  std::ostringstream text;
  text.precision(10);
  (text << ... << parts);
  throw Error(kind, text.str());
}

}  // namespace insonify
