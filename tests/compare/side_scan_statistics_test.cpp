// SPDX-License-Identifier: BSD-3-Clause
// First returns, shadows and bands of range of beds made for it.
#include "compare/side_scan_statistics.hpp"

#include "compare/range_bands.hpp"
#include "compare/resample_image.hpp"
#include "support/test.hpp"

namespace {

constexpr RangeGate side_gate{0.01, 30.01, 0.03};
constexpr double side_altitude = 4, mast_height = 1, mast_range = 12;

/// Returns one look of speckle on a bed that falls off by 30 log r; an object hides it in pings `first` to `last`.
Grid<float> bed_with_shadow(unsigned seed, Eigen::Index first = 20, Eigen::Index last = 29) {
  std::mt19937 random(seed);
  std::exponential_distribution<double> intensity(1);
  Grid<float> level(60, static_cast<Eigen::Index>(side_gate.bins()));
  for (Eigen::Index p = 0; p < level.rows(); ++p)
    for (Eigen::Index n = 0; n < level.cols(); ++n) {
      const double r = side_gate.centre(static_cast<std::size_t>(n));
      const bool hidden =
          p >= first && p <= last && r > mast_range && r < mast_range * side_altitude / (side_altitude - mast_height);
      level(p, n) = static_cast<float>((r < side_altitude ? -90
                                        : hidden          ? -25
                                                          : 0) -
                                       30 * std::log10(r) + db_from_power(intensity(random)));
    }
  return level;
}

}  // namespace

// Similar triangles: from 12 m on to 12 m x 4 / 3.
TEST(SideScanStatistics, shadow_is_as_long_as_its_object_is_high) {
  const SideScanStatistics s = side_scan_statistics(bed_with_shadow(1), side_gate);
  ASSERT_EQ(s.first_return.size(), 60U);
  for (const auto& first : s.first_return) EXPECT_NEAR(first.value(), side_altitude, 0.09);
  EXPECT_NEAR(s.longest_shadow, 4, 0.3);
  EXPECT_NEAR(s.longest_from, 12, 0.15);
  EXPECT_GE(s.longest_ping, 20U);
  EXPECT_LT(s.longest_ping, 30U);
  EXPECT_NEAR(s.shadow_share, 8 * (4 - 8 * 0.03) / (60 * 26.0), 0.0005);  // a ping and four bins less at each edge
  EXPECT_GT(s.shadow_depth_db, 15);
}

// A wall along the way is no bed, though it hides the same ranges in every ping.
TEST(SideScanStatistics, shadow_along_all_pings_is_one) {
  const SideScanStatistics s = side_scan_statistics(bed_with_shadow(4, 0, 59), side_gate);
  EXPECT_NEAR(s.longest_shadow, 4, 0.3);
  EXPECT_NEAR(s.shadow_share, 4 / 26.0, 0.01);
  // Compare the mean of r^-3 from 4 to 12 and 16 to 30 m with that from 12 to 16 m.
  const auto integral = [](double from, double to) { return (1 / (from * from) - 1 / (to * to)) / 2; };
  EXPECT_NEAR(s.shadow_depth_db, 25 + db_from_power((integral(4, 12) + integral(16, 30)) / 22 / (integral(12, 16) / 4)),
              0.5);
}

TEST(SideScanStatistics, bed_without_objects_has_no_shadow) {
  Grid<float> level = bed_with_shadow(2);
  level.middleRows(20, 10) = Grid<float>(level.middleRows(40, 10));
  const SideScanStatistics s = side_scan_statistics(level, side_gate);
  EXPECT_EQ(s.shadow_share, 0);
  EXPECT_EQ(s.longest_shadow, 0);
  level.setConstant(std::numeric_limits<float>::quiet_NaN());
  EXPECT_FALSE(side_scan_statistics(level, side_gate).first_return[0].has_value());
  EXPECT_THAT(error_of([&] { side_scan_statistics(level, {0.01, 3, 0.03}); }), HasSubstr("1000 bins, must be the 100"));
}

TEST(RangeBands, are_of_speckle_of_one_look_that_falls_off) {
  const Grid<float> level = bed_with_shadow(3).topRows(20);
  const std::vector<RangeBand> bands = range_bands(level, side_gate, 5);
  ASSERT_EQ(bands.size(), 5U);
  EXPECT_NEAR(bands[4].from, 24.01, 1e-9);
  EXPECT_NEAR(bands[4].to, 30.01, 1e-9);
  EXPECT_EQ(bands[4].pixels, 20U * 200U);
  for (const std::size_t k : {1U, 2U, 3U, 4U}) {
    const double from = bands[k].from, to = bands[k].to;
    const double mean = (1 / (from * from) - 1 / (to * to)) / (2 * (to - from));  // of r^-3
    EXPECT_NEAR(bands[k].mean_level_db, db_from_power(mean), 0.3) << k;
    EXPECT_NEAR(bands[k].amplitude_contrast, 0.5227, 0.03) << k;
    EXPECT_NEAR(bands[k].deviation_db, 5.57, 0.3) << k;
    EXPECT_LT(bands[k].width_bins, 1.2) << k;
  }
  Grid<float> sparse = Grid<float>::Constant(1, 1000, std::numeric_limits<float>::quiet_NaN());
  EXPECT_EQ(range_bands(sparse, side_gate, 5)[0].amplitude_contrast, 0);
  EXPECT_THAT(error_of([&] { range_bands(level, side_gate, 0); }), HasSubstr("in 0 bands"));
  EXPECT_THAT(error_of([&] { range_bands(level, {0.01, 3, 0.03}); }), HasSubstr("must be the 100 of the gate"));
}

TEST(ResampledInRange, takes_the_mean_intensity_of_finer_bins) {
  ComparedImage fine{Grid<float>(2, 6), std::nullopt, RangeGate{1, 1.6, 0.1}};
  fine.level_db << 0, 10, 0, 10, 0, 10, 3, 3, 3, 3, 3, 3;
  const Grid<float> level = resampled_in_range(fine, {1, 2, 0.2});
  ASSERT_EQ(level.rows(), 2);
  ASSERT_EQ(level.cols(), 5);
  for (Eigen::Index n = 0; n < 3; ++n) {
    EXPECT_NEAR(level(0, n), db_from_power(5.5), 1e-5);
    EXPECT_NEAR(level(1, n), 3, 1e-5);
  }
  EXPECT_TRUE(std::isnan(level(0, 3)) && std::isnan(level(1, 4)));
  EXPECT_THAT(error_of(
                  [&] {
                    resampled_in_range(fine, {5, 6, 0.2});
                  },
                  ErrorKind::content),
              HasSubstr("do not overlap: 1 to 1.6 m and 5 to 6 m"));
}
