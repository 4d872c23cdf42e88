// SPDX-License-Identifier: BSD-3-Clause
// Statistics of speckle and their closed forms (E123, E124).
#include "compare/speckle_statistics.hpp"

#include "compare/made_images.hpp"
#include "support/test.hpp"

namespace {

/// Returns the levels of K noise: speckle of one look with a mean intensity that has a gamma distribution of this
/// shape.
Grid<float> k_noise(double shape, unsigned seed) {
  std::mt19937_64 random(seed);
  std::gamma_distribution<double> texture(shape, 1 / shape);
  Grid<float> level = smooth_scene(384, 768);
  for (Eigen::Index i = 0; i < level.size(); ++i)
    level(i) += static_cast<float>(db_from_power(std::max(1e-15, texture(random))));
  return with_speckle(level, seed);
}

}  // namespace

TEST(SpeckleStatistics, of_one_look_are_those_of_fully_developed_speckle) {
  const SpeckleStatistics s = speckle_statistics(with_speckle(smooth_scene(256, 512), 1));
  EXPECT_NEAR(s.scintillation, 1, 0.015);  // standard error 0.006 of 131 072 pixels
  EXPECT_NEAR(s.amplitude_contrast, 0.5227, 0.003);
  EXPECT_NEAR(s.deviation_db, 5.570, 0.03);
  EXPECT_NEAR(s.width.beams, 1, 0.02);  // white: half way to the next pixel, to either side
  EXPECT_NEAR(s.width.bins, 1, 0.02);
}

TEST(SpeckleStatistics, of_four_looks_have_a_quarter_of_the_variance) {
  const SpeckleStatistics s = speckle_statistics(with_speckle(smooth_scene(256, 512), 2, 4));
  EXPECT_NEAR(s.looks, 4, 0.08);
  EXPECT_NEAR(s.deviation_db, looks_deviation_db(4), 0.03);
}

TEST(SpeckleStatistics, k_shape_is_that_of_synthetic_k_noise_within_5_percent) {
  for (const double shape : {0.5, 2.0, 10.0}) {
    const double found = speckle_statistics(k_noise(shape, 11)).k_shape;
    EXPECT_NEAR(found / shape, 1, 0.05) << shape;
  }
}

TEST(SpeckleStatistics, widths_are_those_of_the_filter_that_made_the_speckle) {
  // White noise through a Gaussian filter of deviation s: the covariance of intensity is exp(-lag^2 / (2 s^2)).
  const double s = 3;
  const Eigen::Index beams = 200, bins = 700, half = 12;
  Grid<float> level(beams, bins);
  for (Eigen::Index b = 0; b < beams; ++b) {
    std::vector<std::complex<double>> white(static_cast<std::size_t>(bins + 2 * half));
    for (std::size_t i = 0; i < white.size(); ++i)
      white[i] = random_complex_normal(3, RandomStage::scene_points, {i, static_cast<std::uint64_t>(b), 0});
    for (Eigen::Index n = 0; n < bins; ++n) {
      std::complex<double> sum = 0;
      for (Eigen::Index k = 0; k <= 2 * half; ++k)
        sum += white[static_cast<std::size_t>(n + k)] *
               std::exp(-0.5 * static_cast<double>((k - half) * (k - half)) / (s * s));
      level(b, n) = static_cast<float>(db_from_power(std::norm(sum)));
    }
  }
  const SpeckleStatistics found = speckle_statistics(level);
  EXPECT_NEAR(found.width.bins, 2 * s * std::sqrt(2 * std::log(2.0)), 0.25);
  EXPECT_NEAR(found.width.beams, 1, 0.05);
  EXPECT_NEAR(found.scintillation, 1, 0.05);
  EXPECT_EQ(one_per_cell(level, {2, 7.1}).size(), 100U * 88U);  // every second beam, every eighth bin
}

TEST(SpeckleStatistics, of_looks_are_the_polygamma_functions) {
  EXPECT_NEAR(looks_deviation_db(1), 5.5700, 1e-4);
  EXPECT_NEAR(looks_bias_db(1), -2.5068, 1e-4);
  EXPECT_NEAR(looks_deviation_db(4), 2.3140, 1e-3);
}

TEST(SpeckleStatistics, shadow_contrast_is_the_step_between_halves) {
  Grid<float> level = Grid<float>::Constant(60, 200, 20);
  level.rightCols(100) = 33;
  EXPECT_NEAR(shadow_contrast_db(level), 13, 1e-4);
}

TEST(SpeckleStatistics, of_nothing_are_refused) {
  expect_error(ErrorKind::argument, {"speckle_statistics", "no pixel"},
               [] { speckle_statistics(Grid<float>::Constant(20, 20, std::numeric_limits<float>::quiet_NaN())); });
}
