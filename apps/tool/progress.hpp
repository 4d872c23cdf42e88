#pragma once
#include <string>

#include "tool/options.hpp"
#include "tool/program.hpp"

namespace insonify::tool {

/// Defers Ctrl-C and SIGTERM to the end of a step, so that nothing is left half-written.
void catch_interrupts();

/// Whether Ctrl-C or SIGTERM was caught.
bool is_interrupted();

/// Prints a result on stdout: as JSON with --json, else by `print`.
template <typename Json, typename Print>
void print_result(const CommonOptions& common, const Json& result, const Print& print) {
  if (common.json)
    std::puts(result.dump(2).c_str());
  else
    print();
}

/// Reports progress on stderr: a bar on a terminal, plain lines with -v, nothing with -q.
class Progress {
 public:
  Progress(const CommonOptions& common, int steps);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Starts the next step. Throws Interrupted after Ctrl-C.
  void step(const std::string& what);
  /// Moves the bar of a terminal to `part` (0 to 1) of the whole work; else nothing.
  void show(double part, const std::string& what);
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
