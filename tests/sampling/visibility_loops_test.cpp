// SPDX-License-Identifier: BSD-3-Clause
// Inner loops of visibility against the exact test and cell by cell.
#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include "sampling/hit_rule_internal.hpp"
#include "sampling/visibility_loops_internal.hpp"

namespace insonify {
namespace {

/// Random surfels between 2 and 60 m from the head, close to one line of sight.
std::vector<GatedSurfel> surfels_in_one_direction(std::size_t count) {
  std::mt19937 engine(11);
  std::normal_distribution<float> normal;
  std::uniform_real_distribution<float> uniform(0, 1);
  std::vector<GatedSurfel> surfels(count);
  for (GatedSurfel& s : surfels) {
    const float range = 2 + 58 * uniform(engine);
    s.position = range * Eigen::Vector3f(1, 0.004f * normal(engine), 0.004f * normal(engine)).normalized();
    s.range = s.position.norm();
    s.away = Eigen::Vector3f(normal(engine), normal(engine), normal(engine)).normalized();
    s.plane_distance = s.away.dot(s.position);
    if (s.plane_distance < 0) s.away = -s.away, s.plane_distance = -s.plane_distance;
    s.spacing = 0.02f + 0.3f * uniform(engine);
    s.radius = s.spacing, s.core = 0.65f * s.spacing;
    s.unevenness = s.spacing * uniform(engine), s.noise = 0.02f * uniform(engine);
  }
  return surfels;
}

TEST(VisibilityLoops, list_all_that_a_disc_covers_and_few_others) {
  const std::vector<GatedSurfel> surfels = surfels_in_one_direction(500);
  std::array<std::vector<float>, 6> numbers;
  for (const GatedSurfel& s : surfels) {
    const float of[] = {s.position.x(), s.position.y(), s.position.z(), s.unevenness, s.noise, 4e-6f * s.range};
    for (std::size_t k = 0; k < 6; ++k) numbers[k].push_back(of[k]);
  }
  for (auto& n : numbers) n.resize(surfels.size() + kernels::visibility_lanes, 0);
  const kernels::OpenSurfels open{numbers[0].data(), numbers[1].data(), numbers[2].data(),
                                  numbers[3].data(), numbers[4].data(), numbers[5].data()};
  // Two rows, of which the first ends inside a group of lanes.
  const std::array<std::uint32_t, 2> first{0, 205}, end{205, 500};
  std::vector<std::uint32_t> found(surfels.size() + 2 * kernels::visibility_lanes);
  std::size_t covered = 0, listed = 0;
  for (const GatedSurfel& s : surfels) {
    const Eigen::Vector3f &n = s.away, &p = s.position;
    const kernels::HidingDisc disc{{n.x(), n.y(), n.z()}, s.plane_distance,
                                   {p.x(), p.y(), p.z()}, 1.001f * hiding_reach * s.radius + 4e-6f * s.range,
                                   s.unevenness,          s.noise};
    const std::size_t count = kernels::list_behind(open, disc, first.data(), end.data(), 2, found.data());
    const std::set<std::uint32_t> list(found.begin(), found.begin() + static_cast<std::ptrdiff_t>(count));
    for (std::uint32_t k = 0; k < surfels.size(); ++k) {
      if (cover(s, LineOfSight(surfels[k])) == 0) continue;
      EXPECT_TRUE(list.contains(k)) << k;
      ++covered;
    }
    listed += list.size();
  }
  EXPECT_GT(covered, 1000u);
  EXPECT_LT(listed, covered + covered / 10);
}

TEST(VisibilityLoops, cells_of_a_box_are_raised_to_a_plane) {
  constexpr std::size_t stride = 64, rows = 20;
  for (const std::size_t columns : {1, 3, 16, 17, 40}) {
    std::vector<float> cells(stride * rows + kernels::visibility_lanes);
    for (std::size_t k = 0; k < cells.size(); ++k) cells[k] = static_cast<float>(k % 5);
    std::vector<float> raised = cells;
    kernels::raise_cells(raised.data() + 2 * stride + 5, stride, columns, 9, {1, 0.125f, 0.25f});
    for (std::size_t k = 0; k < cells.size(); ++k) {
      const std::size_t y = k / stride, x = k % stride;
      const bool in_box = y >= 2 && y < 11 && x >= 5 && x < 5 + columns;
      const float plane = 1 + 0.125f * static_cast<float>(x - 5) + 0.25f * static_cast<float>(y - 2);
      EXPECT_EQ(raised[k], in_box ? std::max(cells[k], plane) : cells[k]) << columns << " columns, " << k;
    }
  }
}

}  // namespace
}  // namespace insonify
