// SPDX-License-Identifier: BSD-3-Clause
#include "acoustics/noise.hpp"

#include "support/test.hpp"

// 900 kHz: -15 + 59.08 = 44.08 dB re 1 uPa^2/Hz, and 44.70 dB for a band of 29.5 kHz.
// 44.08 dB at 900 kHz, + 10 log10 of 1.0645 x 29.5 kHz, the equivalent noise bandwidth of the Gaussian.
TEST(ThermalNoise, level_in_the_band) { EXPECT_NEAR(thermal_noise_level_db({900e3, 29.5e3, 220}), 89.054, 0.005); }

TEST(ThermalNoise, grows_by_6_db_per_octave_and_3_db_per_doubled_band) {
  const double level = thermal_noise_level_db({450e3, 20e3, 220});
  EXPECT_NEAR(thermal_noise_level_db({900e3, 20e3, 220}) - level, 6.0206, 1e-4);
  EXPECT_NEAR(thermal_noise_level_db({450e3, 40e3, 220}) - level, 3.0103, 1e-4);
}

// Noise of a lossless pressure receiver in thermal equilibrium: 4 pi k T rho f^2 / c [Pa^2/Hz], here at 10 deg C.
TEST(ThermalNoise, spectrum_level_is_that_of_statistical_mechanics_within_0_3_db) {
  for (double f : {100e3, 900e3, 3e6}) {
    const double power = 4 * pi * 1.380649e-23 * 283.15 * 1026 * f * f / 1490;
    EXPECT_NEAR(thermal_noise_spectrum_level_db(f), db_from_power(power / (micropascal * micropascal)), 0.3);
  }
  EXPECT_NEAR(thermal_noise_spectrum_level_db(3e6), 54.54, 0.005);
}

// At 100 kHz and 5 m/s: 50 + 7.5 sqrt(5) + 40 - 40 log10(100.4) = 26.70 dB, the water's own 25 dB.
TEST(WindNoise, spectrum_level_at_100_khz) {
  EXPECT_NEAR(wind_noise_spectrum_level_db(100e3, 5), 26.70, 0.005);
  EXPECT_NEAR(thermal_noise_spectrum_level_db(100e3), 25, 1e-12);
}

TEST(WindNoise, peaks_at_400_hz_and_falls_by_6_db_per_octave_far_above) {
  EXPECT_GT(wind_noise_spectrum_level_db(400, 5), wind_noise_spectrum_level_db(360, 5));
  EXPECT_GT(wind_noise_spectrum_level_db(400, 5), wind_noise_spectrum_level_db(440, 5));
  EXPECT_NEAR(wind_noise_spectrum_level_db(200e3, 5) - wind_noise_spectrum_level_db(100e3, 5), -6.0206, 0.05);
}

TEST(AmbientNoise, is_thermal_above_about_110_khz_at_5_m_per_s) {
  const auto wind_less_thermal = [](double f, double w) {
    return wind_noise_spectrum_level_db(f, w) - thermal_noise_spectrum_level_db(f);
  };
  EXPECT_GT(wind_less_thermal(109e3, 5), 0);
  EXPECT_LT(wind_less_thermal(111e3, 5), 0);
  // The crossings the header states, from 65 + 7.5 sqrt(w) = 40 log10(f / kHz + 0.4).
  EXPECT_NEAR(wind_less_thermal(42e3, 0), 0, 0.1);
  EXPECT_NEAR(wind_less_thermal(165e3, 10), 0, 0.1);
  EXPECT_NEAR(wind_less_thermal(224e3, 15), 0, 0.1);
  for (double w : {0., 5., 15.})
    EXPECT_NEAR(ambient_noise_spectrum_level_db(900e3, w), thermal_noise_spectrum_level_db(900e3), 0.02);
}

TEST(AmbientNoise, is_the_power_sum_of_its_parts) {
  for (double f : {1e3, 50e3, 110e3, 500e3}) {
    const double wind = wind_noise_spectrum_level_db(f, 7), thermal = thermal_noise_spectrum_level_db(f);
    EXPECT_NEAR(power_from_db(ambient_noise_spectrum_level_db(f, 7)), power_from_db(wind) + power_from_db(thermal),
                1e-9 * power_from_db(wind));
  }
  const double crossing = (std::pow(10, (65 + 7.5 * std::sqrt(7)) / 40) - 0.4) * 1e3;
  EXPECT_NEAR(ambient_noise_spectrum_level_db(crossing, 7) - thermal_noise_spectrum_level_db(crossing), 3.0103, 1e-4);
}

TEST(AmbientNoise, band_level_tends_to_the_thermal_one) {
  const Pulse pulse{900e3, 29.5e3, 220};
  EXPECT_NEAR(ambient_noise_level_db(pulse, 5), thermal_noise_level_db(pulse), 0.01);
  EXPECT_GT(ambient_noise_level_db(pulse, 5), thermal_noise_level_db(pulse));
}

// The spectrum level at the centre counts for the whole band: against the integral over the filter's power response, by
// the midpoint rule.
TEST(AmbientNoise, band_level_is_low_by_at_most_0_7_db) {
  const int steps = 2000;
  for (double f : {20e3, 110e3, 900e3})
    for (double width : {0.1, 0.5}) {
      const double begin = std::max(1e-3 * f, f * (1 - 2.5 * width)), end = f * (1 + 2.5 * width);
      double power = 0;
      for (int i = 0; i < steps; ++i) {
        const double at = begin + (i + 0.5) / steps * (end - begin), off = (at - f) / (width * f);
        power += power_from_db(ambient_noise_spectrum_level_db(at, 5)) * std::exp2(-4 * off * off);
      }
      const double exact = db_from_power(power * (end - begin) / steps);
      const double low_by = exact - ambient_noise_level_db({f, width * f, 220}, 5);
      EXPECT_GE(low_by, 0) << f << ' ' << width;
      EXPECT_LE(low_by, width < 0.5 ? 0.03 : 0.7) << f << ' ' << width;
      if (f == 900e3) {
        EXPECT_LE(low_by, 0.2);  // thermal alone
      }
    }
}

TEST(AmbientNoise, refuses_no_frequency_and_wind_from_nowhere) {
  EXPECT_THROW(thermal_noise_spectrum_level_db(0), Error);
  EXPECT_THROW(ambient_noise_spectrum_level_db(std::nan(""), 5), Error);
  EXPECT_THROW(ambient_noise_level_db({900e3, 0, 220}, 5), Error);
  expect_error(ErrorKind::argument, {"wind_speed = -1 m/s, must be >= 0"},
               [] { ambient_noise_spectrum_level_db(900e3, -1); });
}
