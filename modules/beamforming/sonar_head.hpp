#pragma once
#include <string>

#include "acoustics/elevation_pattern.hpp"
#include "acoustics/pulse.hpp"
#include "beamforming/line_array.hpp"
#include "beamforming/shading.hpp"
#include "sampling/beam_fan.hpp"
#include "sampling/range_gate.hpp"

namespace insonify {

/// A sonar: where it listens, when, with what array, and what it sends.
struct SonarHead {
  std::string name;
  BeamFan fan;
  RangeGate gate;
  LineArray array;
  Pulse pulse;
  ElevationShape elevation_shape = ElevationShape::gaussian;
};

/// Throws Error if any part is invalid, or if beams x bins or beams x elements exceed 2^28 (4 GiB of complex numbers).
void require_valid(const SonarHead& head, const char* who);

/// A shaded half-wavelength array whose broadside -3 dB width is `beam_width` [rad] as nearly as a whole number of
/// elements allows. side_lobe_db counts for Taylor and Chebyshev shading alone. At least one element.
LineArray array_for_beam_width(double beam_width, double wavelength, Shading shading, double side_lobe_db);

/// The coarsest bin that still samples the pulse [m]: 0.44 c / 2B.
double default_bin_size(const Pulse& pulse, double sound_speed);

}  // namespace insonify
