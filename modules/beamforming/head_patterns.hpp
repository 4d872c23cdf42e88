#pragma once
#include <vector>

#include "acoustics/direct_echoes.hpp"
#include "beamforming/sonar_head.hpp"

namespace insonify {

/// `options` with the patterns of `head` that direct_echoes must apply; synthesize applies the rest (E14, E56, E57).
///
///   one row, no column        the two-way elevation pattern about the fan's elevation
///   a column                  the transmitter's elevation pattern, as wide as fan.elevation_width, about the middle
///                             between the lowest and the highest row
///   several rows, no column   no elevation pattern (elevation_width = 0): each row has its own
///
/// The transmitter's pattern in azimuth goes with all of them. Throws Error for a fan that is not valid.
EchoOptions with_patterns(EchoOptions options, const SonarHead& head);

/// How far above the highest and below the lowest beam [rad, > 0] scatterers may lie before all patterns of `head` are
/// below `floor_db` there: SamplingOptions::elevation_half_extent.
double sampled_half_extent(const SonarHead& head, double floor_db);

/// What a row of beams at `row_elevation` [rad] makes of an echo with direction cosine v upwards: pressure, 1 at the
/// row's own elevation. Of a head with a column its response (E56), else the elevation pattern (E14).
class RowResponse {
 public:
  RowResponse(const SonarHead& head, double wavelength, double row_elevation);
  double at(double v);

 private:
  const SonarHead& head_;
  double elevation_, v_, step_;
  std::vector<double> re_, im_;  // phases of the column's elements
};

}  // namespace insonify
