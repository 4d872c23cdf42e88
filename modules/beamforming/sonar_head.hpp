#pragma once
#include <optional>
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
  double transmit_width = 0;          ///< -3 dB width in azimuth of the transmitter [rad]; 0: fills the fan evenly
  std::optional<LineArray> column{};  ///< of a planar array: its shading and spacing upwards, the same for all columns
};

/// Throws Error if any part is invalid; if a column comes without fan.row_width or the other way round; or if beams x
/// bins, beams x elements of `array`, or elements of `array` x those of `column` exceed 2^28 (4 GiB of complex numbers).
void require_valid(const SonarHead& head, const char* who);

/// Directivity index of the beam straight ahead [dB] for isotropic noise, exact for omnidirectional elements: that of the
/// line array (E34), or of all elements of the planar array, summed over pairs (E56):
///   -10 log10( sum_ij w_i w_j sin(k d_ij) / (k d_ij) / (sum_i w_i)^2 )
/// A large half-wavelength grid of N uniform elements nears 10 log10(N pi / 2): it hears behind it as well as ahead.
double directivity_index_db(const SonarHead& head, double wavelength);

/// What a beam gains against noise that every element hears on its own [dB]: 10 log10((sum w)^2 / sum w^2) over all
/// elements, N for uniform ones. Element level less this is the level of synthesize_noise.
double array_gain_db(const SonarHead& head);

/// A shaded half-wavelength array whose broadside -3 dB width is `beam_width` [rad] as nearly as a whole number of
/// elements allows. side_lobe_db counts for Taylor and Chebyshev shading alone. At least one element.
LineArray array_for_beam_width(double beam_width, double wavelength, Shading shading, double side_lobe_db);

/// The coarsest bin that still samples the pulse [m]: 0.44 c / 2B.
double default_bin_size(const Pulse& pulse, double sound_speed);

}  // namespace insonify
