// SPDX-License-Identifier: BSD-3-Clause
#include "support/test.hpp"

TEST(Units, decibels_and_back) {
  EXPECT_DOUBLE_EQ(db_from_power(100), 20);
  EXPECT_DOUBLE_EQ(db_from_amplitude(100), 40);
  EXPECT_NEAR(power_from_db(db_from_power(0.37)), 0.37, 1e-15);
  EXPECT_TRUE(std::isinf(db_from_power(0)));
  EXPECT_NEAR(nepers_per_db, 0.1151292546497023, 1e-16);
}

// 70.97 Pa peak = 50.18 Pa rms = 154.01 dB re 1 uPa.
TEST(Units, level_of_a_peak_pressure_is_rms_re_1_micropascal) { EXPECT_NEAR(pressure_level_db(70.97), 154.011, 0.001); }

TEST(Units, reduced_cycles_stays_within_half_a_cycle) {
  EXPECT_NEAR(reduced_cycles(72000.25), 0.25, 1e-12);
  EXPECT_NEAR(reduced_cycles(-0.75), 0.25, 1e-15);
  EXPECT_NEAR(reduced_cycles(0.75), -0.25, 1e-15);
}
