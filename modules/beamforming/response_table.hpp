#pragma once
#include <vector>

#include "beamforming/line_array.hpp"

namespace insonify {

/// A line array's intensity response B^2 (E10) as a table over |u - u_beam|, on which alone it depends: for stages that
/// ask for it hundreds of millions of times.
class ResponseTable {
 public:
  /// Throws Error for an invalid array or a wavelength [m] that is not > 0.
  ResponseTable(const LineArray& array, double wavelength);

  /// B^2 at `offset` = u - u_beam, |offset| <= 2. B is off by at most 1e-5: B^2 by 2e-5 of the peak, and by 2 % where it
  /// is 60 dB below the peak.
  double intensity(double offset) const {
    double x = offset < 0 ? -offset : offset;
    if (x > half_period_) x = folded(x);
    x *= per_unit_;
    const auto whole = static_cast<std::size_t>(x);
    const double below = amplitude_[whole], t = x - static_cast<double>(whole);
    const double b = below + t * (amplitude_[whole + 1] - below);
    return b * b;
  }

  /// Least distance from the main lobe's middle, or a grating lobe's, beyond which B^2 stays below `floor`; that between
  /// two lobes if it does not.
  double reach(double floor) const;

  /// Whether an offset within [nearest, farthest], 0 <= nearest, stands no farther than `reach` from the middle of the main
  /// lobe or of a grating lobe.
  bool hears(double nearest, double farthest, double reach) const {
    if (nearest <= reach) return true;
    if (farthest < 2 * half_period_ - reach) return false;
    return at_grating_lobe(nearest, farthest, reach);
  }

 private:
  double folded(double offset) const;
  bool at_grating_lobe(double nearest, double farthest, double reach) const;

  double half_period_, per_unit_;
  std::vector<double> amplitude_;  // from offset 0 on, up to half a period of B^2, or 2
};

}  // namespace insonify
