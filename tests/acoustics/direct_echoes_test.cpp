// SPDX-License-Identifier: BSD-3-Clause
#include "acoustics/direct_echoes.hpp"

#include "acoustics/surface_scattering.hpp"
#include "support/heads.hpp"
#include "support/test.hpp"

namespace insonify::direct_echoes_tests {

const Medium medium{1500, {0.0345, 0, 0}};

Scatterers one_scatterer(double range, double azimuth = 0, double elevation = 0, std::uint64_t id = 1) {
  Scatterers s;
  s.range = {range};
  s.azimuth = {azimuth};
  s.elevation = {elevation};
  s.cos_incidence = {0.5F};
  s.projected_area = {0.01F};
  s.material = {0};
  s.id = {id};
  s.surfel = {0};
  return s;
}

std::complex<double> echo_of(const Scatterers& s, const EchoOptions& options) {
  const std::vector<Material> materials{{"m", 0.1}};
  return direct_echoes(s, materials, pulse_900k, medium, options).amplitude[0];
}

const EchoOptions coherent{.amplitude = SurfaceAmplitude::coherent};

TEST(LambertCrossSection, has_one_cosine_per_projected_area) {
  // A surfel of 1 m^2 at 60 degrees: mu cos^2 dS = 0.1 * 0.25 * 1.
  EXPECT_NEAR(lambert_cross_section(0.1, 0.5, 0.5 * 1.0), 0.025, 1e-15);
  // Seen at 60 degrees, received at arccos 0.25: mu cos_out cos_back dS.
  EXPECT_NEAR(cross_section(*surface_table(std::vector<Material>{{"m", 0.1}}, 1e5, 1500)[0], {0.5, 0.25, 0.5 * 1.0}),
              0.0125, 1e-15);
}

TEST(DirectEchoes, gives_the_sonar_equation_before_absorption) {
  const double sigma = 0.1 * 0.5 * 0.01;
  const double expected = pulse_900k.source_level_db - 40 * std::log10(7.0) + db_from_power(sigma);
  EXPECT_NEAR(pressure_level_db(std::abs(echo_of(one_scatterer(7), coherent))), expected, 1e-6);
}

TEST(DirectEchoes, loses_40_log_of_the_range_ratio) {
  const double near = std::abs(echo_of(one_scatterer(5), coherent)),
               far = std::abs(echo_of(one_scatterer(10), coherent));
  EXPECT_NEAR(db_from_amplitude(near / far), 40 * std::log10(2.0), 1e-12);
}

// A quarter wavelength of range is half a cycle of two-way phase: the sign changes.
TEST(DirectEchoes, keeps_the_two_way_phase) {
  const double wavelength = medium.sound_speed / pulse_900k.centre_frequency;
  const auto a = echo_of(one_scatterer(600 * wavelength), coherent);
  const auto b = echo_of(one_scatterer(600.25 * wavelength), coherent);
  EXPECT_NEAR(std::arg(a), 0, 1e-9);
  EXPECT_NEAR(std::abs(std::arg(b)), pi, 1e-9);
  const auto c = echo_of(one_scatterer(600.125 * wavelength), coherent);
  EXPECT_NEAR(std::arg(c), pi / 2, 1e-9);  // phase grows with range: exp(+2 i k r)
  // 72000.12 cycles: in single precision that is 72000.117.
  EXPECT_NEAR(std::arg(echo_of(one_scatterer(60.0001), coherent)), 2 * pi * 0.12, 1e-9);
}

TEST(DirectEchoes, gives_delay_and_direction_cosines) {
  const std::vector<Material> materials{{"m", 0.1}};
  const Echoes e = direct_echoes(one_scatterer(7.5, 0.3, -0.2), materials, pulse_900k, medium, coherent);
  EXPECT_DOUBLE_EQ(e.delay[0], 0.01);
  EXPECT_DOUBLE_EQ(e.u[0], std::cos(-0.2) * std::sin(0.3));
  EXPECT_DOUBLE_EQ(e.v[0], std::sin(-0.2));
}

TEST(DirectEchoes, applies_the_elevation_pattern) {
  EchoOptions options = coherent;
  options.elevation_width = 0.2;
  options.elevation_centre = 0.05;
  const double ratio =
      std::abs(echo_of(one_scatterer(7, 0, 0.15), options)) / std::abs(echo_of(one_scatterer(7), coherent));
  EXPECT_NEAR(ratio, std::sqrt(0.5), 1e-12);
}

TEST(DirectEchoes, applies_the_transmit_pattern_in_azimuth) {
  EchoOptions options = coherent;
  options.transmit_width = 1.2;
  const double ahead = std::abs(echo_of(one_scatterer(7), options));
  EXPECT_EQ(ahead, std::abs(echo_of(one_scatterer(7), coherent)));
  for (const double side : {-1, 1}) {
    EXPECT_NEAR(std::abs(echo_of(one_scatterer(7, side * 0.6), options)) / ahead, std::sqrt(0.5), 1e-12);
    EXPECT_NEAR(std::abs(echo_of(one_scatterer(7, side * 1.2), options)) / ahead, 0.25, 1e-12);
  }
}

TEST(DirectEchoes, binds_speckle_to_the_scatterer_id_and_seed) {
  const EchoOptions speckle;
  const auto a = echo_of(one_scatterer(7, 0, 0, 5), speckle);
  EXPECT_EQ(a, echo_of(one_scatterer(7, 0, 0, 5), speckle));
  EXPECT_NE(a, echo_of(one_scatterer(7, 0, 0, 6), speckle));
  EchoOptions reseeded;
  reseeded.seed = 2;
  EXPECT_NE(a, echo_of(one_scatterer(7, 0, 0, 5), reseeded));
  // Seen from elsewhere the patch keeps its own amplitude: only geometry differs.
  const auto b = echo_of(one_scatterer(14, 0.2, 0.1, 5), speckle) / echo_of(one_scatterer(14, 0.2, 0.1, 5), coherent);
  EXPECT_LT(std::abs(b - a / echo_of(one_scatterer(7), coherent)), 1e-12);
}

TEST(DirectEchoes, coherent_fraction_mixes_1_and_the_random_amplitude_at_mean_power_1) {
  const auto xi = [](double fraction, SurfaceAmplitude law) {
    const std::vector<Material> materials{{"m", 0.1, fraction, 0}};
    EchoOptions options{.amplitude = law};
    const auto echo = direct_echoes(one_scatterer(7, 0, 0, 5), materials, pulse_900k, medium, options).amplitude[0];
    return echo / echo_of(one_scatterer(7), coherent);
  };
  for (const SurfaceAmplitude law : {SurfaceAmplitude::complex_normal, SurfaceAmplitude::random_phase}) {
    const auto z = xi(0, law);
    for (const double g : {0.25, 0.9})
      EXPECT_LT(std::abs(xi(g, law) - (std::sqrt(g) + std::sqrt(1 - g) * z)), 1e-12) << g;
    EXPECT_LT(std::abs(xi(1, law) - 1.0), 1e-15);
  }
  EXPECT_EQ(xi(0.5, SurfaceAmplitude::coherent), xi(0, SurfaceAmplitude::coherent));
}

TEST(DirectEchoes, coherent_fraction_must_be_a_fraction) {
  for (const double fraction : {-0.1, 1.1}) {
    const std::vector<Material> materials{{"mud", 0.1, fraction, 0}};
    expect_error(ErrorKind::argument,
                 {"direct_echoes: coherent_fraction of material 'mud' = ", ", must be within 0 and 1"},
                 [&] { direct_echoes(one_scatterer(7), materials, pulse_900k, medium, coherent); });
  }
}

TEST(DirectEchoes, gives_each_scatterer_the_mu_of_its_own_material) {
  const std::vector<Material> materials{{"loud", 0.1}, {"soft", 0.025}};
  Scatterers s = one_scatterer(7);
  const auto loud = direct_echoes(s, materials, pulse_900k, medium, coherent).amplitude[0];
  s.material = {1};
  const auto soft = direct_echoes(s, materials, pulse_900k, medium, coherent).amplitude[0];
  EXPECT_NEAR(std::abs(loud) / std::abs(soft), 2, 1e-12);
}

TEST(DirectEchoes, gives_silence_for_a_grazing_patch_without_dividing) {
  Scatterers s = one_scatterer(7);
  s.cos_incidence = {0};
  s.projected_area = {0};
  EXPECT_EQ(std::abs(echo_of(s, EchoOptions{})), 0);
}

TEST(DirectEchoes, names_the_scatterer_it_refuses) {
  expect_error(ErrorKind::argument, {"range[0] = 0 m, must be > 0"}, [] { echo_of(one_scatterer(0), coherent); });
  Scatterers s = one_scatterer(7);
  s.material = {3};
  EXPECT_THROW(echo_of(s, coherent), Error);
  for (const double mu : {-0.1, std::nan(""), HUGE_VAL}) {
    const std::vector<Material> odd{{"odd", mu}};
    expect_error(ErrorKind::argument, {"lambert_mu", "'odd'", ">= 0"},
                 [&] { direct_echoes(one_scatterer(7), odd, pulse_900k, medium); });
  }
}

TEST(TargetEchoes, uses_the_given_cross_section_and_amplitude) {
  const std::vector<double> sigma{0.01};
  const std::vector<std::complex<double>> xi{{0, 2}};
  const auto a = target_echoes(one_scatterer(7), sigma, xi, pulse_900k, medium).amplitude[0];
  const double expected = pulse_900k.source_level_db - 40 * std::log10(7.0) - 20 + 20 * std::log10(2.0);
  EXPECT_NEAR(pressure_level_db(std::abs(a)), expected, 1e-9);
  EXPECT_THROW(target_echoes(one_scatterer(7), {}, xi, pulse_900k, medium), Error);
  for (const double wrong : {-1.0, std::nan(""), HUGE_VAL})
    expect_error(ErrorKind::argument, {"sigma[0]", "m^2", ">= 0"},
                 [&] { target_echoes(one_scatterer(7), std::vector<double>{wrong}, xi, pulse_900k, medium); });
}

}  // namespace insonify::direct_echoes_tests
