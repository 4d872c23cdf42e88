#include "acoustics/noise.hpp"

#include <gtest/gtest.h>

using namespace insonify;

// 900 kHz: -15 + 59.08 = 44.08 dB re 1 uPa^2/Hz, and 44.70 dB for a band of 29.5 kHz.
TEST(ThermalNoise, level_in_the_band) { EXPECT_NEAR(thermal_noise_level_db({900e3, 29.5e3, 220}), 88.78, 0.01); }

TEST(ThermalNoise, grows_by_6_db_per_octave_and_3_db_per_doubled_band) {
  const double level = thermal_noise_level_db({450e3, 20e3, 220});
  EXPECT_NEAR(thermal_noise_level_db({900e3, 20e3, 220}) - level, 6.0206, 1e-4);
  EXPECT_NEAR(thermal_noise_level_db({450e3, 40e3, 220}) - level, 3.0103, 1e-4);
}
