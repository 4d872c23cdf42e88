// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <vector>

#include "acoustics/direct_echoes.hpp"
#include "sonar/sonar_head.hpp"

namespace insonify {

/// Returns `options` with the patterns of `head` that direct_echoes must apply; synthesize applies the rest (E14, E56,
/// E57).
///
///   one row, no column        the two-way elevation pattern about the fan's elevation
///   a column                  the transmitter's elevation pattern, as wide as fan.elevation_width, about the middle
///                             between the lowest and the highest row
///   several rows, no column   no elevation pattern (elevation_width = 0): synthesize applies that of each row
///
/// All include the transmitter's azimuth pattern. Throws Error for an invalid fan.
EchoOptions with_patterns(EchoOptions options, const SonarHead& head);

/// Returns the elevation margin [rad, > 0] above the highest and below the lowest beam within which any pattern of
/// `head` exceeds `floor_db`: SamplingOptions::elevation_half_extent.
double sampled_half_extent(const SonarHead& head, double floor_db);

/// Pressure response of a row of beams at `row_elevation` [rad] to an echo with upward direction cosine v, 1 at the
/// row's own elevation: the response of the head's column (E56) if it has one, else the elevation pattern (E14).
class RowResponse {
 public:
  /// Keeps a reference to `head`, which must outlive it; wavelength [m], row_elevation [rad].
  RowResponse(const SonarHead& head, double wavelength, double row_elevation);
  /// Returns the response to an echo with upward direction cosine v.
  double at(double v);

 private:
  const SonarHead& head_;
  double elevation_, v_, step_;
  std::vector<double> re_, im_;  // phases of the column's elements
};

}  // namespace insonify
