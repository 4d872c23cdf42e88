// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <span>

#include "acoustics/echoes.hpp"
#include "acoustics/surface_scattering.hpp"
#include "sonar/elevation_pattern.hpp"
#include "sonar/pulse.hpp"
#include "sonar/water.hpp"

namespace insonify {

/// Patterns of the head, and amplitudes of the surface.
struct EchoOptions {
  SurfaceAmplitude amplitude = SurfaceAmplitude::complex_normal;
  ElevationShape elevation_shape = ElevationShape::gaussian;
  double elevation_width = 0;   ///< [rad]; 0: no elevation pattern
  double elevation_centre = 0;  ///< [rad]
  std::uint64_t seed = 1;
  int threads = 0;            ///< 0: all cores
  double transmit_width = 0;  ///< -3 dB width of the transmitter's one-way intensity in azimuth [rad]; 0: no pattern
};

/// Values that all echoes of one ping share.
struct Transmission {
  Pulse pulse;
  Medium medium;
  EchoOptions echo_options;
  SurfaceTable surfaces{};  ///< laws of the scene's materials (surface_table); empty: surfaces_of makes them
};

/// Returns the surfaces of a transmission, or those of `materials` if it has none. Throws Error unless there is one for
/// each.
SurfaceTable surfaces_of(const Transmission& sent, std::span<const Material> materials);

}  // namespace insonify
