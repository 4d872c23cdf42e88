// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cmath>

namespace insonify {

/// Returns the mean of f(b - a) over all a and b between 0 and 1, by `steps` steps on either side of 0.
template <typename Function>
double mean_of_pairs(int steps, const Function& f) {
  double mean = 0;
  for (int k = -steps; k < steps; ++k) {
    const double s = (k + 0.5) / steps;
    mean += (1 - std::abs(s)) * f(s) / steps;
  }
  return mean;
}

}  // namespace insonify
