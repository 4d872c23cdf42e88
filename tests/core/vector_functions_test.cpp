// SPDX-License-Identifier: BSD-3-Clause
#include "core/vector_functions.hpp"

#include <algorithm>
#include <cmath>

#include "core/units.hpp"
#include "support/test.hpp"

TEST(VectorFunctions, agree_with_the_library_over_their_range) {
  double sine_error = 0, exp_error = 0, log_error = 0, atan_error = 0;
  for (int k = -20000; k <= 20000; ++k) {
    const double x = k / 20000.0;
    double sine, cosine;
    vec::sine_cosine(3 * x, sine, cosine);
    const double angle = 2 * pi * reduced_cycles(3 * x);
    sine_error = std::max({sine_error, std::abs(sine - std::sin(angle)), std::abs(cosine - std::cos(angle))});
    exp_error = std::max(exp_error, std::abs(vec::exp(700 * x) / std::exp(700 * x) - 1));
    const double positive = std::exp2(60 * x);
    log_error = std::max(
        log_error, std::abs(vec::log(positive) - std::log(positive)) / std::max(1.0, std::abs(std::log(positive))));
    atan_error = std::max(atan_error, std::abs(vec::atan_of_small(x / 16) - std::atan(x / 16)));
  }
  EXPECT_LT(sine_error, 5e-16);
  EXPECT_LT(exp_error, 5e-16);
  EXPECT_LT(log_error, 3e-16);
  EXPECT_LT(atan_error, 2e-16);
}

TEST(VectorFunctions, are_exact_where_the_result_is) {
  double sine, cosine;
  for (const auto& [cycles, s, c] : {std::tuple(0.0, 0, 1), std::tuple(0.25, 1, 0), std::tuple(0.5, 0, -1),
                                     std::tuple(-0.25, -1, 0), std::tuple(1e9 + 0.75, -1, 0)}) {
    vec::sine_cosine(cycles, sine, cosine);
    EXPECT_EQ(sine, s) << cycles;
    EXPECT_EQ(cosine, c) << cycles;
  }
  EXPECT_EQ(vec::exp(0), 1);
  EXPECT_EQ(vec::log(1), 0);
  EXPECT_EQ(vec::floor(-2.5), -3);
  EXPECT_EQ(vec::ceil(-2.5), -2);
  EXPECT_EQ(vec::floor(4), 4);
  EXPECT_LT(vec::exp(-1e6), 1e-300);
}
