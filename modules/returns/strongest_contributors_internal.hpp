// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <limits>
#include <vector>

#include "acoustics/echo_stream.hpp"
#include "returns/detect_soundings.hpp"
#include "returns/ping.hpp"

namespace insonify {

/// A sample of one beam.
struct Pixel {
  std::uint32_t beam, bin;
};

/// The strongest echo that contributes to a sample, and its origin.
struct StrongestContributor {
  double power = 0;        ///< [Pa^2]; 0: there is none
  bool own_share = false;  ///< true: it lies in the beam's own cell of the fan
  Direction direction{};
  std::uint32_t surfel = 0;  ///< id of its surfel in the scene
  std::uint16_t material = 0;
};

/// Returns true if `a` ranks before `b`: contributors in the beam's own cell of the fan come first, then the stronger
/// one.
inline bool is_stronger(const StrongestContributor& a, const StrongestContributor& b) {
  return a.own_share == b.own_share ? a.power > b.power : a.own_share && a.power > 0;
}

/// Returns the strongest contributor of each pixel within one bin length. The search covers the beam's own cell of the
/// fan first, so that neighbouring beams do not report the same scatterer. Without a contributor there it covers the
/// beam's -3 dB width (in azimuth, and in elevation for a fan of several rows or a planar array). Only parts near the
/// pixels are visited. The result does not depend on options.threads.
///
/// pixels    ordered by beam, and within a beam by bin
/// options   scene and threads
std::vector<StrongestContributor> strongest_contributors(const std::vector<Pixel>& pixels, const EchoStream& stream,
                                                         const BeamFan& fan, const RangeGate& gate,
                                                         const DetectionOptions& options);

}  // namespace insonify
