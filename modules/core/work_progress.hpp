// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>

namespace insonify {

/// What the program is doing, for a display.
struct WorkProgress {
  const char* stage = "";   ///< that was begun last
  std::size_t done = 0;     ///< of the outermost parallel loop that is running
  std::size_t total = 0;    ///< 0: none is running
  double loop_seconds = 0;  ///< since it began
};

/// Switches the observation of loops on or off; off at first, when it costs nothing.
void observe_work(bool on);

/// Names the stage that begins; `name` must live as long as the program. May be called from any thread.
void begin_stage(const char* name);

/// Returns what the program is doing. May be called from any thread.
WorkProgress work_progress();

/// A loop that counts if work is observed, it has several calls, and it is not inside another loop that counts.
class ObservedLoop {
 public:
  /// Begins a loop of `total` calls, which ends with this object.
  explicit ObservedLoop(std::size_t total);
  ~ObservedLoop();
  ObservedLoop(const ObservedLoop&) = delete;
  ObservedLoop& operator=(const ObservedLoop&) = delete;

  /// Counts a call that is done.
  void advance() {
    if (counts_) count();
  }

 private:
  static void count();
  const bool counts_;
};

}  // namespace insonify
