// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <vector>

#include "core/grid.hpp"

namespace insonify::tool {

/// How many samples have which level, in steps of 0.25 dB within 500 dB of 0.
class LevelCounts {
 public:
  void add(const Grid<float>& level_db) {
    for (const float level : level_db.reshaped()) {
      if (!std::isfinite(level)) continue;
      const float step = std::floor((level - least_db) / step_db);
      ++counts_[static_cast<std::size_t>(std::clamp(step, 0.0F, static_cast<float>(steps - 1)))];
    }
  }
  /// The level that a share of the samples exceeds; 0 without samples.
  double exceeded_by(double share) const {
    double left = share * std::accumulate(counts_.begin(), counts_.end(), 0.0);
    for (std::size_t step = steps; step-- > 0;)
      if ((left -= static_cast<double>(counts_[step])) < 0)
        return static_cast<double>(least_db) + static_cast<double>(step_db) * static_cast<double>(step + 1);
    return 0;
  }

 private:
  static constexpr float step_db = 0.25F, least_db = -500;
  static constexpr std::size_t steps = 4000;
  std::vector<std::size_t> counts_ = std::vector<std::size_t>(steps);
};

}  // namespace insonify::tool
