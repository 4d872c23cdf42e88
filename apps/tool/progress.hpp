#pragma once
#include <string>

#include "tool/options.hpp"

namespace insonify::tool {

/// Thrown at the next step after Ctrl-C.
struct Interrupted {};

/// Defers Ctrl-C and SIGTERM to the end of a step, so that nothing is left half-written.
void catch_interrupts();

/// Reports progress on stderr: a bar on a terminal, plain lines with -v, nothing with -q.
class Progress {
 public:
  Progress(const CommonOptions& common, int steps);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Starts the next step. Throws Interrupted after Ctrl-C.
  void step(const std::string& what);
  /// Throws Interrupted after Ctrl-C: for steps that take long.
  void check() const;
  /// Shows a sentence unless quiet.
  void note(const std::string& sentence);

 private:
  void clear_bar();
  bool quiet_, verbose_, bar_, bar_shown_ = false;
  int steps_, done_ = 0;
};

}  // namespace insonify::tool
