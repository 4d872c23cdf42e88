// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "tool/image/image.hpp"

namespace insonify::tool {

/// Levels of the chosen beam (--beam) in all pings of a run, by slant range. Throws Error(content) for a run of one
/// ping, Error(argument) as choose_beam.
PingHistory beam_history(const ImageRun& run, const ImageOptions& options);

/// Height of the head above the flat bottom in each ping [m]: --altitude, or by the pose above --bottom; empty if
/// neither is given. Throws Error(argument) for a height that is not above the bottom.
std::vector<double> altitudes_of(const ImageRun& run, const ImageOptions& options);

/// A history by slant range drawn on a flat and level bottom `altitude[ping]` below the head: at ground range g the
/// sample at slant range sqrt(g^2 + altitude^2), in bins of the same size from 0 to where the lowest ping ends; what
/// arrives from the water before the bottom is left out, and ground not reached is silent. Throws Error(argument)
/// unless each altitude is below the range.
PingHistory on_flat_bottom(const PingHistory& slant, const std::vector<double>& altitude);

/// Port and starboard of one line as one history: ranges to port to the left, to starboard to the right, and silence
/// between them where neither has samples. Throws Error(content) unless both have the same gate and number of pings.
PingHistory side_by_side(const PingHistory& port, const PingHistory& starboard);

}  // namespace insonify::tool
