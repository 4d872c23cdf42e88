// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "acoustics/refract_paths.hpp"
#include "support/test.hpp"

namespace insonify::bent {

inline const SoundSpeedProfile layers{{0, 3, 8, 9, 20, 40}, {1512, 1511, 1498, 1500, 1495, 1496}};
inline const SoundSpeedProfile duct{{0, 20, 40}, {1520, 1480, 1520}};

inline SoundSpeedProfile random_profile(std::mt19937_64& random, int entries, double largest_gradient) {
  std::uniform_real_distribution<double> unit(0, 1);
  SoundSpeedProfile p{{0}, {1450 + 100 * unit(random)}};
  while (static_cast<int>(p.depth.size()) < entries) {
    const double height = 0.5 + 10 * unit(random);
    const double gradient = unit(random) < 0.15 ? 0 : largest_gradient * (2 * unit(random) - 1);
    p.depth.push_back(p.depth.back() + height);
    p.sound_speed.push_back(std::clamp(p.sound_speed.back() + gradient * height, 1310.0, 1690.0));
  }
  return p;
}

}  // namespace insonify::bent
