// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <limits>
#include <optional>
#include <vector>

#include "sonar/line_array.hpp"

namespace insonify {

/// Properties of the pattern of one beam of a line array between endfire and endfire (azimuth -pi/2 .. pi/2 in the
/// plane of the array: u = sin(azimuth), positive to port).
struct BeamPatternReport {
  /// Full -3 dB width of the steered beam [rad] (E35). A flank still above -3 dB at endfire ends there.
  double width = 0;
  /// Angle between the beam and its nearest null [rad], on the side towards broadside; absent if there is none. For a
  /// response without a zero crossing: its first minimum.
  std::optional<double> first_null;
  /// Highest level outside of main lobe and grating lobes [dB re the beam's peak], -inf if there is none, and its
  /// azimuth [rad], on the side towards broadside if it occurs on both. The flank of a grating lobe that peaks beyond
  /// endfire counts as a side lobe.
  double highest_side_lobe_db = -std::numeric_limits<double>::infinity();
  double highest_side_lobe = 0;
  /// Azimuths of full copies of the main lobe [rad], ascending (E33).
  std::vector<double> grating_lobes;
  /// Directivity index for isotropic noise [dB] (E34).
  double directivity_index_db = 0;
};

/// Measures the pattern of the beam steered to azimuth `steering` [rad]. Angles are accurate to 1e-9 in u, levels to
/// 1e-6 dB. Throws Error unless the array is valid, wavelength > 0 [m] and |steering| <= pi/2.
BeamPatternReport measure_beam_pattern(const LineArray& array, double wavelength, double steering);

/// The pattern as a curve for plotting: level [dB re the beam's peak, -inf in a null] over azimuth [rad] from -pi/2 to
/// pi/2, with at least 16 points per lobe and one in each null. Throws as measure_beam_pattern does.
struct BeamPatternCurve {
  std::vector<double> azimuth, level_db;
};
/// Returns the curve of the beam steered to azimuth `steering` [rad].
BeamPatternCurve beam_pattern_curve(const LineArray& array, double wavelength, double steering);

}  // namespace insonify
