// SPDX-License-Identifier: BSD-3-Clause
#include "sonar/line_array.hpp"

#include "sonar/shading.hpp"
#include "support/heads.hpp"
#include "support/test.hpp"

namespace {

/// Returns the highest |B| in dB for u in [from, to].
double highest_db(const LineArray& array, double from, double to) {
  double best = 0;
  for (int i = 0; i <= 20000; ++i)
    best = std::max(best, std::abs(array_response(array, wavelength_900k, from + (to - from) * i / 20000, 0)));
  return db_from_amplitude(best);
}

}  // namespace

TEST(ArrayResponse, of_a_uniform_array_is_the_dirichlet_kernel) {
  const LineArray array = uniform_line(16, 0.5);
  for (const double u : {0.01, 0.123, 0.4, 0.77, 1.0}) {
    const double x = pi * 0.5 * u;
    EXPECT_NEAR(array_response(array, wavelength_900k, u, 0).real(), std::sin(16 * x) / (16 * std::sin(x)), 1e-13);
  }
  EXPECT_DOUBLE_EQ(array_response(array, wavelength_900k, 0.3, 0.3).real(), 1);
}

// wavelength_900k / (N d): the first null of a uniform_line array.
TEST(ArrayResponse, has_its_first_null_at_the_closed_form) {
  EXPECT_NEAR(array_response(uniform_line(32, 0.5), wavelength_900k, 1 / (32 * 0.5), 0).real(), 0, 1e-14);
}

// First side lobes of uniform_line arrays: -11.30 (N = 4), -12.80 (8), -13.147 (16), -13.261 dB (256).
TEST(ArrayResponse, has_the_side_lobes_of_a_uniform_array) {
  EXPECT_NEAR(highest_db(uniform_line(4, 0.5), 1.0 / 2, 1), -11.30, 0.01);
  EXPECT_NEAR(highest_db(uniform_line(8, 0.5), 1.0 / 4, 1), -12.80, 0.01);
  EXPECT_NEAR(highest_db(uniform_line(16, 0.5), 1.0 / 8, 1), -13.147, 0.002);
  EXPECT_NEAR(highest_db(uniform_line(256, 0.5), 1.0 / 128, 0.1), -13.261, 0.002);
}

// Half-power width times N d / wavelength_900k of uniform_line arrays: 0.91078 (4), 0.88739 (16), 0.88590 (256).
TEST(ArrayBeamWidth, of_uniform_arrays) {
  const auto in_u = [](std::size_t n) {
    return 2 * std::sin(array_beam_width(uniform_line(n, 0.5), wavelength_900k) / 2) * 0.5 * static_cast<double>(n);
  };
  EXPECT_NEAR(in_u(4), 0.91078, 2e-5);
  EXPECT_NEAR(in_u(16), 0.88739, 2e-5);
  EXPECT_NEAR(in_u(256), 0.88590, 2e-5);
}

// Isotropic noise on half-wavelength elements is uncorrelated: the index is 10 log N.
TEST(DirectivityIndex, of_a_half_wavelength_array_is_10_log_n) {
  EXPECT_NEAR(directivity_index_db(uniform_line(102, 0.5), wavelength_900k), 10 * std::log10(102), 1e-9);
}

TEST(TaylorShading, keeps_side_lobes_down_and_weights_symmetric) {
  const LineArray array{wavelength_900k / 2, taylor_shading(128, -30)};
  require_valid(array, "test");
  const double null = 1.6 / (128 * 0.5);  // beyond the broadened main lobe
  EXPECT_LT(highest_db(array, null, 1), -29.5);
  EXPECT_GT(highest_db(array, null, 1), -31);
  for (std::size_t m = 0; m < 64; ++m) EXPECT_NEAR(array.shading[m], array.shading[127 - m], 1e-12);
  EXPECT_GT(array.shading[64], 2 * array.shading[0]);
}

TEST(TaylorShading, refuses_side_lobes_above_those_of_a_uniform_array) {
  EXPECT_THROW(taylor_shading(16, -10), Error);
  EXPECT_THROW(taylor_shading(0, -30), Error);
}

