// SPDX-License-Identifier: BSD-3-Clause
// Distances of distributions, lines and maps of levels (E121).
#include "compare/level_statistics.hpp"

#include "support/test.hpp"

TEST(LevelStatistics, wasserstein_1_of_shifted_samples_is_the_shift) {
  EXPECT_DOUBLE_EQ(wasserstein_1({3, 1, 2}, {5, 4, 6}), 3);
  EXPECT_DOUBLE_EQ(wasserstein_1({0, 1}, {0, 1, 0, 1}), 0);
  EXPECT_DOUBLE_EQ(wasserstein_1({0, 0}, {0, 1}), 0.5);  // half of the mass goes 1 far
  EXPECT_NEAR(wasserstein_1({0}, {1, 2, 6}), 3, 1e-12);
  expect_error(ErrorKind::argument, {"wasserstein_1", "empty"}, [] { wasserstein_1({}, {1}); });
}

TEST(LevelStatistics, kolmogorov_smirnov_has_the_distance_and_its_probability) {
  const KolmogorovSmirnov apart = kolmogorov_smirnov({1, 2, 3, 4}, {3, 4, 5, 6});
  EXPECT_DOUBLE_EQ(apart.distance, 0.5);
  EXPECT_EQ(apart.samples, 4U);
  EXPECT_DOUBLE_EQ(kolmogorov_smirnov({1, 2}, {1, 2}).distance, 0);
  // Quantiles of the exponential law itself, and of another mean: D = max |exp(-x) - exp(-x / 2)| = 1 / 4.
  std::vector<double> exact, twice;
  for (int i = 0; i < 2000; ++i) exact.push_back(-std::log1p(-(i + 0.5) / 2000)), twice.push_back(2 * exact.back());
  EXPECT_NEAR(kolmogorov_smirnov_exponential(exact).distance, 0.5 / 2000, 1e-9);
  EXPECT_GT(kolmogorov_smirnov_exponential(exact).probability, 0.999);
  EXPECT_NEAR(kolmogorov_smirnov_exponential(twice).distance, 0.25, 1e-3);
  EXPECT_LT(kolmogorov_smirnov_exponential(twice).probability, 1e-6);
  // Kolmogorov's table: the probability of sqrt(n) D > 1.36 is 0.05.
  std::vector<double> shifted;
  for (int i = 0; i < 2000; ++i)
    shifted.push_back(-std::log1p(-std::min(1 - 1e-9, (i + 0.5) / 2000 + 1.358 / std::sqrt(2000.0))));
  EXPECT_NEAR(kolmogorov_smirnov_exponential(shifted).probability, 0.05, 0.005);
}

TEST(LevelStatistics, a_line_is_fitted_by_least_squares) {
  const FittedLine line = fit_line({0, 1, 2, 3}, {1, 3.5, 4.5, 7});
  EXPECT_NEAR(line.slope, 1.9, 1e-12);
  EXPECT_NEAR(line.offset, 1.15, 1e-12);
  EXPECT_EQ(fit_line({2, 2}, {1, 3}).slope, 0);
}

TEST(LevelStatistics, a_map_of_levels_is_that_which_was_applied) {
  std::vector<double> level, bent;
  for (int i = 0; i < 5000; ++i)
    level.push_back(0.01 * i), bent.push_back(5 + 2 * level.back() + 0.02 * level.back() * level.back());
  std::reverse(bent.begin(), bent.end());  // pairs do not matter
  const LevelMap map = level_map(level, bent);
  EXPECT_EQ(map.from.size(), 21U);
  EXPECT_TRUE(std::is_sorted(map.to.begin(), map.to.end()));
  for (const double l : {0.0, 3.0, 20.0, 44.4, 49.9}) EXPECT_NEAR(mapped(map, l), 5 + 2 * l + 0.02 * l * l, 0.05) << l;
  EXPECT_NEAR(mapped(map, -1), 4, 1e-9);  // beyond the knots by slope 1
  EXPECT_EQ(mapped(level_map({7, 7, 7}, {1, 2, 3}), 7), 1);
}
