// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "acoustics/multipath_echoes.hpp"
#include "support/heads.hpp"
#include "support/test.hpp"

using Eigen::Vector3d;

/// A head at depth 2 m, level, under a flat surface at 0 and above a bottom at -10 m.
struct Setting {
  SceneCloud scene;
  Environment environment;
  View view{Pose::Identity(), make_fan(91, radians(90), radians(1), radians(90)), {0.5, 60, 0.01}, {}};
  Transmission sent{pulse_900k, {1500, {0.2994626 * nepers_per_db, 0, 0}}, {.amplitude = SurfaceAmplitude::coherent}};

  Setting() {
    environment.surface = SeaSurface{};
    environment.bottom = FlatBottom{-10};
    view.world_from_head.translation() = Vector3d(0, 0, -2);
    view.sampling.scatterers_per_cell = 0;
    view.sampling.elevation_half_extent = pi / 2;
  }

  Scatterers direct() const {
    return find_scatterers(scene, view.world_from_head, view.fan, view.gate, view.sampling).scatterers;
  }
  Multipath compute(const MultipathOptions& options = {}) const {
    return multipath_echoes(scene, direct(), environment, view, sent, options);
  }
};

inline const Vector3d target(20, 0, -3);
inline constexpr double mu = 0.1, target_area = 1e-4;

inline Setting one_target(const Vector3d& position = target, const Vector3d& normal = {-1, 0, 0}) {
  Setting s;
  s.scene.materials = {{"m", mu}};
  add_surfel(s.scene, position, normal, target_area);
  return s;
}

/// Adds a plate of 2 m that faces the head, from z = low to high.
inline void add_plate(SceneCloud& scene, double x, double low, double high) {
  for (int j = -20; j <= 20; ++j)
    for (int k = 0; k <= std::lround((high - low) / 0.05); ++k)
      add_surfel(scene, {x, 0.05 * j, low + 0.05 * k}, {-1, 0, 0}, 0.0025);
}

/// Returns the sum of the echoes within half a millimetre of an apparent range.
inline std::complex<double> sum_at(const Echoes& e, double range) {
  std::complex<double> sum = 0;
  for (std::size_t i = 0; i < e.size(); ++i)
    if (std::abs(750 * e.delay[i] - range) < 5e-4) sum += e.amplitude[i];
  return sum;
}

inline const double r_direct = std::hypot(20, 1), r_surface = std::hypot(20, 5), r_bottom = std::hypot(20, 15);

inline double level_after_absorption(std::complex<double> amplitude, double range) {
  return pressure_level_db(std::abs(amplitude)) - 2 * 0.2994626 * range;
}
