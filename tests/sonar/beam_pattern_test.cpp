// SPDX-License-Identifier: BSD-3-Clause
#include "sonar/beam_pattern.hpp"

#include "sonar/shading.hpp"
#include "support/heads.hpp"
#include "support/test.hpp"

namespace {

BeamPatternReport measure(const LineArray& array, double steering_deg = 0) {
  return measure_beam_pattern(array, wavelength_900k, radians(steering_deg));
}

std::vector<double> grating_lobes_deg(double pitch_in_wavelengths, double steering_deg) {
  std::vector<double> angles = measure(uniform_line(24, pitch_in_wavelengths), steering_deg).grating_lobes;
  for (double& angle : angles) angle = degrees(angle);
  return angles;
}

void expect_angles(const std::vector<double>& angles, const std::vector<double>& expected) {
  ASSERT_EQ(angles.size(), expected.size());
  for (std::size_t i = 0; i < angles.size(); ++i) EXPECT_NEAR(angles[i], expected[i], 0.005);
}

}  // namespace

// wavelength_900k / (N d), whatever pitch and steering.
TEST(BeamPattern, first_null_of_a_uniform_array) {
  for (const std::size_t n : {2U, 4U, 8U, 32U, 256U})
    for (const double pitch : {0.5, 0.75, 1.0}) {
      const double null = std::asin(1 / (static_cast<double>(n) * pitch));
      ASSERT_TRUE(measure(uniform_line(n, pitch)).first_null.has_value());
      EXPECT_NEAR(*measure(uniform_line(n, pitch)).first_null, null, 1e-8) << n << " elements";
    }
  const double u = std::sin(radians(30));
  EXPECT_NEAR(*measure(uniform_line(32, 0.5), 30).first_null, radians(30) - std::asin(u - 1.0 / 16), 1e-9);
  EXPECT_NEAR(*measure(uniform_line(32, 0.5), -30).first_null, *measure(uniform_line(32, 0.5), 30).first_null, 1e-12);
}

// The first side lobe of the Dirichlet kernel; -13.2615 dB for a continuous line.
TEST(BeamPattern, side_lobe_of_a_uniform_array) {
  const auto side_lobe = [](std::size_t n) { return measure(uniform_line(n, 0.5)).highest_side_lobe_db; };
  EXPECT_NEAR(side_lobe(4), -11.30, 0.005);
  EXPECT_NEAR(side_lobe(8), -12.80, 0.005);
  EXPECT_NEAR(side_lobe(16), -13.147, 0.0006);
  EXPECT_NEAR(side_lobe(32), -13.233, 0.0006);
  EXPECT_NEAR(side_lobe(256), -13.261, 0.0006);
  // At 1.43030 wavelength_900k / L for a continuous line.
  EXPECT_NEAR(std::sin(measure(uniform_line(256, 0.5)).highest_side_lobe), 1.4303 / 128, 2e-6);
}

// Half-power width times N d / wavelength_900k.
TEST(BeamPattern, width_of_a_uniform_array) {
  const auto in_u = [](std::size_t n) {
    return 2 * std::sin(measure(uniform_line(n, 0.5)).width / 2) * 0.5 * static_cast<double>(n);
  };
  EXPECT_NEAR(in_u(4), 0.91078, 6e-6);
  EXPECT_NEAR(in_u(16), 0.88739, 6e-6);
  EXPECT_NEAR(in_u(256), 0.88590, 6e-6);
  EXPECT_EQ(measure(uniform_line(16, 0.5)).width, array_beam_width(uniform_line(16, 0.5), wavelength_900k));
}

TEST(BeamPattern, steered_width_grows_as_one_over_cosine) {
  const LineArray array{wavelength_900k / 2, taylor_shading(128, -30)};
  const double broadside = measure(array).width;
  for (const double s : {10.0, 30.0, 45.0, 60.0}) {
    EXPECT_NEAR(measure(array, s).width * std::cos(radians(s)) / broadside, 1, 2e-3) << s;
    EXPECT_NEAR(measure(array, -s).width, measure(array, s).width, 1e-12) << s;
    // Exact: the pattern does not change shape in u, and B^2 is 1/2 at both edges.
    const double h = std::sin(broadside / 2), u = std::sin(radians(s));
    EXPECT_NEAR(measure(array, s).width, std::asin(u + h) - std::asin(u - h), 1e-12) << s;
  }
}

