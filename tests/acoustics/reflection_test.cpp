// SPDX-License-Identifier: BSD-3-Clause
#include "acoustics/reflection.hpp"

#include "support/errors.hpp"
#include "support/test.hpp"

// Values of an independent evaluation for the medium sand of the APL-UW handbook TR 9407 (1994), to three digits.
TEST(BottomReflection, of_medium_sand_is_the_tabulated_one) {
  const FlatBottom sand;
  const double expected[][2] = {{5, 0.976}, {20, 0.937}, {30, 0.876}, {45, 0.471}, {90, 0.370}};
  for (const auto& [grazing_deg, size] : expected)
    EXPECT_NEAR(std::abs(bottom_reflection(sand, radians(grazing_deg))), size, 6e-4) << grazing_deg;
}

TEST(BottomReflection, at_normal_incidence_is_the_ratio_of_impedances) {
  FlatBottom b;
  b.loss = 0;
  const double z = b.density_ratio * b.sound_speed_ratio;
  EXPECT_NEAR(std::abs(bottom_reflection(b, pi / 2) - (z - 1) / (z + 1)), 0, 1e-12);
}

TEST(BottomReflection, is_minus_one_at_grazing_zero_and_never_above_one) {
  for (const double speed : {0.9, 0.98, 1.0, 1.2, 2.5})
    for (const double loss : {0.0, 0.01, 0.3}) {
      const FlatBottom b{.density_ratio = 1.5, .sound_speed_ratio = speed, .loss = loss};
      if (speed != 1 || loss > 0) {
        EXPECT_NEAR(std::abs(bottom_reflection(b, 0) + 1.0), 0, 1e-9);
      }
      for (double g = 0; g <= pi / 2; g += 0.01) EXPECT_LE(std::abs(bottom_reflection(b, g)), 1 + 1e-12) << speed;
    }
}

// Below the critical angle of a lossless fast sediment reflection is total.
TEST(BottomReflection, is_total_below_the_critical_angle_without_loss) {
  FlatBottom b;
  b.loss = 0;
  const double critical = std::acos(1 / b.sound_speed_ratio);
  EXPECT_NEAR(std::abs(bottom_reflection(b, 0.99 * critical)), 1, 1e-12);
  EXPECT_LT(std::abs(bottom_reflection(b, 1.01 * critical)), 0.9);
}

// Sound that enters then fades with depth: with exp(-i omega t), q of E45 is positive imaginary, and the reflection
// lags. Loss must have the same sign: a little of it changes little, and a growing wave would turn the phase round.
TEST(BottomReflection, lags_below_the_critical_angle) {
  FlatBottom b;
  const double grazing = 0.5 * std::acos(1 / b.sound_speed_ratio), n = 1 / b.sound_speed_ratio;
  const double faded = std::sqrt(std::cos(grazing) * std::cos(grazing) - n * n);
  const double phase = -2 * std::atan(faded / (b.density_ratio * std::sin(grazing)));
  for (const double loss : {0.0, 1e-6}) {
    b.loss = loss;
    EXPECT_NEAR(std::arg(bottom_reflection(b, grazing)), phase, 1e-4) << loss;
  }
}

// Slow mud of higher density lets one angle through whole: cos^2 g = (m^2 - n^2) / (m^2 - 1).
TEST(BottomReflection, of_slow_mud_vanishes_at_the_angle_of_intromission) {
  const FlatBottom mud{.density_ratio = 1.15, .sound_speed_ratio = 0.98, .loss = 0};
  const double m = 1.15, n = 1 / 0.98;
  const double grazing = std::acos(std::sqrt((m * m - n * n) / (m * m - 1)));
  EXPECT_LT(std::abs(bottom_reflection(mud, grazing)), 1e-12);
}

TEST(BottomReflection, refuses_angles_beyond_a_quarter_turn) {
  EXPECT_EQ(error_of([] { bottom_reflection({}, 2); }),
            "bottom_reflection: grazing = 2 rad, must be within 0 and pi/2");
  EXPECT_THAT(error_of([] { bottom_reflection({}, -0.1); }), HasSubstr("grazing = -0.1 rad"));
}

// The spectrum a g^2 w^-5 exp(-b (g / (U19 w))^4) itself, by quadrature: its integral is the variance of the height.
TEST(RmsWaveHeight, is_that_of_the_spectrum_it_cites) {
  const double wind = 12, wind19 = 1.026 * wind, g = 9.81, step = 1e-4;
  double variance = 0;
  for (double w = step; w < 60; w += step)
    variance += 0.0081 * g * g * std::pow(w, -5) * std::exp(-0.74 * std::pow(g / (wind19 * w), 4)) * step;
  EXPECT_NEAR(rms_wave_height(wind), std::sqrt(variance), 1e-4 * std::sqrt(variance));
  // Significant height 4 h = 0.21 U19^2 / g (Stewart, Introduction to Physical Oceanography), given to two digits.
  EXPECT_NEAR(4 * rms_wave_height(wind) * g / (wind19 * wind19), 0.21, 0.005);
  EXPECT_EQ(rms_wave_height(0), 0);
}

