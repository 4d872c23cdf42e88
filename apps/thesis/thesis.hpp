// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "acoustics/direct_echoes.hpp"
#include "core/grid.hpp"
#include "sampling/scatterers.hpp"
#include "sonar/sonar_head.hpp"

// The simulation of chapter IV of A. Rascon, Forward-Looking Sonar Simulation Model for Robotic Applications (Naval
// Postgraduate School). The thesis describes its object in one sentence, "a matrix of diagonal lines in range-angle
// space", equally separated, extending 1.5 m; ranges and period below are a reconstruction that reproduces its figures.
namespace insonify::thesis {

constexpr double speed_of_sound = 1500;  ///< [m/s]
constexpr double field_of_view = 45;     ///< field of view of the BlueView P900-45 [deg]; the thesis does not state it
constexpr double beam_width = 0.1;       ///< [rad], Table 2
constexpr double ray_width = 0.0175;     ///< width of a ray's cell in azimuth and elevation [rad]
constexpr double lambert_mu = 1e-3;      ///< [1/sr]
constexpr double first_range = 1.5;      ///< range of the near end of the object [m]
constexpr double object_depth = 1.5;     ///< [m]
constexpr double printed_absorption = 0.0354;  ///< "dB/m at 900 kHz"

/// Table 2. The corrected spectrum of eq. 22 is exp(-(f - fc)^2 pi^2 / b^2) with b = 295 kHz: -3 dB width 110.6 kHz.
Pulse table_2_pulse();

/// 1500 m/s, absorption of sea water of 10 deg C by Francois and Garrison (E3).
Medium medium();

/// One of the three cases: columns of 21 rays, one column in each of 51, 101 or 256 beams.
struct Case {
  std::size_t beams = 51;
  std::size_t rays = 21;
  std::size_t period = 51;  ///< columns after which the diagonal lines repeat
};

/// The object; the scatterer of a ray has index column x rays + ray.
Scatterers make_object(const Case& which);

/// Range [m] of ray 11 in column 26, where the thesis cuts its slices.
double slice_range();

/// Echoes of the object (E7) with complex-normal amplitudes from `seed`.
Echoes echoes_of_object(const Scatterers& object, std::uint64_t seed = 1);

/// Echoes whose index passes `keep`.
template <typename Keep>
Echoes select(const Echoes& echoes, Keep keep) {
  Echoes kept;
  for (std::size_t i = 0; i < echoes.size(); ++i) {
    if (!keep(i)) continue;
    kept.delay.push_back(echoes.delay[i]);
    kept.u.push_back(echoes.u[i]);
    kept.amplitude.push_back(echoes.amplitude[i]);
  }
  return kept;
}

/// Uniform array of the length whose continuous line has the thesis' beam width: L = 0.442946 lambda / sin(0.05). 144
/// elements a sixteenth of a wavelength apart approximate the line; 18 elements half a wavelength apart are a real
/// array.
LineArray aperture(std::size_t elements);

/// The sonar: beams over the whole field of view, and a gate around the object.
SonarHead make_sonar(std::size_t beams, std::size_t elements = 144, double bin_size = 1e-3);

/// The series of each column alone, before beamforming, computed as in the thesis by spectrum and FFT: columns x bins
/// [Pa].
ComplexGrid column_series(const Echoes& echoes, const Case& which, const SonarHead& head);

/// The highest sample of a series near `range` [m], and the vertex of the parabola through it and its neighbours.
struct Peak {
  double sample_range = 0;  ///< [m]
  double range = 0;         ///< [m]
  double level_db = 0;      ///< dB re 1 uPa
};
Peak find_peak(const ComplexGrid& series, std::size_t row, const RangeGate& gate, double range, double within);

struct FigureOptions {
  std::string folder;
  int width = 900, height = 675;  ///< size of the charts [pixels]; images are five eighths of this
  double bin_size = 1e-3;         ///< bin size of the series [m]
};

/// Writes figures 13 to 21 of the thesis, and three that explain them, as PNG files into the folder; prints the name of
/// each, and the numbers measured in them as rows of a markdown table.
void draw_figures(const FigureOptions& options);

/// Prints Table 4 of the thesis beside our run times as a markdown table: medians of `runs` runs.
void print_run_times(const std::vector<std::size_t>& beam_counts, int runs);

}  // namespace insonify::thesis
