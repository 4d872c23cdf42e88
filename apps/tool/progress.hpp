#pragma once
#include <string>

#include <nlohmann/json_fwd.hpp>

#include "tool/options.hpp"
#include "tool/program.hpp"

namespace insonify::tool {

/// Ends the program at once on Ctrl-C, SIGTERM or SIGHUP, whatever it is doing, with exit code 130 and nothing left of
/// what was not complete. To be called before the first thread is started.
void end_on_interrupt();

/// From here on the first interrupt is only noted: for a verb that looks at is_interrupted() and ends by itself, keeping
/// what is done. The second one ends the program at once; `kept` says what is left then.
void finish_on_interrupt(const char* kept);

/// Never returns if an interrupt is ending the program: for errors that only follow from that.
void wait_for_end();

/// Whether an interrupt was noted.
bool is_interrupted();

/// Prints a result on stdout: as JSON with --json, else by `print`.
template <typename Json, typename Print>
void print_result(const CommonOptions& common, const Json& result, const Print& print) {
  if (common.json)
    std::puts(result.dump(2).c_str());
  else
    print();
}

/// Says on stdout what was written: as JSON with --json, else in one line, and nothing with -q.
void print_summary(const CommonOptions& common, const nlohmann::ordered_json& result, const std::string& line);

/// Reports progress on stderr: a bar on a terminal, plain lines with -v, nothing with -q.
class Progress {
 public:
  Progress(const CommonOptions& common, int steps);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Starts the next step.
  void step(const std::string& what);
  /// Moves the bar of a terminal to `part` (0 to 1) of the whole work; else nothing.
  void show(double part, const std::string& what);
  /// Shows a sentence unless quiet.
  void note(const std::string& sentence);

 private:
  void clear_bar();
  bool quiet_, verbose_, bar_, bar_shown_ = false;
  int steps_, done_ = 0;
};

}  // namespace insonify::tool
