// SPDX-License-Identifier: BSD-3-Clause
// Echoes and heads of tests of display cells.
#pragma once
#include <cmath>
#include <complex>
#include <cstdint>
#include <vector>

#include "acoustics/direct_echoes.hpp"
#include "beamforming/synthesize_cells.hpp"
#include "core/random.hpp"
#include "core/units.hpp"
#include "returns/looks.hpp"
#include "support/heads.hpp"

namespace insonify::cell_tests {

inline constexpr double bandwidth = 60e3, centre = 750e3;
inline const Medium lossy{1490, {0.02, 2e-8, 1e-14}}, lossless{1490, {}};

inline SonarHead samples_head(std::size_t beams = 9, std::size_t elements = 32) {
  return line_head({.beams = beams, .elements = elements, .field_of_view_deg = 100, .min_range = 2, .max_range = 3});
}

inline SonarHead cells_head(SonarHead head, int cells) {
  head.gate = display_gate(head.gate, cells);
  return head;
}

/// Returns echoes evenly over range 1.9 to 3.1 m and all u, of unit mean power [Pa^2].
inline SurfaceEchoes even_ground(std::size_t count, std::uint64_t seed = 1) {
  SurfaceEchoes s;
  for (std::size_t i = 0; i < count; ++i) {
    const auto at = random_uniform(seed, RandomStage::scene_points, {i, 0, 0});
    const double range = 1.9 + 1.2 * at[0];
    s.echoes.delay.push_back(2 * range / lossy.sound_speed);
    s.echoes.u.push_back(2 * at[1] - 1);
    s.echoes.amplitude.push_back(std::polar(1.0, 4 * pi * range * centre / lossy.sound_speed));
    s.id.push_back(i);
  }
  s.power.assign(count, 1), s.depth.assign(count, 0), s.width.assign(count, 0);
  return s;
}

/// Returns the echoes with the random amplitudes of a seed.
inline Echoes drawn(const SurfaceEchoes& s, std::uint64_t seed) {
  Echoes echoes = s.echoes;
  std::vector<double> re(s.id.size()), im(s.id.size());
  random_amplitudes(seed, s.id, re.data(), im.data());
  for (std::size_t i = 0; i < re.size(); ++i) echoes.amplitude[i] *= std::complex(re[i], im[i]);
  return echoes;
}

inline double worst_db(const Grid<double>& a, const Grid<double>& b) { return (10 * (a / b).log10()).abs().maxCoeff(); }

}  // namespace insonify::cell_tests
