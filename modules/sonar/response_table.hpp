// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <vector>

#include "sonar/line_array.hpp"

namespace insonify {

/// Table of a line array's intensity response B^2 (E10) over |u - u_beam|, on which alone it depends, for stages that
/// evaluate it hundreds of millions of times.
class ResponseTable {
 public:
  /// Throws Error for an invalid array or a wavelength [m] that is not > 0.
  ResponseTable(const LineArray& array, double wavelength);

  /// Returns B^2 at `offset` = u - u_beam, |offset| <= 2. The error of B is at most 1e-5: B^2 is accurate to 2e-5 of
  /// the peak, and to 2 % at 60 dB below the peak.
  double intensity(double offset) const {
    double x = offset < 0 ? -offset : offset;
    if (x > half_period_) x = folded(x);
    const double b = within_period(x);
    return b * b;
  }
  /// Returns B at `offset`; beyond half a period of B^2 the sign is that of the period's first half.
  double amplitude(double offset) const {
    double x = offset < 0 ? -offset : offset;
    if (x > half_period_) x = folded(x);
    return within_period(x);
  }

  /// Returns the least offset from the centre of the main lobe or a grating lobe beyond which B^2 stays below `floor`;
  /// half the distance between lobes if it does not.
  double reach(double floor) const;

  /// Returns true if some offset in [nearest, farthest], 0 <= nearest, is within `reach` of the centre of the main lobe
  /// or of a grating lobe.
  bool responds_to(double nearest, double farthest, double reach) const {
    if (nearest <= reach) return true;
    if (farthest < 2 * half_period_ - reach) return false;
    return at_grating_lobe(nearest, farthest, reach);
  }

 private:
  double within_period(double x) const {
    x *= per_unit_;
    const auto whole = static_cast<std::size_t>(x);
    const double below = amplitude_[whole], t = x - static_cast<double>(whole);
    return below + t * (amplitude_[whole + 1] - below);
  }
  double folded(double offset) const;
  bool at_grating_lobe(double nearest, double farthest, double reach) const;

  double half_period_, per_unit_;
  std::vector<double> amplitude_;  // over offsets from 0 to half a period of B^2, or 2
};

}  // namespace insonify
