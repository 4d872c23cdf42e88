// SPDX-License-Identifier: BSD-3-Clause
// Rank correlation and points of a scan (E122).
#include "compare/rank_correlation.hpp"

#include "support/test.hpp"

TEST(RankCorrelation, is_spearmans) {
  EXPECT_NEAR(rank_correlation({1, 2, 3, 4, 5}, {10, 20, 30, 40, 1e6}), 1, 1e-12);
  EXPECT_NEAR(rank_correlation({1, 2, 3}, {9, 8, -7}), -1, 1e-12);
  // 1 - 6 sum d^2 / (n (n^2 - 1)) = 1 - 6 * 8 / 120
  EXPECT_NEAR(rank_correlation({1, 2, 3, 4, 5}, {2, 1, 4, 5, 3}), 1 - 6.0 * 8 / 120, 1e-12);
  // Ties share their mean rank: ranks 0.5 0.5 2 and 0 1 2.
  EXPECT_NEAR(rank_correlation({4, 4, 7}, {1, 2, 3}), std::sqrt(3.0) / 2, 1e-12);
  EXPECT_TRUE(std::isnan(rank_correlation({1, 1}, {1, 2})));
  expect_error(ErrorKind::argument, {"lists of 2 and 3 numbers"}, [] { rank_correlation({1, 2}, {1, 2, 3}); });
}

TEST(RankCorrelation, of_points_is_that_of_what_the_range_does_not_explain) {
  std::vector<double> range, measured, predicted;
  std::mt19937 random(5);
  std::normal_distribution<double> surface(0, 3), error(0, 1);
  for (int i = 0; i < 4000; ++i) {
    range.push_back(1 + 0.01 * (i % 1000));
    const double s = surface(random);
    measured.push_back(7 - 13 * std::log10(range.back()) + s);
    predicted.push_back(100 - 40 * std::log10(range.back()) + s + error(random));
  }
  const PointComparison c = compare_points(predicted, measured, range, 1);
  EXPECT_EQ(c.points, 4000U);
  EXPECT_NEAR(c.predicted_slope_db, -40, 0.5);
  EXPECT_NEAR(c.measured_slope_db, -13, 0.5);
  EXPECT_NEAR(c.deviation_without_trend_db, 1, 0.05);
  // Spearman of a normal pair with correlation r: 6 / pi asin(r / 2), r = 3 / sqrt(10).
  EXPECT_NEAR(c.rank_without_trend, 6 / std::numbers::pi * std::asin(1.5 / std::sqrt(10.0)), 0.01);
  EXPECT_LT(c.ceiling_without_trend, c.ceiling);
  EXPECT_EQ(c.far_below, 0);
  for (std::size_t i = 0; i < predicted.size(); i += 10) predicted[i] -= 60;  // hidden in the prediction
  EXPECT_NEAR(compare_points(predicted, measured, range, 1).far_below, 0.1, 1e-9);
  EXPECT_NEAR(c.ceiling_without_trend, 0.53, 0.05);  // 3.2 dB of surface under 5.6 dB of speckle
}

TEST(RankCorrelation, of_points_refuses_what_is_not_finite) {
  expect_error(ErrorKind::argument, {"compare_points", "point 1", "finite"}, [] {
    compare_points({1, NAN, 3}, {1, 2, 3}, {1, 2, 3}, 1);
  });
  expect_error(ErrorKind::argument, {"2 predicted"}, [] { compare_points({1, 2}, {1, 2}, {1, 2}, 1); });
}
