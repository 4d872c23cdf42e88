// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "sonar/sonar_head.hpp"

namespace insonify {

/// Sound speed for which arrays are designed and datasheets state range resolution [m/s].
constexpr double nominal_sound_speed = 1500;

/// A sonar in the terms of a datasheet, in SI units and radians; make_head converts it to a SonarHead.
struct SonarSpec {
  std::string name;
  double centre_frequency = 0;   ///< [Hz]
  double bandwidth = 0;          ///< full -3 dB width [Hz]; c_nominal / (2 range resolution)
  double source_level_db = 220;  ///< dB re 1 uPa at 1 m
  std::size_t beams = 1;
  double field_of_view = 0;    ///< [rad]
  double beam_width = 0;       ///< -3 dB width in azimuth [rad]
  double elevation = 0;        ///< elevation of the fan's axis [rad], positive up
  double elevation_width = 0;  ///< -3 dB width in elevation [rad]
  ElevationShape elevation_shape = ElevationShape::gaussian;
  double side_lobe_db = -30;         ///< level of Taylor and Chebyshev side lobes; 0: uniform array
  std::optional<Shading> shading;    ///< absent: Taylor if side_lobe_db < 0, else uniform
  double min_range = 0;              ///< [m]
  double max_range = 0;              ///< [m]
  std::optional<double> bin_size;    ///< [m]; absent: 0.44 c / 2B
  std::vector<double> azimuths;      ///< [rad]; if not empty, these beams instead of an even fan
  std::vector<double> elevations{};  ///< [rad]; with azimuths: one per beam; without: one row of `beams` beams each
  double column_beam_width = 0;      ///< -3 dB width in elevation of a planar array's beam [rad]; 0: a line array
  ArrayShape array = ArrayShape::line;
  double array_radius = 0;    ///< radius of an array that is bent [m]; 0: a line
  double transmit_width = 0;  ///< -3 dB width in azimuth of the transmitter [rad]; 0: fills the fan evenly
  PulseShape pulse = PulseShape::gaussian;
  std::optional<double> pulse_length{};           ///< duration of a sweep [s]
  std::optional<ReplicaWindow> replica_window{};  ///< window of its matched filter; absent: Hamming
};

/// Returns the number of beams of the head that make_head builds: rows times `beams`, or one per listed azimuth.
std::size_t beams_of(const SonarSpec& spec);

/// Returns the shading of the array that make_head builds.
Shading shading_of(const SonarSpec& spec);

/// Throws Error unless the spec describes a sonar that can be built; names key, value, unit and rule.
void require_valid(const SonarSpec& spec, const char* who);

/// Returns the head for water of `sound_speed` [m/s]. The array has half-wavelength spacing at the nominal sound speed
/// and as many elements as the beam width requires (E10, E205) under its shading (E11, E31, E32), and so has the column
/// of a planar array. Rows of beams follow the order of `elevations`. Throws Error for an invalid spec, or a bin_size
/// that would under-sample the pulse (more than 0.44 c / 2B).
SonarHead make_head(const SonarSpec& spec, double sound_speed);

}  // namespace insonify
