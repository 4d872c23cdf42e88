// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "sonar/beam_fan.hpp"

namespace insonify {

/// Shape of a head's pattern in elevation (E14).
enum class ElevationShape {
  gaussian,  ///< main lobe only: -3 dB at half the width, -12 dB at the width, no side lobes
  line,      ///< uniform line aperture of that -3 dB width: sinc with side lobes from -13 dB
  sector     ///< 1 inside the width, 0 outside
};

/// Returns the pressure response of a Gaussian main lobe without side lobes, 2^(-2 (off_axis / width)^2) (E14, E57): 1
/// on the axis; its intensity is -3 dB at width / 2 and -12 dB at width [rad].
double gaussian_lobe(double width, double off_axis);

/// Returns the two-way pressure response in elevation (transmit times receive), 1 on the axis (E14); `width` is the
/// full -3 dB width of the two-way intensity [rad], `elevation_off_centre` the angle from the axis [rad].
double elevation_response(ElevationShape shape, double width, double elevation_off_centre);

/// Returns the half-angle [rad] beyond which the pattern stays below `floor_db` (gaussian), or the whole half space
/// (line). Surfels beyond this angle need not be sampled.
double elevation_half_extent(ElevationShape shape, double width, double floor_db);

}  // namespace insonify
