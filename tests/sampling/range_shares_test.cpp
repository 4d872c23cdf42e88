// SPDX-License-Identifier: BSD-3-Clause
// Parts of a surfel stand for the surface of their ranges (E128).
#include "core/random.hpp"
#include "sampling/range_shares_internal.hpp"
#include "sampling/visible_surfels.hpp"
#include "sampling_scenes.hpp"

namespace {

const BeamFan beam = make_fan(1, 0, radians(10), radians(60));

/// Returns the fraction of a unit disc within distances a to b of a line through its middle, in closed form.
double strip(double a, double b) {
  const auto before = [](double x) { return 0.5 + (x * std::sqrt(1 - x * x) + std::asin(x)) / pi; };
  return before(b) - before(a);
}

/// Returns random places in a disc.
std::vector<float> random_places(std::size_t n) {
  std::vector<float> along;
  for (std::uint32_t k = 0; k < n; ++k) {
    const auto drawn = random_uniform(7, RandomStage::surfel_split, {k, 1, 2});
    along.push_back(static_cast<float>(std::sqrt(drawn[0]) * std::cos(2 * pi * drawn[1])));
  }
  return along;
}

/// Returns the parts of a level surfel of 1 m^2, 10 m ahead and 4 m below.
Scatterers level_parts(double range_resolution, double per_cell) {
  SceneCloud scene;
  add_surfel(scene, {10, 0, -4}, {0, 0, 1}, 1);
  const SamplingOptions options{.scatterers_per_cell = per_cell, .range_resolution = range_resolution};
  return find_scatterers(scene, Pose::Identity(), beam, {0.1, 50, 0.01}, options).scatterers;
}

/// Returns the surface of a part [m^2].
double surface(const Scatterers& s, std::size_t part) { return s.projected_area[part] / s.cos_incidence[part]; }

}  // namespace

TEST(RangeShares, are_the_strips_between_the_middles_of_neighbours) {
  RangeShares shares;
  const std::vector<float> along{0.5F, -0.5F, 0.25F, 0.9F};
  const std::span<const float> found = shares(along, 1);
  EXPECT_NEAR(found[1], strip(-1, -0.125), 2e-5);
  EXPECT_NEAR(found[2], strip(-0.125, 0.375), 2e-5);
  EXPECT_NEAR(found[0], strip(0.375, 0.7), 2e-5);
  EXPECT_NEAR(found[3], strip(0.7, 1), 2e-5);
  // Half of that and half of a quarter.
  EXPECT_NEAR(shares(along, 0.5)[2], 0.5 * strip(-0.125, 0.375) + 0.125, 2e-5);
  for (const float share : shares(along, 0)) EXPECT_EQ(share, 0.25F);
  EXPECT_EQ(shares(std::vector<float>{0.3F}, 1)[0], 1);
  EXPECT_TRUE(shares(std::vector<float>{}, 1).empty());
}

TEST(RangeShares, add_up_to_one_for_any_places) {
  RangeShares shares;
  std::vector<std::vector<float>> cases{random_places(4096), random_places(3), {1, 1, 1}, {-1, 1}, {0, 0, 0, 0, 0.5F}};
  cases.push_back({-1.0000001F, 1.0000001F, 0});
  for (const std::vector<float>& along : cases) {
    double sum = 0;
    for (const float share : shares(along, 1)) {
      EXPECT_GE(share, 0);
      sum += share;
    }
    EXPECT_NEAR(sum, 1, 1e-5) << along.size();
  }
}

TEST(RangeShares, do_not_depend_on_the_order_of_places) {
  const std::vector<float> along = random_places(1000);
  const std::vector<float> reversed(along.rbegin(), along.rend());
  RangeShares shares, other;
  const std::vector<float> found(shares(along, 1).begin(), shares(along, 1).end());
  const std::span<const float> backwards = other(reversed, 1);
  for (std::size_t k = 0; k < along.size(); ++k) ASSERT_EQ(found[k], backwards[along.size() - 1 - k]);
}

// Strips of a twentieth of the disc: parts with equal shares are off by as many as there are too few or too many of
// them.
TEST(RangeShares, give_each_range_the_surface_that_it_has) {
  const Scatterers s = level_parts(0.05, 50);
  const double radius = 1 / std::sqrt(pi);
  double squares = 0, squares_alike = 0;
  for (int k = -10; k < 10; ++k) {
    double found = -strip(0.1 * k, 0.1 * k + 0.1), alike = found;
    for (std::size_t i = 0; i < s.size(); ++i) {
      const double line = (s.range[i] * unit_vector({s.azimuth[i], s.elevation[i]}).x() - 10) / radius;
      const bool inside = line >= 0.1 * k && line < 0.1 * k + 0.1;
      found += inside * surface(s, i), alike += inside / static_cast<double>(s.size());
    }
    squares += found * found, squares_alike += alike * alike;
  }
  EXPECT_GT(s.size(), 100u);
  EXPECT_LT(squares, 0.5 * squares_alike);
}

TEST(RangeShares, are_alike_for_surfels_that_are_not_deeper_than_half_the_range_resolution) {
  const double depth = 2 / std::sqrt(pi) * 10 / std::hypot(10, 4);  // [m]
  const auto spread = [](double range_resolution) {
    const Scatterers s = level_parts(range_resolution, 500);
    double least = HUGE_VAL, most = 0, sum = 0;
    for (std::size_t k = 0; k < s.size(); ++k) {
      least = std::min(least, surface(s, k)), most = std::max(most, surface(s, k)), sum += surface(s, k);
    }
    EXPECT_GT(s.size(), 50u);
    EXPECT_NEAR(sum, 1, 1e-5);
    return (most - least) * static_cast<double>(s.size());
  };
  EXPECT_LT(spread(2.01 * depth), 1e-4);
  EXPECT_LT(spread(1.9 * depth), 0.5);
  EXPECT_GT(spread(0.5 * depth), 1);
}
