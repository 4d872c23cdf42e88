#pragma once
#include <sstream>
#include <stdexcept>
#include <string>

namespace insonify {

/// What kind of thing went wrong; the tool turns each into an exit code (docs/troubles.md).
enum class ErrorKind {
  runtime,   ///< something failed that should not have (exit code 1)
  argument,  ///< a caller's value breaks a rule (2)
  content,   ///< a file or a scene holds something unusable (3)
  file       ///< a file is missing, exists already, or cannot be written (4)
};

/// The one exception of insonify. The text names the function or file, the value, its unit, the rule and a remedy.
class Error : public std::runtime_error {
 public:
  Error(ErrorKind kind, const std::string& text) : std::runtime_error(text), kind_(kind) {}
  ErrorKind kind() const { return kind_; }

 private:
  ErrorKind kind_;
};

/// Throws Error with the parts joined: fail(ErrorKind::argument, "range_gate: min_range = ", r, " m, must be > 0").
template <typename... Parts>
[[noreturn]] void fail(ErrorKind kind, const Parts&... parts) {
  std::ostringstream text;
  text.precision(10);
  (text << ... << parts);
  throw Error(kind, text.str());
}

}  // namespace insonify
