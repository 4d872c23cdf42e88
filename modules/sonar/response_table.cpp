// SPDX-License-Identifier: BSD-3-Clause
#include "sonar/response_table.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/units.hpp"
#include "sonar/element_kernels_internal.hpp"

namespace insonify {
namespace {
/// Table steps per lobe. The error of linear interpolation is at most step^2 |B''| / 8; |B''| at most (pi / lobe)^2.
constexpr double steps_per_lobe = 360;
}  // namespace

ResponseTable::ResponseTable(const LineArray& array, double wavelength) {
  require_valid(array, "ResponseTable");
  if (!(std::isfinite(wavelength) && wavelength > 0))
    fail(ErrorKind::argument, "ResponseTable: wavelength = ", wavelength, " m, must be finite and > 0");
  const std::size_t n = array.elements();
  half_period_ = 0.5 * wavelength / array.spacing;  // (E33) the pattern is symmetric about it
  per_unit_ = steps_per_lobe * static_cast<double>(n) * array.spacing / wavelength;
  const double last = std::min(half_period_, 2.0);
  std::vector<double> re(n), im(n);
  for (std::size_t k = 0; amplitude_.size() < 2 || static_cast<double>(k - 2) < last * per_unit_; ++k) {
    const double offset = static_cast<double>(k) / per_unit_;
    kernels::element_phases(2 * pi * array.spacing / wavelength * offset, n, re.data(), im.data());
    double sum = 0;
    for (std::size_t m = 0; m < n; ++m) sum += array.shading[m] * re[m];
    amplitude_.push_back(sum / static_cast<double>(n));  // (E10)
  }
}

double ResponseTable::folded(double offset) const {
  return std::abs(offset - 2 * half_period_ * std::nearbyint(offset / (2 * half_period_)));
}

double ResponseTable::reach(double floor) const {
  std::size_t k = amplitude_.size() - 1;
  while (k > 0 && amplitude_[k - 1] * amplitude_[k - 1] < floor) --k;
  return std::min(half_period_, static_cast<double>(k) / per_unit_);
}

bool ResponseTable::at_grating_lobe(double nearest, double farthest, double reach) const {
  const double period = 2 * half_period_, before = period * std::floor(nearest / period);
  return nearest - before <= reach || farthest >= before + period - reach;
}

}  // namespace insonify
