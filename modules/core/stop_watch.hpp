// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <chrono>

namespace insonify {

/// Wall time between laps.
class StopWatch {
 public:
  /// Returns the seconds since the last call, or since construction.
  double lap() {
    const auto now = std::chrono::steady_clock::now();
    const std::chrono::duration<double> seconds = now - last_;
    last_ = now;
    return seconds.count();
  }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

}  // namespace insonify