TEST(RmsWaveHeight, refuses_invalid_winds) {
  EXPECT_EQ(error_of([] { rms_wave_height(-1); }), "rms_wave_height: wind_speed = -1 m/s, must be finite and >= 0");
}

TEST(RmsWaveHeight, of_an_environment_is_the_surfaces_own_or_the_winds_or_none) {
  Environment e;
  e.surface = SeaSurface{};
  EXPECT_EQ(rms_wave_height(e), 0);
  e.wind_speed = 10;
  EXPECT_EQ(rms_wave_height(e), rms_wave_height(10));
  e.surface->rms_height = 0.02;
  EXPECT_EQ(rms_wave_height(e), 0.02);
}

// The mean of exp(2 i k z sin g) over normally distributed heights z is what it claims: by quadrature.
TEST(CoherentReflectionLoss, is_the_mean_phase_over_normal_heights) {
  const double k = 40, h = 0.02, g = 0.6;
  std::complex<double> mean = 0;
  for (double z = -8 * h; z <= 8 * h; z += h / 100)
    mean +=
        std::exp(-z * z / (2 * h * h)) / (std::sqrt(2 * pi) * h) * std::polar(1.0, 2 * k * z * std::sin(g)) * h / 100.0;
  EXPECT_NEAR(coherent_reflection_loss(k, h, g), mean.real(), 1e-9);
  EXPECT_EQ(coherent_reflection_loss(k, 0, g), 1);
  EXPECT_EQ(coherent_reflection_loss(k, h, 0), 1);
}

// An independent evaluation in water of 1026 kg/m^3 and 1500 m/s, to three digits: steel, concrete, hard PVC, butyl
// rubber.
TEST(ReflectionCoefficient, of_solids_is_that_of_their_waves) {
  struct Row {
    ElasticSolid solid;
    double size[5];  // at 0, 20, 30, 45 and 60 degrees, of an independent evaluation to three decimals
  };
  const Row rows[] = {
      {{7850, 5960, 3240}, {.936, .916, 1, 1, 1}},          {{7870, 5790, 3220}, {.935, .915, 1, 1, 1}},
      {{2700, 6374, 3111}, {.836, .758, 1, 1, 1}},          {{2500, 5660, 3420}, {.804, .777, 1, 1, 1}},
      {{2650, 5950, 3000}, {.822, .738, 1, 1, 1}},          {{2460, 4855, 2700}, {.772, .668, .718, 1, 1}},
      {{2300, 4000, 2400}, {.713, .696, .656, 1, 1}},       {{917, 3840, 1900}, {.392, .421, .107, .191, 1}},
      {{1400, 2352, 1093}, {.363, .345, .341, .440, .241}}, {{1180, 2690, 1340}, {.347, .326, .353, .067, .125}},
      {{950, 2250, 885}, {.163, .154, .166, .817, .618}},   {{1110, 1830, 0}, {.138, .154, .181, .297, 1}},
      {{950, 1550, 0}, {.022, .02, .016, .005, .035}},      {{2565, 3750, 0}, {.724, .838, 1, 1, 1}},
      {{1893, 1767, 0}, {.370, .381, .399, .471, 1}}};
  const double angles[] = {0, 20, 30, 45, 60};
  for (const Row& row : rows)
    for (int k = 0; k < 5; ++k)
      EXPECT_NEAR(std::abs(reflection_coefficient(row.solid, std::cos(radians(angles[k])), 1026, 1500)), row.size[k],
                  6e-4)
          << row.solid.density << " " << angles[k];
}

TEST(ReflectionCoefficient, is_total_beyond_both_critical_angles_and_never_above_one) {
  const ElasticSolid steel{7850, 5960, 3240};
  EXPECT_NEAR(std::abs(reflection_coefficient(steel, std::cos(radians(45)), 1026, 1500)), 1, 1e-12);
  for (const double shear : {0.0, 1400.0, 1500.0, 3240.0})
    for (double cosine = 0; cosine <= 1; cosine += 1e-3)
      EXPECT_LE(std::abs(reflection_coefficient({7850, 5960, shear}, cosine, 1026, 1500)), 1 + 1e-12);
  EXPECT_EQ(reflection_coefficient(steel, 0, 1026, 1500), -1.0);
  EXPECT_NEAR(reflection_coefficient({1.2, 343, 0}, 1, 1026, 1500).real(), -.999, 1e-3);
  expect_error(ErrorKind::argument, {"reflection_coefficient", "cosine"},
               [&] { reflection_coefficient(steel, 1.1, 1026, 1500); });
}
