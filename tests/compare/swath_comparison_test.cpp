// SPDX-License-Identifier: BSD-3-Clause
#include "compare/swath_comparison.hpp"

#include "support/test.hpp"

namespace {

constexpr double unknown_level = std::numeric_limits<double>::quiet_NaN();

/// Returns soundings of a bed at z = -20 with normal errors of this deviation, ten to a cell of a metre on average, over
/// 40 m by 40 m, with levels of fully developed speckle about `level_db`.
SwathPoints noisy_bed(double deviation, double shift, double level_db, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> place(0, 40);
  std::normal_distribution<double> error(0, deviation);
  std::exponential_distribution<double> intensity(1);
  SwathPoints points;
  points.pings = 100;
  for (int i = 0; i < 16000; ++i) {
    const double x = place(random), y = place(random);
    points.position.emplace_back(x, y, -20 + shift + error(random));
    points.angle.push_back(std::atan2(x - 20, 20));
    points.level_db.push_back(level_db + 10 * std::log10(intensity(random)));
    points.deviation.push_back(deviation);
  }
  return points;
}

}  // namespace

// E213: where errors are as predicted, normalised differences have the deviation 1, within the sampling error of 1600
// cells (2 / sqrt(2 * 1600) = 0.035), and 95 % lie within 1.96 (2 sqrt(.95 .05 / 1600) = 0.011).
TEST(SwathComparison, differences_of_cells_scatter_as_predicted) {
  const SwathPoints a = noisy_bed(0.05, 0.01, 60, 1), b = noisy_bed(0.02, 0, 60, 2);
  const SwathCellComparison c = compare_swath_cells(a, b, 1);
  EXPECT_GE(c.cells, 1590U);  // a cell of ten on average has fewer than two with a probability of 5e-4
  EXPECT_NEAR(c.normalised, 1, 0.035);
  EXPECT_NEAR(c.within_95, 0.95, 0.011);
  EXPECT_NEAR(c.bias, 0.01, 2 * c.predicted / 40);
  // If deviations are stated half as large as they are, differences are twice as wide.
  SwathPoints a_half = a, b_half = b;
  for (double& d : a_half.deviation) d /= 2;
  for (double& d : b_half.deviation) d /= 2;
  EXPECT_NEAR(compare_swath_cells(a_half, b_half, 1).normalised, 2 * c.normalised, 1e-9);
}

TEST(SwathComparison, soundings_that_state_no_deviation_have_that_of_their_cell) {
  SwathPoints a, b;
  for (const double z : {-1.0, -3.0}) a.position.emplace_back(0.5, 0.5, z), b.position.emplace_back(0.25, 0.75, z - 1);
  for (SwathPoints* points : {&a, &b})
    points->angle = {0, 0}, points->level_db = {0, 0}, points->deviation = {unknown_level, unknown_level};
  const SwathCellComparison c = compare_swath_cells(a, b, 1);
  EXPECT_EQ(c.cells, 1U);
  EXPECT_EQ(c.bias, 1);
  // The sample's deviation is sqrt(2), that of a mean of two 1, and of the difference sqrt(2).
  EXPECT_NEAR(c.predicted, std::sqrt(2), 1e-12);
  b.position[0].x() += 7;  // no cell holds two of each
  const SwathCellComparison none = compare_swath_cells(a, b, 1);
  EXPECT_EQ(none.cells, 0U);
  EXPECT_TRUE(std::isnan(none.bias));
  EXPECT_EQ(error_of([&] { compare_swath_cells(a, b, 0); }), "compare_swath_cells: cell = 0 m, must be > 0");
}

// E212: 5.57 dB is the deviation of levels of exponential intensities; the mean of the intensities has the level itself.
TEST(SwathComparison, bands_of_angle_have_level_deviation_and_coverage) {
  const SwathPoints a = noisy_bed(0.05, 0, 63, 3), b = noisy_bed(0.05, 0, 60, 4);
  const std::vector<SwathAngleBand> bands = compare_by_angle(a, b, radians(15));
  ASSERT_EQ(bands.size(), 6U);
  EXPECT_NEAR(bands.front().from, radians(-45), 1e-12);
  double soundings = 0;
  for (const SwathAngleBand& band : bands) {
    const double count = static_cast<double>(band.a.soundings);
    EXPECT_NEAR(band.a.level_db - band.b.level_db, 3, 4 * 4.34 * std::sqrt(2 / count));
    EXPECT_NEAR(band.a.deviation_db, 5.57, 4 * 5.57 / std::sqrt(count));
    EXPECT_NEAR(band.a.per_ping, count / 100 / 15, 1e-9);
    soundings += count;
  }
  EXPECT_EQ(soundings, 16000);
  SwathPoints silent = b;
  for (double& level : silent.level_db) level = unknown_level;
  EXPECT_TRUE(std::isnan(compare_by_angle(a, silent, 1)[0].b.level_db));
}
