// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <memory>
#include <optional>
#include <string>

#include "sonar/beam_fan.hpp"
#include "sonar/elevation_pattern.hpp"
#include "sonar/line_array.hpp"
#include "sonar/pulse.hpp"
#include "sonar/range_gate.hpp"
#include "sonar/shading.hpp"

namespace insonify {

class ReceiveArray;
struct SonarHead;
std::unique_ptr<const ReceiveArray> line_or_plane(const SonarHead& head);  ///< E10, E56
std::unique_ptr<const ReceiveArray> curved_array(const SonarHead& head);   ///< E205

/// Shape of the receive array.
enum class ArrayShape {
  line,   ///< a line along the port-starboard axis; with `column` a plane of such lines
  curved  ///< an arc about the head's origin, in its x-y plane
};

/// A kind of receive array as sonar files name it.
struct ArrayKind {
  const char* name;                                                    ///< word in sonar files
  bool has_radius;                                                     ///< true: array_radius is given
  std::unique_ptr<const ReceiveArray> (*make)(const SonarHead& head);  ///< makes the array of a head
};

/// The kinds of receive arrays, in the order of ArrayShape. This list is the table to which a new kind adds a row.
inline constexpr ArrayKind array_kinds[] = {{"line", false, line_or_plane}, {"curved", true, curved_array}};

/// A sonar head: listening directions, range gate, receive array and transmit pulse.
struct SonarHead {
  std::string name;
  BeamFan fan;
  RangeGate gate;
  LineArray array;
  Pulse pulse;
  ElevationShape elevation_shape = ElevationShape::gaussian;
  double transmit_width = 0;          ///< -3 dB width in azimuth of the transmitter [rad]; 0: uniform over the fan
  std::optional<LineArray> column{};  ///< vertical array of a planar array, the same for all columns
  ArrayShape array_shape = ArrayShape::line;  ///< shape of the line on which the elements of `array` stand
  double array_radius = 0;                    ///< radius of an array that is bent [m]

  bool operator==(const SonarHead&) const = default;
};

/// Throws Error if any part is invalid; if only one of column and fan.row_width is given; if the kind of array cannot
/// form the beams; or if beams x bins, beams x elements of `array`, or elements of `array` x those of `column` exceed
/// 2^28 (4 GiB of complex numbers).
void require_valid(const SonarHead& head, const char* who);

/// Returns the directivity index [dB] of the beam straight ahead in isotropic noise, exact for omnidirectional
/// elements: that of the line array (E34), of all elements of the planar array, summed over pairs (E56), or of another
/// array (E206):
///   -10 log10( sum_ij w_i w_j sin(k d_ij) / (k d_ij) / (sum_i w_i)^2 )
/// A large half-wavelength grid of N uniform elements approaches 10 log10(N pi / 2), since it receives from behind as
/// well.
double directivity_index_db(const SonarHead& head, double wavelength);

/// Returns the array gain [dB] against noise that is independent in every element: 10 log10((sum w)^2 / sum w^2) over
/// all elements, 10 log10(N) for uniform ones. The level of synthesize_noise is the element level minus this gain.
double array_gain_db(const SonarHead& head);

/// Returns a shaded half-wavelength array whose -3 dB width at broadside is as close to `beam_width` [rad] as an
/// integer number of elements (at least one) permits. side_lobe_db is used by Taylor and Chebyshev shading only. Throws
/// Error unless beam_width > 0 and at most 16384 elements are needed.
///
/// head   array_shape and array_radius of the head are those of the array; default: a line
LineArray array_for_beam_width(double beam_width, double wavelength, Shading shading, double side_lobe_db,
                               const SonarHead& head = {});

/// Returns the coarsest bin size that samples the pulse sufficiently [m]: 0.44 c / 2B.
double default_bin_size(const Pulse& pulse, double sound_speed);

}  // namespace insonify
