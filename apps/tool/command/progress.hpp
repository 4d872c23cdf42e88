// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

#include <nlohmann/json_fwd.hpp>

#include "run/run_observer.hpp"
#include "tool/command/option_list.hpp"
#include "tool/command/program.hpp"

namespace insonify::tool {

/// Ends the program at once on Ctrl-C, SIGTERM or SIGHUP, whatever it is doing, with exit code 130 and nothing left of
/// what was not complete. To be called before the first thread is started.
void end_on_interrupt();

/// From here on the first interrupt is only noted: for a verb that looks at is_interrupted() and ends by itself,
/// keeping what is done. The second one ends the program at once; `kept` says what is left then.
void finish_on_interrupt(const char* kept);

/// Never returns if an interrupt is ending the program: for errors that only follow from that.
void wait_for_end();

/// Returns true if an interrupt was noted.
bool is_interrupted();

/// Ends the display of progress, before results are printed.
void end_progress();

/// Prints a result on stdout: as JSON with --json, else by `print`.
template <typename Json, typename Print>
void print_result(const CommonOptions& common, const Json& result, const Print& print) {
  end_progress();
  if (common.json)
    std::puts(result.dump(2).c_str());
  else
    print();
}

/// Says on stdout what was written: as JSON with --json, else in one line, and nothing with -q.
void print_summary(const CommonOptions& common, const nlohmann::ordered_json& result, const std::string& line);

/// A time for people: "12 s", "3:05 min", "1:20 h".
std::string time_text(double seconds);

/// Reports progress on stderr: a bar on a terminal, plain lines with -v, nothing with -q. On a terminal it also says
/// how far the longest loop of the present step is, and how long it will take, four times a second.
class Progress : public RunObserver {
 public:
  Progress(const CommonOptions& common, int steps);
  ~Progress() override;
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Starts the next step.
  void step(const std::string& what) override;
  /// Moves the bar of a terminal to `share` (0 to 1) of the whole work; else nothing.
  void show(double share, const std::string& what);
  /// Takes the bar away for good.
  void finish();
  /// Shows a sentence unless quiet.
  void note(const std::string& sentence) override;

 private:
  void draw_bar();
  void clear_bar();
  void watch_loops(const std::stop_token& end);

  const bool quiet_, verbose_, bar_;
  const int steps_;
  std::mutex guard_;  // of all below
  std::condition_variable_any ended_;
  bool bar_shown_ = false, shows_loops_ = true;
  int done_ = 0;
  double part_ = 0;
  std::string what_;
  std::jthread watcher_;  // last, so that it ends first
};

}  // namespace insonify::tool
