// SPDX-License-Identifier: BSD-3-Clause
// Compares the intensity of a display that averages (E71) with the laws of speckle; and tests the pressure.
#include <cmath>
#include <complex>

#include <gtest/gtest.h>

#include "core/units.hpp"
#include "scene/built_in_scenes.hpp"
#include "simulate/simulate_ping.hpp"
#include "support/errors.hpp"
#include "support/heads.hpp"

namespace insonify::looks_tests {

const SonarHead head = small_head({.beams = 24,
                                   .field_of_view_deg = 96,
                                   .beam_width_deg = 2,
                                   .elevation_width_deg = 40,
                                   .min_range = 8,
                                   .max_range = 14});

SimulatedPing ping_of(const SimulationOptions& options) {
  static const SceneCloud bottom = make_built_in_scene("plane", {.points = 60000, .size = {20, 40}});
  return simulate_ping(bottom, head, pose_from_yaw_pitch_roll({-2, 0, 3}, 0, radians(15), 0), {}, options);
}

SimulationOptions looks(int range, int pings, std::uint64_t seed = 1) {
  return {.seed = seed, .outputs = {.looks_range = range, .looks_pings = pings}};
}

/// Statistics of looks at a flat bottom, each cell relative to its expected intensity.
struct Speckle {
  double level_deviation_db = 0, amplitude_contrast = 0, intensity_contrast = 0;
};
Speckle speckle_of(int range, int pings) {
  double n = 0, level = 0, level2 = 0, amplitude = 0, mean = 0, square = 0;
  const auto intensity_of = [](const Ping& p) -> Grid<double> {
    if (p.intensity.size() > 0) return p.intensity.cast<double>();
    return p.pressure.cast<std::complex<double>>().abs2();
  };
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const Grid<double> image = intensity_of(ping_of(looks(range, pings, seed)).ping);
    // Every pulse has a seed of its own, by which its scatterers are placed.
    Grid<double> usual = Grid<double>::Zero(image.rows(), image.cols());
    for (int k = 0; k < pings; ++k) {
      SimulationOptions expected = looks(range, 1, seed + static_cast<std::uint64_t>(k) * 0x9e3779b97f4a7c15);
      expected.synthesis.method = SynthesisMethod::incoherent;
      usual += intensity_of(ping_of(expected).ping) / pings;
    }
    for (Eigen::Index b = 0; b < image.rows(); ++b)
      for (Eigen::Index bin = 20; bin + 20 < image.cols(); bin += 3) {
        const double intensity = image(b, bin) / usual(b, bin), db = db_from_power(intensity);
        ++n, level += db, level2 += db * db, amplitude += std::sqrt(intensity), mean += intensity,
            square += intensity * intensity;
      }
  }
  level /= n, amplitude /= n, mean /= n;
  return {std::sqrt(level2 / n - level * level), std::sqrt(mean - amplitude * amplitude) / amplitude,
          std::sqrt(square / n - mean * mean) / mean};
}

/// Returns the level's deviation by the Gamma law of L looks, 10 / ln 10 sqrt(trigamma(L)).
double gamma_deviation_db(double looks) {
  double trigamma = 0;
  for (int k = 0; k < 100000; ++k) trigamma += 1 / ((looks + k) * (looks + k));
  return 10 / std::log(10) * std::sqrt(trigamma + 1e-5);
}
double gamma_contrast(double looks) {
  const double mean = std::exp(std::lgamma(looks + 0.5) - std::lgamma(looks)) / std::sqrt(looks);
  return std::sqrt(1 - mean * mean) / mean;
}

TEST(Looks, of_one_pulse_and_bin_are_speckle) {
  EXPECT_EQ(ping_of({}).ping.intensity.size(), 0);
  EXPECT_TRUE((ping_of(looks(2, 1)).ping.pressure == ping_of({}).ping.pressure).all());
  const Speckle one = speckle_of(1, 1);
  EXPECT_NEAR(gamma_deviation_db(1), 5.57, 0.005);
  EXPECT_NEAR(gamma_contrast(1), 0.5227, 0.0005);
  EXPECT_NEAR(one.level_deviation_db, gamma_deviation_db(1), 0.12);
  EXPECT_NEAR(one.amplitude_contrast, gamma_contrast(1), 0.01);
  EXPECT_NEAR(one.intensity_contrast, 1, 0.03);
}

TEST(Looks, of_four_pulses_halve_the_contrast_of_intensity) {
  const Speckle four = speckle_of(1, 4);
  EXPECT_NEAR(four.intensity_contrast, 0.5, 0.02);
  EXPECT_NEAR(four.level_deviation_db, gamma_deviation_db(4), 0.1);
  EXPECT_NEAR(four.amplitude_contrast, gamma_contrast(4), 0.01);
}

// Amplitudes in bins as long as the pulse are correlated by 1/2: the intensity of two is 3/4 E1 + 1/4 E2, exponential
// and independent. A recorded frame of an ARIS, 4.0 dB and 0.45, is between one look and these.
TEST(Looks, of_two_bins_are_fewer_than_two) {
  ASSERT_NEAR(head.gate.bin_size, 0.44 * sound_speed(Water{}) / (2 * head.pulse.bandwidth), 1e-3);
  const Speckle two = speckle_of(2, 1);
  const double mean_log = 1.5 * std::log(1.5) - 0.5 * std::log(0.5);
  const double square_log = 1.5 * std::pow(std::log(1.5), 2) - 0.5 * std::pow(std::log(0.5), 2);
  const double deviation = 10 / std::log(10) * std::sqrt(pi * pi / 6 + square_log - mean_log * mean_log);  // 3.735 dB
  const double mean_root = std::tgamma(1.5) * (1.5 * std::sqrt(1.5) - 0.5 * std::sqrt(0.5));
  EXPECT_NEAR(two.level_deviation_db, deviation, 0.1);
  EXPECT_NEAR(two.amplitude_contrast, std::sqrt(2 - mean_root * mean_root) / mean_root, 0.01);  // 0.396
  EXPECT_NEAR(two.intensity_contrast, std::sqrt(1 / 1.6), 0.03);
  EXPECT_NEAR(two.level_deviation_db, 4.0, 0.35);
  EXPECT_NEAR(two.amplitude_contrast, 0.45, 0.06);
}

TEST(Looks, do_not_depend_on_threads) {
  SimulationOptions options = looks(3, 2);
  options.effects.noise = true;
  options.threads = 1;
  const SimulatedPing one = ping_of(options);
  options.threads = 3;
  EXPECT_TRUE((ping_of(options).ping.intensity == one.ping.intensity).all());
}

TEST(Looks, are_refused_where_there_are_none) {
  EXPECT_EQ(error_of([] { ping_of(looks(0, 1)); }),
            "PingSimulator: options.outputs.looks_range = 0, must be within 1 and 1024");
  EXPECT_EQ(error_of([] { ping_of(looks(1, 2000)); }),
            "PingSimulator: options.outputs.looks_pings = 2000, must be within 1 and 1024");
  SimulationOptions expected = looks(2, 2);
  expected.synthesis.method = SynthesisMethod::incoherent;
  EXPECT_EQ(
      error_of([&] { ping_of(expected); }),
      "PingSimulator: options.outputs.looks_pings = 2, must be 1 with method incoherent: an expected intensity has "
      "no looks to average");
}

}  // namespace insonify::looks_tests
