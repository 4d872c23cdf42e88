// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "sonar/line_array.hpp"
#include "sonar/pulse.hpp"
#include "sonar/shading.hpp"
#include "sonar/sonar_spec.hpp"

namespace insonify {

/// Speeds of sound [m/s] of most tests, and the pulse of the published model (900 kHz).
inline constexpr double c0 = 1500, c0_cold = 1490;
inline const Pulse pulse_900k{900e3, 29.5e3, 220};
inline constexpr double wavelength_900k = c0 / 900e3;

/// Returns a uniform line of n elements.
inline LineArray uniform_line(std::size_t n, double pitch_in_wavelengths) {
  return {pitch_in_wavelengths * wavelength_900k, uniform_shading(n)};
}

/// A small multibeam sonar; all of these work at 450 kHz with 20 kHz of bandwidth.
struct SmallSonar {
  std::size_t beams = 48;
  double field_of_view_deg = 60, beam_width_deg = 2, elevation_width_deg = 20;
  double min_range = 2, max_range = 15;
  double source_level_db = 220;
};
SonarSpec small_sonar(const SmallSonar& sonar);
/// Returns its head, for water of `sound_speed` or, with 0, for Water{}.
SonarHead small_head(const SmallSonar& sonar, double sound_speed = 0);

/// Returns nine beams over 40 degrees, ranges 1 to 12 m, some 700 bins; its head is for water of 1500 m/s.
SonarSpec nine_beams();
SonarHead nine_beam_head();

/// A head put together by hand: a half-wavelength line array under a Taylor window of -30 dB, uniform if it has at most
/// four elements, and bins as coarse as the pulse allows.
struct LineHead {
  double frequency = 750e3, bandwidth = 60e3, source_level_db = 220;
  std::size_t beams = 5, elements = 16;
  double field_of_view_deg = 90, beam_width_deg = 2, elevation_width_deg = 20;
  double min_range = 1, max_range = 3;
  double sound_speed = 1490;
};
SonarHead line_head(const LineHead& line);

/// Returns the relative L2 difference of two grids.
template <typename A, typename B>
double relative_l2(const A& a, const B& b) {
  return std::sqrt((a - b).abs2().sum() / b.abs2().sum());
}

/// Returns true if two grids have one shape and equal numbers.
template <typename A, typename B>
bool same(const A& a, const B& b) {
  return a.rows() == b.rows() && a.cols() == b.cols() && (a == b).all();
}

}  // namespace insonify
