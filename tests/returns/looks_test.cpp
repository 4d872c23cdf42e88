// SPDX-License-Identifier: BSD-3-Clause
// Averaging of intensities for display (E71) against the Gamma law of L looks.
#include "returns/looks.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "core/random.hpp"
#include "core/units.hpp"
#include "support/errors.hpp"

using namespace insonify;

namespace {

/// Returns independent complex normal samples of mean power 1.
Grid<double> speckle(Eigen::Index beams, Eigen::Index bins) {
  Grid<double> intensity(beams, bins);
  for (Eigen::Index b = 0; b < beams; ++b)
    for (Eigen::Index n = 0; n < bins; ++n)
      intensity(b, n) = std::norm(random_complex_normal(
          5, RandomStage::noise, {static_cast<std::uint64_t>(b), static_cast<std::uint64_t>(n), 0}));
  return intensity;
}

}  // namespace

TEST(Looks, of_one_bin_change_nothing) {
  const Grid<double> intensity = speckle(3, 5);
  EXPECT_TRUE((mean_over_bins(intensity, 1) == intensity.cast<float>()).all());
}

TEST(Looks, average_over_neighbouring_bins_and_fewer_at_the_ends) {
  Grid<double> intensity(2, 4);
  intensity << 1, 2, 4, 8, 0, 0, 0, 6;
  Grid<float> three(2, 4), two(2, 4);
  three << 1.5F, 7 / 3.0F, 14 / 3.0F, 6, 0, 0, 2, 3;
  two << 1.5F, 3, 6, 8, 0, 0, 3, 6;
  EXPECT_TRUE(mean_over_bins(intensity, 3).isApprox(three));
  EXPECT_TRUE(mean_over_bins(intensity, 2).isApprox(two));
  EXPECT_TRUE((mean_over_bins(intensity, 9).row(0) == 3.75F).all());
  EXPECT_NE(error_of([&] { mean_over_bins(intensity, 0); }).find("bins = 0, must be at least 1"), std::string::npos);
}

// std / mean of the intensity of L looks is 1 / sqrt(L).
TEST(Looks, of_independent_samples_follow_the_gamma_law) {
  const Grid<double> intensity = speckle(100, 400);
  for (const int looks : {1, 2, 4, 8}) {
    const Grid<double> mean = mean_over_bins(intensity, looks).middleCols(10, 380).cast<double>();
    EXPECT_NEAR(std::sqrt((mean - mean.mean()).square().mean()) / mean.mean(), 1 / std::sqrt(looks), 0.03) << looks;
    EXPECT_NEAR(mean.mean(), 1, 0.02);
  }
}

TEST(Looks, are_what_a_display_shows) {
  Ping ping;
  ping.pressure = ComplexGridF::Constant(1, 3, {3e-6F, 4e-6F});
  EXPECT_TRUE((shown_level_db(ping) == level_db(ping)).all());
  ping.intensity = Grid<float>::Constant(1, 3, 50e-12F);
  ping.intensity(0, 1) = 0;
  EXPECT_NEAR(shown_level_db(ping)(0, 0), level_db(ping)(0, 0) + db_from_power(2), 1e-5);
  EXPECT_EQ(shown_level_db(ping, -150)(0, 1), -150);
}
