// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>

namespace insonify {

/// Stage and progress of the program, for a display.
struct WorkProgress {
  const char* stage = "";   ///< stage that began last
  std::size_t done = 0;     ///< finished calls of the outermost running parallel loop
  std::size_t total = 0;    ///< calls of this loop; 0: no loop runs
  double loop_seconds = 0;  ///< seconds since this loop began
};

/// Switches the observation of loops on or off. It is off at first, and then costs nothing.
void observe_work(bool on);

/// Names the stage that begins; `name` must live as long as the program. May be called from any thread.
void begin_stage(const char* name);

/// Returns stage and progress of the program. May be called from any thread.
WorkProgress work_progress();

/// A loop that is counted if work is observed, if it has several calls, and if no counted loop holds it.
class ObservedLoop {
 public:
  /// Begins a loop of `total` calls, which ends with this object.
  explicit ObservedLoop(std::size_t total);
  ~ObservedLoop();
  ObservedLoop(const ObservedLoop&) = delete;
  ObservedLoop& operator=(const ObservedLoop&) = delete;

  /// Counts one finished call.
  void advance() {
    if (counts_) count();
  }

 private:
  static void count();
  const bool counts_;
};

}  // namespace insonify