// Beyond asin(1 - h) one flank ends at endfire.
TEST(BeamPattern, steered_width_ends_at_endfire) {
  const LineArray array = uniform_line(16, 0.5);
  const double h = std::sin(measure(array).width / 2);
  EXPECT_NEAR(measure(array, 90).width, pi / 2 - std::asin(1 - h), 1e-9);
  EXPECT_NEAR(measure(array, -90).width, measure(array, 90).width, 1e-12);
}

// sin g = sin s + n wavelength_900k / d. Pitch 1: endfire; 1.5: 41.81; 2: 30 and 90 degrees, on both sides.
TEST(GratingLobes, are_at_their_closed_form) {
  expect_angles(grating_lobes_deg(0.5, 0), {});
  expect_angles(grating_lobes_deg(1.0, 0), {-90, 90});
  expect_angles(grating_lobes_deg(1.5, 0), {-41.81, 41.81});
  expect_angles(grating_lobes_deg(2.0, 0), {-90, -30, 30, 90});
  expect_angles(grating_lobes_deg(1.0, 30), {-30});
  expect_angles(grating_lobes_deg(1.0, -30), {30});
}

TEST(GratingLobes, are_as_high_as_the_beam) {
  const LineArray array = uniform_line(24, 1.5);
  for (const double g : measure(array, 20).grating_lobes)
    EXPECT_NEAR(std::abs(array_response(array, wavelength_900k, std::sin(g), std::sin(radians(20)))), 1, 1e-12);
}

// None while |sin s| < wavelength_900k / d - 1: 19.47 degrees at a pitch of 0.75, all of them at half a wavelength.
TEST(GratingLobes, are_absent_for_small_steering) {
  expect_angles(grating_lobes_deg(0.75, 19.4), {});
  expect_angles(grating_lobes_deg(0.75, -19.4), {});
  EXPECT_EQ(grating_lobes_deg(0.75, 19.5).size(), 1U);
  EXPECT_LT(grating_lobes_deg(0.75, 19.5)[0], -87);
  EXPECT_EQ(grating_lobes_deg(0.75, -19.5).size(), 1U);
  expect_angles(grating_lobes_deg(0.5, 89), {});
}

// Grating lobes are not side lobes and do not mask them, but the flank of one that peaks just beyond endfire counts.
TEST(GratingLobes, are_distinguished_from_side_lobes) {
  EXPECT_NEAR(measure(uniform_line(16, 1.5), 10).highest_side_lobe_db, -13.147, 0.0006);
  const LineArray array = uniform_line(16, 0.5);
  const BeamPatternReport report = measure(array, 75);
  EXPECT_TRUE(report.grating_lobes.empty());
  EXPECT_NEAR(report.highest_side_lobe, -pi / 2, 1e-9);
  const double at_end = std::abs(array_response(array, wavelength_900k, -1, std::sin(radians(75))));
  EXPECT_GT(at_end, 0.5);
  EXPECT_NEAR(report.highest_side_lobe_db, db_from_amplitude(at_end), 1e-9);
}

// Against a fine scan from endfire to endfire outside of main lobe and grating lobes.
TEST(BeamPattern, side_lobe_is_the_highest_of_a_scan) {
  for (const double pitch : {0.3, 0.5, 0.9, 1.7})
    for (const double steering : {0.0, 12.0, -50.0})
      for (const Shading shading : {Shading::uniform, Shading::taylor, Shading::hamming, Shading::chebyshev}) {
        const LineArray array{pitch * wavelength_900k, shading_weights(shading, 20, -25)};
        const BeamPatternReport report = measure(array, steering);
        const double u_beam = std::sin(radians(steering));
        const double null =
            std::abs(u_beam - std::sin(radians(std::abs(steering)) - *report.first_null) * (steering < 0 ? -1 : 1));
        double highest = 0;
        for (int i = -20000; i <= 20000; ++i) {
          const double offset = std::remainder(i / 20000.0 - u_beam, 1 / pitch);
          if (std::abs(offset) > null)
            highest = std::max(highest, std::abs(array_response(array, wavelength_900k, offset, 0)));
        }
        EXPECT_NEAR(report.highest_side_lobe_db, db_from_amplitude(highest), 2e-3)
            << shading_name(shading) << ", pitch " << pitch << ", steered to " << steering;
        EXPECT_NEAR(std::abs(array_response(array, wavelength_900k, std::sin(report.highest_side_lobe), u_beam)),
                    amplitude_from_db(report.highest_side_lobe_db), 1e-9);
      }
}

