// SPDX-License-Identifier: BSD-3-Clause
#include "sonar/shading.hpp"

#include "sonar/line_array.hpp"
#include "support/heads.hpp"
#include "support/test.hpp"

namespace {

LineArray half_wavelength(const std::vector<double>& weights) { return {wavelength_900k / 2, weights}; }

/// Returns the levels [dB] of all maxima of |B| for u in (from, 1) under half-wavelength pitch, by a fine scan with
/// parabolas through three points.
std::vector<double> side_lobes_db(const std::vector<double>& weights, double from) {
  const LineArray array = half_wavelength(weights);
  const auto steps = 400 * weights.size();
  std::vector<double> amplitude;
  for (std::size_t i = 0; i <= steps; ++i) {
    const double u = from + (1 - from) * static_cast<double>(i) / static_cast<double>(steps);
    amplitude.push_back(std::abs(array_response(array, wavelength_900k, u, 0)));
  }
  std::vector<double> levels;
  for (std::size_t i = 1; i + 1 < amplitude.size(); ++i) {
    const double a = amplitude[i - 1], b = amplitude[i], c = amplitude[i + 1];
    if (b > a && b >= c) levels.push_back(db_from_amplitude(b + (a - c) * (a - c) / (8 * (2 * b - a - c))));
  }
  return levels;
}

}  // namespace

TEST(Shading, of_every_kind_is_symmetric_and_adds_up_to_the_elements) {
  for (const Shading shading : {Shading::uniform, Shading::taylor, Shading::hamming, Shading::chebyshev})
    for (const std::size_t n : {1U, 2U, 3U, 4U, 17U, 128U, 501U}) {
      const auto weights = shading_weights(shading, n, -30);
      ASSERT_EQ(weights.size(), n);
      EXPECT_NO_THROW(require_valid(half_wavelength(weights), "test")) << shading_name(shading) << " " << n;
      for (std::size_t m = 0; m < n; ++m) EXPECT_NEAR(weights[m], weights[n - 1 - m], 1e-12) << shading_name(shading);
    }
}

TEST(Shading, of_one_or_two_elements_is_uniform) {
  for (const Shading shading : {Shading::uniform, Shading::taylor, Shading::hamming, Shading::chebyshev})
    for (const std::size_t n : {1U, 2U})
      for (const double w : shading_weights(shading, n, -30)) EXPECT_NEAR(w, 1, 1e-13) << shading_name(shading);
}

// A raised cosine over the aperture is three uniform arrays, steered apart by one null: with D the Dirichlet kernel,
// B(psi) = D(psi) + (0.46 / 1.08) (D(psi - 2 pi / N) + D(psi + 2 pi / N)).
TEST(HammingShading, is_three_uniform_arrays) {
  const std::size_t n = 32;
  const LineArray array = half_wavelength(hamming_shading(n)), uniform = half_wavelength(uniform_shading(n));
  const double null = 2.0 / static_cast<double>(n);  // in u, at half a wavelength
  for (const double u : {0.01, 0.07, 0.1337, 0.4, 0.9}) {
    const auto d = [&](double at) { return array_response(uniform, wavelength_900k, at, 0).real(); };
    EXPECT_NEAR(array_response(array, wavelength_900k, u, 0).real(), d(u) + 0.46 / 1.08 * (d(u - null) + d(u + null)),
                1e-13);
  }
}

// A long array tends to sinc(v) (0.54 - 0.08 v^2) / (0.54 (1 - v^2)), v = L u / wavelength_900k. It vanishes at v = 2
// (the zero of the sinc at 1 is lifted) and at v = sqrt(0.54 / 0.08) = 2.598; the highest maximum is the side lobe.
TEST(HammingShading, has_its_highest_side_lobe_42_7_db_down) {
  double highest = 0;
  for (double v = 2; v < 60; v += 1e-4)
    highest = std::max(highest, std::abs(std::sin(pi * v) / (pi * v) * (0.54 - 0.08 * v * v) / (0.54 * (1 - v * v))));
  EXPECT_NEAR(db_from_amplitude(highest), -42.7, 0.05);
  const auto lobes = side_lobes_db(hamming_shading(256), 2.0 / 128);
  EXPECT_NEAR(*std::max_element(lobes.begin(), lobes.end()), db_from_amplitude(highest), 0.02);
}

TEST(ChebyshevShading, has_every_side_lobe_at_the_level_asked_for) {
  for (const std::size_t n : {5U, 8U, 16U, 31U, 128U})
    for (const double level : {-13.5, -20.0, -30.0, -45.0, -80.0}) {
      const double x0 = std::cosh(std::acosh(amplitude_from_db(-level)) / static_cast<double>(n - 1));
      const double null = 2 / pi * std::acos(std::cos(pi / (2 * static_cast<double>(n - 1))) / x0);
      const auto lobes = side_lobes_db(chebyshev_shading(n, level), null);
      // N - 2 side lobes over the full turn of psi; u in (null, 1) holds half of them, without the one at u = 1.
      EXPECT_EQ(lobes.size(), (n - 2) / 2) << n << " elements, " << level << " dB";
      for (const double lobe : lobes) EXPECT_NEAR(lobe, level, 0.01) << n << " elements";
    }
}

// T_(N-1)(x0 cos(psi / 2)) is zero first at cos(psi / 2) = cos(pi / (2 (N-1))) / x0.
TEST(ChebyshevShading, has_its_first_null_at_the_closed_form) {
  for (const std::size_t n : {4U, 9U, 100U}) {
    const double x0 = std::cosh(std::acosh(amplitude_from_db(30)) / static_cast<double>(n - 1));
    const double null = 2 / pi * std::acos(std::cos(pi / (2 * static_cast<double>(n - 1))) / x0);
    EXPECT_NEAR(array_response(half_wavelength(chebyshev_shading(n, -30)), wavelength_900k, null, 0).real(), 0, 1e-12)
        << n;
  }
}

// Dolph's optimum: for the same level and length no other shading has a narrower beam.
TEST(ChebyshevShading, is_narrower_than_taylor_of_the_same_level) {
  const double chebyshev = array_beam_width(half_wavelength(chebyshev_shading(64, -30)), wavelength_900k);
  EXPECT_LT(chebyshev, array_beam_width(half_wavelength(taylor_shading(64, -30)), wavelength_900k));
  EXPECT_GT(chebyshev, array_beam_width(half_wavelength(uniform_shading(64)), wavelength_900k));
}

TEST(Shading, errors_name_function_value_and_rule) {
  EXPECT_EQ(error_of([] { chebyshev_shading(16, -10); }),
            "chebyshev_shading: side_lobe_db = -10 dB, must be within -80 and -13.3");
  EXPECT_EQ(error_of([] { chebyshev_shading(16, std::nan("")); }),
            "chebyshev_shading: side_lobe_db = nan dB, must be within -80 and -13.3");
  EXPECT_EQ(error_of([] { chebyshev_shading(0, -30); }), "chebyshev_shading: elements = 0, must be at least 1");
  EXPECT_EQ(error_of([] { hamming_shading(0); }), "hamming_shading: elements = 0, must be at least 1");
  EXPECT_EQ(error_of([] { taylor_shading(8, 0); }),
            "taylor_shading: side_lobe_db = 0 dB, must be within -80 and -13.3");
}
