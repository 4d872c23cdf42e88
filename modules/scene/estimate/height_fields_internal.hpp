// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

#include <Eigen/Core>

#include "core/parallel.hpp"
#include "scene/estimate/distinct_points_internal.hpp"
#include "scene/scene_index.hpp"

// Private to scene: the height fields of a cloud.
namespace insonify::cells {

inline constexpr std::size_t around = 17;  // points that decide together

// Returns the numbers below `count`.
inline std::vector<std::uint32_t> all_of(std::size_t count) {
  std::vector<std::uint32_t> all(count);
  std::iota(all.begin(), all.end(), 0u);
  return all;
}

// Points as seen from above.
struct Plan {
  std::vector<std::uint32_t> points;  // all points but those that hang alone over the others
  std::vector<std::uint8_t> single;   // 1 for each point of the cloud that belongs to a height field
};

// Finds height fields, which have one height at each position: none of the four links of a point to its neighbours is
// steeper than five to one, or at most a third of those around are. Surfaces one above the other have more. `index` is
// that of the points on the plan, `flat`.
inline Plan find_height_fields(const Estimate& e, const std::vector<Vector3f>& flat, const SceneIndex& index,
                               int threads) {
  const std::vector<Vector3f>& points = e.position;
  constexpr std::size_t links = 4;
  Plan plan;
  plan.single.resize(points.size());
  std::vector<std::uint8_t> steep(points.size()), hangs(points.size());
  parallel_blocks(points.size(), 1024, threads, [&](std::size_t begin, std::size_t end) {
    std::vector<Neighbour> nearest;
    for (std::size_t k = begin; k < end; ++k) {
      const std::uint32_t i = e.visit[k];
      index.find_nearest(flat[i], links + 1, nearest);
      const auto steeper_than = [&](float slope) {
        return static_cast<std::size_t>(std::count_if(nearest.begin(), nearest.end(), [&](const Neighbour& n) {
          const float rise = points[n.index].z() - points[i].z();
          return rise * rise > slope * slope * n.squared_distance;
        }));
      };
      steep[i] = static_cast<std::uint8_t>(steeper_than(5));
      hangs[i] = steeper_than(16) >= links;
    }
  });
  parallel_blocks(points.size(), 1024, threads, [&](std::size_t begin, std::size_t end) {
    std::vector<Neighbour> nearest;
    for (std::size_t k = begin; k < end; ++k) {
      const std::uint32_t i = e.visit[k];
      plan.single[i] = steep[i] == 0;
      if (plan.single[i] || hangs[i]) continue;
      index.find_nearest(flat[i], around, nearest);
      std::size_t sum = 0;
      for (const Neighbour& n : nearest) sum += steep[n.index];
      plan.single[i] = 3 * sum <= links * nearest.size();
    }
  });
  for (std::uint32_t i = 0; i < points.size(); ++i)
    if (!hangs[i]) plan.points.push_back(i);
  return plan;
}

}  // namespace insonify::cells