TEST(BeamPattern, of_an_array_shorter_than_a_wavelength_is_finite) {
  const BeamPatternReport one = measure(uniform_line(1, 0.5), 20);
  EXPECT_DOUBLE_EQ(one.width, pi);
  EXPECT_FALSE(one.first_null.has_value());
  EXPECT_TRUE(std::isinf(one.highest_side_lobe_db));
  EXPECT_TRUE(one.grating_lobes.empty());
  EXPECT_NEAR(one.directivity_index_db, 0, 1e-12);
  const BeamPatternReport two = measure(uniform_line(2, 0.3));
  EXPECT_FALSE(two.first_null.has_value()) << "lambda / (N d) lies beyond endfire";
  EXPECT_TRUE(std::isinf(two.highest_side_lobe_db));
}

// Weights 1 2 3 2 1 are three elements convolved with themselves: their pattern touches zero where that of three
// crosses it, without a change of sign.
TEST(BeamPattern, finds_a_null_that_does_not_cross_zero) {
  const LineArray array{wavelength_900k / 2, {5.0 / 9, 10.0 / 9, 15.0 / 9, 10.0 / 9, 5.0 / 9}};
  EXPECT_NEAR(*measure(array).first_null, std::asin(2.0 / 3), 1e-6);
}

// The referee integrates B^2 over u. At half a wavelength it does not depend on steering: 10 log10 N.
TEST(DirectivityIndex, of_a_steered_beam_is_the_integral) {
  EXPECT_NEAR(measure(uniform_line(40, 0.5), 50).directivity_index_db, 10 * std::log10(40), 1e-9);
  const LineArray array{0.7 * wavelength_900k, taylor_shading(24, -30)};
  const double u_beam = std::sin(radians(35));
  const int steps = 20000;
  double integral = 0;
  for (int i = 0; i < steps; ++i) {
    const double b = array_response(array, wavelength_900k, -1 + 2 * (i + 0.5) / steps, u_beam).real();
    integral += b * b * 2 / steps;
  }
  EXPECT_NEAR(measure(array, 35).directivity_index_db, 10 * std::log10(2 / integral), 1e-6);
}

TEST(BeamPatternCurve, runs_from_endfire_to_endfire_with_its_peak_on_the_beam) {
  const LineArray array{wavelength_900k / 2, taylor_shading(64, -30)};
  const BeamPatternCurve curve = beam_pattern_curve(array, wavelength_900k, radians(25));
  ASSERT_EQ(curve.azimuth.size(), curve.level_db.size());
  EXPECT_DOUBLE_EQ(curve.azimuth.front(), -pi / 2);
  EXPECT_DOUBLE_EQ(curve.azimuth.back(), pi / 2);
  EXPECT_TRUE(std::is_sorted(curve.azimuth.begin(), curve.azimuth.end()));
  const auto peak = std::max_element(curve.level_db.begin(), curve.level_db.end());
  EXPECT_NEAR(*peak, 0, 0.05);
  EXPECT_NEAR(degrees(curve.azimuth[static_cast<std::size_t>(peak - curve.level_db.begin())]), 25, 0.1);
  // One null between every two lobes: 63 over a full turn of phase, which is all of u here.
  EXPECT_EQ(std::count(curve.level_db.begin(), curve.level_db.end(), db_from_amplitude(0)), 63);
}

TEST(BeamPattern, refuses_invalid_beams) {
  const LineArray array = uniform_line(4, 0.5);
  EXPECT_EQ(error_of([&] { measure_beam_pattern(array, wavelength_900k, radians(91)); }),
            "measure_beam_pattern: steering = 91 deg, must be within -90 and 90");
  EXPECT_EQ(error_of([&] { measure_beam_pattern(array, 0, 0); }),
            "measure_beam_pattern: wavelength = 0 m, must be > 0");
  EXPECT_EQ(error_of([&] { beam_pattern_curve(array, wavelength_900k, std::nan("")); }),
            "beam_pattern_curve: steering = nan deg, must be within -90 and 90");
  EXPECT_EQ(error_of([&] { measure_beam_pattern({}, wavelength_900k, 0); }),
            "measure_beam_pattern: array has no elements, must have at least one");
}
