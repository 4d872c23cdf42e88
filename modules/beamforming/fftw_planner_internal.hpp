#pragma once
#include <mutex>

namespace insonify {

/// FFTW's planner may make or destroy one plan at a time, of whatever precision; running plans needs no lock.
inline std::mutex& fftw_planner() {
  static std::mutex planner;
  return planner;
}

}  // namespace insonify
