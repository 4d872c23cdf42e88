// SPDX-License-Identifier: BSD-3-Clause
#include "returns/quantise.hpp"

#include "returns/ping.hpp"
#include "support/test.hpp"

namespace {

Grid<float> row(std::initializer_list<float> levels) {
  Grid<float> grid(1, static_cast<Eigen::Index>(levels.size()));
  Eigen::Index n = 0;
  for (const float level : levels) grid(0, n++) = level;
  return grid;
}

// Steps of 1 dB for eight bits.
const GreyWindow window{-155, 100};

}  // namespace

TEST(Quantise, is_linear_in_decibels_and_clamps) {
  const float infinite = std::numeric_limits<float>::infinity();
  const auto grey = quantise_8(
      row({-infinite, -200, -155, -154.51F, -154.49F, -154, -153.51F, 0, 99.49F, 99.51F, 100, 180, infinite}), window);
  const int expected[] = {0, 0, 0, 0, 1, 1, 1, 155, 254, 255, 255, 255, 255};
  for (int n = 0; n < 13; ++n) EXPECT_EQ(grey(0, n), expected[n]) << n;
}

// A reader of the picture who takes black + value / 255 (white - black) is off by half a step at most, and not on
// average.
TEST(Quantise, is_the_nearest_value_without_a_bias) {
  Grid<float> levels(1, 10200);  // none halfway
  for (Eigen::Index n = 0; n < levels.cols(); ++n) levels(0, n) = -154.9875F + 0.025F * static_cast<float>(n);
  const auto coarse = quantise_8(levels, window);
  const auto fine = quantise_16(levels, window);
  double off = 0;
  for (Eigen::Index n = 0; n < levels.cols(); ++n) {
    const double level = levels(0, n), read = -155 + coarse(0, n) / 255.0 * 255;
    off += (read - level) / static_cast<double>(levels.cols());
    EXPECT_NEAR(read, level, 0.5 + 1e-6);
    EXPECT_NEAR(-155 + fine(0, n) / 65535.0 * 255, level, 0.5 / 257 + 1e-6);
    EXPECT_EQ(level_of_grey(coarse(0, n), 8, window), read);
    EXPECT_NEAR(level_of_grey(fine(0, n), 16, window), level, 0.5 / 257 + 1e-6);
  }
  EXPECT_NEAR(off, 0, 1e-3);
}

TEST(Quantise, refuses_bad_windows_and_levels) {
  EXPECT_EQ(error_of([] {
              quantise_8(row({0}), {10, 10});
            }),
            "quantise_8: window from min_db = 10 to max_db = 10 dB, must be finite with min_db below max_db");
  EXPECT_NE(error_of([] { quantise_16(row({0}), {NAN, 10}); }), "no error");
  EXPECT_EQ(error_of(
                [] {
                  quantise_16(row({0, NAN}), {0, 10});
                },
                ErrorKind::content),
            "quantise_16: level(0, 1) is not a number");
  EXPECT_EQ(error_of([] { level_of_grey(256, 8, window); }), "level_of_grey: value = 256, must be at most 255");
  EXPECT_EQ(error_of([] { level_of_grey(1, 12, window); }), "level_of_grey: bits = 12, must be 8 or 16");
}

TEST(Tvg, agrees_with_range_compensation_and_leaves_the_ping_alone) {
  Ping ping;
  ping.gate = {1, 21, 0.5};
  ping.pressure = ComplexGridF::Constant(3, 40, {0.5F, -1});
  ping.pressure(1, 7) = 0;
  const ComplexGridF before = ping.pressure;
  const Grid<float> levels = apply_tvg(level_db(ping), ping.gate, {40, 0.3});
  EXPECT_TRUE((levels == range_compensated_level_db(ping, 0.3)).all());
  EXPECT_EQ(levels(1, 7), -200);
  EXPECT_TRUE((ping.pressure == before).all());
}

TEST(Tvg, follows_its_law) {
  EXPECT_NEAR(gain_db({20, 0}, 10), 20, 1e-13);
  EXPECT_NEAR(gain_db({0, 0.3}, 10), 6, 1e-13);
  EXPECT_NEAR(gain_db({30, 0.05}, 100), 70, 1e-12);
}

TEST(Tvg, refuses_another_gate_and_values_that_are_not_finite) {
  EXPECT_EQ(error_of([] {
              apply_tvg(row({1, 2}), {1, 2, 0.1}, {});
            }),
            "apply_tvg: levels of 2 bins, but the gate has 10");
  EXPECT_NE(error_of([] { apply_tvg(row({1, 2}), {1, 2, 0.5}, {NAN, 0}); }), "no error");
}
