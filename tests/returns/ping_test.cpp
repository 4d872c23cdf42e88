// SPDX-License-Identifier: BSD-3-Clause
#include "returns/ping.hpp"

#include "support/test.hpp"

namespace {
Ping small_ping() {
  Ping ping;
  ping.fan = make_fan(2, 0.2, 0.1, 0.3);
  ping.gate = {1, 4, 1};
  ping.pressure = ComplexGridF::Zero(2, 3);
  ping.pressure(0, 1) = {0, 70.97F};
  return ping;
}
}  // namespace

// 70.97 Pa peak is 154.01 dB re 1 uPa rms; silence is the floor, never -inf or NaN.
TEST(LevelDb, is_rms_re_1_micropascal_and_finite_for_silence) {
  const Grid<float> level = level_db(small_ping());
  EXPECT_NEAR(level(0, 1), 154.011, 0.001);
  EXPECT_EQ(level(1, 2), -200);
  EXPECT_EQ(level_db(small_ping(), -50)(1, 2), -50);
}

// At 2.5 m: 40 log 2.5 + 2 * 0.3 * 2.5.
TEST(RangeCompensatedLevel, compensates_spreading_and_absorption_but_not_silence) {
  const Grid<float> level = range_compensated_level_db(small_ping(), 0.3);
  EXPECT_NEAR(level(0, 1), 154.011 + 40 * std::log10(2.5) + 1.5, 0.001);
  EXPECT_EQ(level(1, 2), -200);
}

TEST(MeanLevel, averages_intensity_inside_the_ranges) {
  const Ping ping = small_ping();
  EXPECT_NEAR(mean_level_db(ping, 2, 3), 154.011 - 10 * std::log10(2), 0.001);  // one of two samples
  EXPECT_NEAR(mean_level_db(ping, 1, 4), 154.011 - 10 * std::log10(6), 0.001);
  EXPECT_TRUE(std::isinf(mean_level_db(ping, 50, 60)));
}

TEST(StoredCells, are_pressures_of_the_same_intensity) {
  Grid<double> intensity(3, 20000);  // more than one block
  for (Eigen::Index i = 0; i < intensity.size(); ++i) intensity.data()[i] = 1e-30 * static_cast<double>(i);
  const ComplexGridF stored = stored_cells(intensity, "me");
  ASSERT_EQ(stored.rows(), 3);
  ASSERT_EQ(stored.cols(), 20000);
  for (Eigen::Index i = 0; i < intensity.size(); ++i) {
    EXPECT_EQ(stored.data()[i].real(), static_cast<float>(std::sqrt(intensity.data()[i])));
    EXPECT_EQ(stored.data()[i].imag(), 0);
  }
}

TEST(StoredCells, throw_for_what_is_too_loud_or_no_number) {
  for (const double wrong : {1e80, std::numeric_limits<double>::quiet_NaN()}) {
    Grid<double> intensity = Grid<double>::Constant(2, 5, 1);
    intensity(1, 3) = wrong;
    EXPECT_THROW(stored_cells(intensity, "me"), Error);
  }
}
