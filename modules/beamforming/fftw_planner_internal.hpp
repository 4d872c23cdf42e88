#pragma once
#include <mutex>

namespace insonify {

/// FFTW creates and destroys plans one at a time, for all precisions together; executing plans needs no lock.
inline std::mutex& fftw_planner() {
  static std::mutex planner;
  return planner;
}

}  // namespace insonify