TEST(LineArray, refuses_weights_that_do_not_add_up) {
  EXPECT_THROW(require_valid(LineArray{0.001, {1, 1, 0.5}}, "test"), Error);
  EXPECT_THROW(require_valid(LineArray{0.001, {}}, "test"), Error);
  EXPECT_THROW(require_valid(LineArray{0, {1}}, "test"), Error);
}

// Lobes of full height at sin g = sin s + n lambda / d.
TEST(ArrayResponse, has_grating_lobes_where_they_must_stand_and_symmetric) {
  const struct { double spacing, lobe_deg; } cases[] = {{1, 90}, {1.5, 41.81031}, {2, 30}, {2, 90}};
  for (const auto& c : cases) {
    const LineArray array = uniform_line(16, c.spacing);
    const double u = std::sin(radians(c.lobe_deg));
    EXPECT_NEAR(std::abs(array_response(array, wavelength_900k, u, 0)), 1, 1e-9) << c.spacing;
    EXPECT_NEAR(array_response(array, wavelength_900k, u, 0).real(),
                array_response(array, wavelength_900k, -u, 0).real(), 1e-9)
        << c.spacing;
  }
  // d = 0.75 lambda: free of lobes when steered up to 19.47 degrees; beyond, one enters from the other side.
  const LineArray array = uniform_line(16, 0.75);
  EXPECT_LT(std::abs(array_response(array, wavelength_900k, -1, std::sin(radians(10)))), 0.3);
  EXPECT_NEAR(std::abs(array_response(array, wavelength_900k, -1, 1 / 0.75 - 1)), 1, 1e-9);
}

TEST(ArrayResponse, of_an_array_shorter_than_a_wavelength_has_no_null) {
  const LineArray array = uniform_line(4, 0.2);  // 0.8 wavelengths
  for (int i = -100; i <= 100; ++i) EXPECT_GT(std::abs(array_response(array, wavelength_900k, 0.01 * i, 0)), 0.1);
  // The closed form of a uniform row: sin(N x / 2) / (N sin(x / 2)), x = 2 pi d u / lambda.
  const double x = 2 * pi * 0.2 * 0.8;
  EXPECT_NEAR(array_response(array, wavelength_900k, 0.8, 0).real(), std::sin(2 * x) / (4 * std::sin(x / 2)), 1e-14);
}

// Mean power over echoes from all directions of u is the width of the beam: it falls as 1 / elements.
TEST(ArrayResponse, has_an_energy_that_falls_as_the_width_of_the_beam) {
  const auto energy = [](std::size_t elements) {
    const LineArray array = uniform_line(elements, 0.5);
    double sum = 0;
    for (int i = 0; i < 20000; ++i)
      sum += std::pow(array_response(array, wavelength_900k, (i + 0.5) / 10000 - 1, 0).real(), 2);
    return sum / 20000;
  };
  for (const std::size_t n : {8UL, 64UL, 512UL, 2048UL}) EXPECT_NEAR(energy(n) * static_cast<double>(n), 1, 1e-3) << n;
}

TEST(ArrayBeamWidth, of_one_element_is_half_a_turn_whatever_its_spacing) {
  for (const double spacing : {1e-300, 1e-3, 1.0, 1e6, 1e300})
    EXPECT_EQ(array_beam_width(uniform_line(1, spacing), wavelength_900k), pi) << spacing;
}

TEST(ArrayResponse, has_its_limit_where_sine_over_sine_is_0_over_0) {
  for (const std::size_t n : {1UL, 2UL, 3UL, 8UL, 101UL})  // x = 2 pi k: the limit is (-1)^(k (N-1))
    for (const int k : {-2, -1, 0, 1, 2})
      EXPECT_NEAR(array_response(uniform_line(n, 2), wavelength_900k, 0.5 * k, 0).real(),
                  k % 2 == 0 || n % 2 == 1 ? 1 : -1, 1e-12);
}
