// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cmath>
#include <cstdint>

#include "core/grid.hpp"
#include "core/random.hpp"
#include "core/units.hpp"

namespace insonify {

/// Returns the levels of a smooth scene [dB]: hills and valleys of +-10 dB, 40 dB on average.
inline Grid<float> smooth_scene(Eigen::Index beams, Eigen::Index bins) {
  Grid<float> level(beams, bins);
  for (Eigen::Index i = 0; i < beams; ++i)
    for (Eigen::Index j = 0; j < bins; ++j)
      level(i, j) = static_cast<float>(40 + 10 * std::sin(0.01 * static_cast<double>(i)) *
                                                std::cos(0.008 * static_cast<double>(j)));
  return level;
}

/// Returns the levels with independent speckle of so many looks.
inline Grid<float> with_speckle(Grid<float> level, std::uint64_t seed, int looks = 1) {
  for (Eigen::Index i = 0; i < level.size(); ++i) {
    double power = 0;
    for (int look = 0; look < looks; ++look)
      power += std::norm(random_complex_normal(seed, RandomStage::scene_points,
                                               {static_cast<std::uint64_t>(i), static_cast<std::uint64_t>(look), 0}));
    level(i) += static_cast<float>(db_from_power(power / looks));
  }
  return level;
}

}  // namespace insonify
