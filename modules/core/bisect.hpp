// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <utility>

namespace insonify {

/// Returns the interval that 60 bisections leave of that from `inside`, where `holds`, to `outside`, where it does not.
template <typename Holds>
std::pair<double, double> bisected(double inside, double outside, const Holds& holds) {
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (inside + outside);
    (holds(middle) ? inside : outside) = middle;
  }
  return {inside, outside};
}

/// Returns the least x at which a power falls below one half, by steps and bisection; `most` if it stays above.
template <typename Power>
double half_power_point(const Power& power, double step, double most) {
  double inside = 0, outside = step;
  while (outside < most && power(outside) > 0.5) inside = outside, outside += step;
  if (outside >= most && power(most) > 0.5) return most;
  return bisected(inside, outside < most ? outside : most, [&](double x) { return power(x) > 0.5; }).first;
}

}  // namespace insonify
