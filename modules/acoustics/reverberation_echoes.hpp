// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "acoustics/echoes.hpp"
#include "acoustics/environment.hpp"
#include "acoustics/transmission.hpp"
#include "core/pose.hpp"
#include "sonar/beam_fan.hpp"
#include "sonar/range_gate.hpp"

namespace insonify {

/// Division of water and boundaries into cells. Each cell gives one echo of complex-normal amplitude from a random
/// place within it. Mean level and correlation do not depend on the size of cells. The smaller the cells, the closer
/// the sum in a beam is to a Rayleigh distribution.
struct ReverberationOptions {
  double cells_per_resolution = 2;  ///< along range and along the fan, per resolution cell
  std::int64_t ping = 0;            ///< water and waves are new in every ping
  /// Extent of the cells beyond the outermost beams, in u; 0: 1.5 beam widths, beyond which side lobes of a head of
  /// many beams add less than 0.02 dB. For an array with further main lobes: pi, all directions ahead.
  double azimuth_margin = 0;
};

// All of these fill the gate, and a pulse's reach on either side of it, over the fan's sector in azimuth; the
// transmitter's pattern (E57) counts if there is one. The scene casts no shadow on them. The result does not depend on
// the thread count. They throw Error if the environment lacks the scattering strength, for invalid arguments, and for
// more than 2^27 cells.

/// Returns the echoes of the water's own scatterers (E49): the variance of a cell's amplitude is Sv dV 2 p0^2 / r^4,
/// with
///
///   dV = r^2 dr dtheta integral b_E^2(e) cos(e) de
///
/// b_E the two-way elevation pattern. The variance holds the pattern, so the echo is not weighted by it again: its
/// elevation is drawn from b_E^2 cos(e), which gives u and v their right distribution. A fan of several rows, or of a
/// planar array, has as many such echoes per cell as it resolves. The water goes on beyond surface and bottom.
Echoes volume_echoes(const Environment& environment, const BeamFan& fan, const RangeGate& gate,
                     const Transmission& transmission, const ReverberationOptions& options = {});

/// Returns the echoes of the sea surface from below (E50): scattering strength, the same at all angles, times the area
/// of each cell of the plane, weighted by the elevation pattern. Throws Error if the head is not below the surface.
Echoes surface_echoes(const Environment& environment, const Pose& world_from_head, const BeamFan& fan,
                      const RangeGate& gate, const Transmission& transmission,
                      const ReverberationOptions& options = {});

/// Returns the echoes of the flat bottom by Lambert's law, mu sin^2(grazing) dA (E51). Cells are bound to the world's
/// directions and to the position of the head, rounded to a range cell: a head that rests, or turns about its position, gets
/// echoes of the same bottom in every ping; a head that has moved gets echoes of another bottom. Throws Error if the
/// head is not above the bottom.
Echoes bottom_echoes(const Environment& environment, const Pose& world_from_head, const BeamFan& fan,
                     const RangeGate& gate, const Transmission& transmission, const ReverberationOptions& options = {});

/// Returns the scattering strength of the sea surface at `frequency` [Hz] for `wind_speed` [m/s] and `grazing` [rad],
/// in dB re 1 m^2 per m^2 (Chapman and Harris 1962, E50):
///
///   3.3 beta log10(grazing / 1 deg / 30) - 42.4 log10(beta) + 2.6,  beta = 158 (wind / 1 kn (f / 1 Hz)^(1/3))^-0.58
///
/// Fitted to explosive charges of 400 Hz to 6.4 kHz in winds up to 30 kn, below 40 degrees. Not for imaging
/// sonars: at 900 kHz it is far outside of what was measured, and nothing here uses it by default. Throws Error unless
/// frequency and wind speed are > 0 and grazing is within 0 and pi / 2, 0 excluded.
double chapman_harris_strength_db(double frequency, double wind_speed, double grazing);

}  // namespace insonify
