// SPDX-License-Identifier: BSD-3-Clause
// A. Rascon, Forward-Looking Sonar Simulation Model for Robotic Applications (Naval Postgraduate School): what its
// equations and figures come to when they are put right. docs/results/thesis.md has the details.
#include "thesis/thesis.hpp"

#include "acoustics/surface_scattering.hpp"
#include "beamforming/synthesize.hpp"
#include "sonar/beam_pattern.hpp"
#include "sonar/shading.hpp"
#include "support/test.hpp"

using namespace insonify::thesis;

namespace {

constexpr double thesis_wavelength = speed_of_sound / 900e3;

/// Returns targets of 1 m^2 straight ahead, or at these azimuths.
Echoes targets(const std::vector<double>& range, std::vector<double> azimuth = {}) {
  azimuth.resize(range.size(), 0);
  Scatterers s;
  s.range = range, s.azimuth = azimuth;
  s.elevation.assign(range.size(), 0);
  const std::vector<double> sigma(range.size(), 1);
  const std::vector<std::complex<double>> xi(range.size(), 1);
  return target_echoes(s, sigma, xi, table_2_pulse(), medium());
}

Eigen::Index bin_of(const RangeGate& gate, double range) {
  return static_cast<Eigen::Index>((range - gate.min_range) / gate.bin_size);
}

/// Returns the amplitude in all beams at one range.
std::vector<double> slice(const Echoes& echoes, const SonarHead& head, double range) {
  const ComplexGrid pressure = synthesize_direct(echoes, head, medium());
  const Eigen::ArrayXd column = pressure.col(bin_of(head.gate, range)).abs();
  return {column.begin(), column.end()};
}

double level_db(double amplitude, double reference) { return db_from_amplitude(amplitude / reference); }

/// Returns the azimuths of columns 26, 77, 128, 179 and 230 of 256, which have their scatterers at one range.
std::vector<double> repeated_azimuths() {
  const Scatterers object = make_object({256});
  std::vector<double> azimuth;
  for (std::size_t column = 25; column < 256; column += 51) azimuth.push_back(object.azimuth[column * 21]);
  return azimuth;
}

}  // namespace

// Eq. 5 and Table 2: the printed 0.0354 "dB/m" at 900 kHz has the digits of Fisher and Simmons' 0.03541 Np/m at 10 deg
// C.
TEST(Thesis, absorption_of_0_0354_is_in_nepers) {
  const double db = absorption_db_per_m({}, 900e3, AbsorptionFormula::fisher_simmons);
  EXPECT_NEAR(db * nepers_per_db, printed_absorption, 5e-5);
  EXPECT_NEAR(db, 0.3076, 1e-4);
  EXPECT_NEAR(absorption_db_per_m({}, 900e3), 0.2995, 5e-5);
}

// Eq. 20: with the area seen from the head, Lambert's law keeps one cosine. Two lose 3 dB at 60 degrees and 1.249 dB
// over a sphere: sum mu cos dA = 2 pi mu a^2 / 3, sum mu cos^2 dA = pi mu a^2 / 2.
TEST(Thesis, second_cosine_of_equation_20_loses_3_db_at_60_degrees) {
  const double steep = std::cos(radians(60)), area = 0.01;
  EXPECT_NEAR(db_from_power(1e-3 * steep * steep * area / lambert_cross_section(1e-3, steep, area)), -3.0103, 1e-4);
  const double a = 0.1, mu = 1e-3;
  const int rings = 20000;
  double one = 0, two = 0;
  for (int i = 0; i < rings; ++i) {
    const double rho = a * (i + 0.5) / rings, cosine = std::sqrt(1 - rho * rho / (a * a));
    const double sigma = lambert_cross_section(mu, cosine, 2 * pi * rho * a / rings);
    one += sigma, two += sigma * cosine;
  }
  EXPECT_NEAR(one / (2 * pi * mu * a * a / 3), 1, 1e-6);
  EXPECT_NEAR(db_from_power(two / one), -1.249, 1e-3);
}

// Eq. 21: the phase is that of the way there and back. A target at 5 m appears at 5 m; moved away by an eighth of a
// thesis_wavelength its phase turns by a quarter of a cycle. Eq. 27: time runs forwards; in a window of 13 m it is not
// at 8 m.
TEST(Thesis, a_target_at_5_m_appears_at_5_m) {
  SonarHead head = make_sonar(51);
  head.gate = {1, 13, 2e-3};
  head.fan.azimuth = {0}, head.fan.elevation = {0};
  for (const auto synthesize : {synthesize_spectrum, synthesize_direct, synthesize_gridded}) {
    const ComplexGrid pressure = synthesize(targets({5}), head, medium(), {});
    EXPECT_NEAR(find_peak(pressure, 0, head.gate, 7, 5.9).range, 5, 1e-6);
    const double peak = std::abs(pressure(0, bin_of(head.gate, 5)));
    for (const double wrong : {2.5, 8.0, 10.0}) EXPECT_LT(std::abs(pressure(0, bin_of(head.gate, wrong))), 1e-9 * peak);
  }
  const auto turn = targets({5 + thesis_wavelength / 8}).amplitude[0] / targets({5}).amplitude[0];
  EXPECT_NEAR(std::arg(turn), pi / 2, 1e-9);
}

// Eq. 7: sound decays on its way, by exp(-2 alpha r).
TEST(Thesis, echoes_decay_with_range) {
  SonarHead head = make_sonar(51);
  head.gate = {1, 13, 1e-3};
  head.fan.azimuth = {0}, head.fan.elevation = {0};
  const ComplexGrid pressure = synthesize_spectrum(targets({3, 6, 12}), head, medium());
  const double alpha = absorption_db_per_m({}, 900e3);
  const double near = find_peak(pressure, 0, head.gate, 3, 0.1).level_db;
  EXPECT_NEAR(near - find_peak(pressure, 0, head.gate, 6, 0.1).level_db, 40 * std::log10(2) + 2 * alpha * 3, 1e-6);
  EXPECT_NEAR(near - find_peak(pressure, 0, head.gate, 12, 0.1).level_db, 40 * std::log10(4) + 2 * alpha * 9, 1e-6);
}

// Eq. 22 put right, exp(-(f - fc)^2 pi^2 / b^2), is exp(-b^2 t^2) in time and 0.3748 b wide at -3 dB.
TEST(Thesis, spectrum_of_equation_22_is_0_375_b_wide) {
  const double b = 295e3;
  EXPECT_NEAR(table_2_pulse().bandwidth / b, 0.3748, 5e-5);
  const EchoEnvelope pulse = echo_envelope(table_2_pulse(), {}, 1);
  for (const double t : {0.0, 1e-6, 2e-6, 5e-6, 1e-5})
    EXPECT_NEAR(std::abs(pulse.at(t) - std::exp(-b * b * t * t)), 0, 1e-14);
}

// Eq. 33: sinc^2(x) = 1/2 at x = 0.442946, so the constant is 0.885893; the printed 0.884 stands at -2.996 dB.
TEST(Thesis, constant_of_equation_33_is_0_885893) {
  const LineArray line{thesis_wavelength / 100, uniform_shading(2000)};
  const double length = 20;  // [wavelengths]
  EXPECT_NEAR(2 * half_power_offset(line, thesis_wavelength, 1) * length, 0.885893, 2e-6);
  EXPECT_NEAR(db_from_amplitude(array_response(line, thesis_wavelength, 0.884 / 2 / length, 0).real()), -2.996, 1e-3);
}

// Figures 17 to 21: a beam of 0.1 rad has its first null at 6.48 degrees.
TEST(Thesis, beam_of_a_tenth_of_a_radian_has_its_first_null_at_6_5_degrees) {
  const BeamPatternReport report = measure_beam_pattern(aperture(144), thesis_wavelength, 0);
  EXPECT_NEAR(report.width, 0.1, 1e-5);
  ASSERT_TRUE(report.first_null);
  EXPECT_NEAR(degrees(*report.first_null), 6.479, 1e-3);
  EXPECT_TRUE(report.grating_lobes.empty());
}

// Figure 14: every peak stands at 2 r / c, where the thesis has 3.55 % less, and has the level of the sonar equation.
TEST(Thesis, travel_times_of_figure_14_are_right_to_a_millimetre) {
  const Case which;
  const Scatterers object = make_object(which);
  const SonarHead head = make_sonar(which.beams);
  const Echoes echoes = echoes_of_object(object);
  const ComplexGrid columns = column_series(echoes, which, head);
  for (std::size_t i = 0; i < object.size(); ++i) {
    const Peak peak = find_peak(columns, i / which.rays, head.gate, object.range[i], 0.02);
    ASSERT_NEAR(peak.sample_range, object.range[i], 0.5001 * head.gate.bin_size);
    ASSERT_NEAR(peak.range, object.range[i], 1e-9);
    const double decay = std::exp(-2 * medium().absorption.a0 * object.range[i]);
    ASSERT_NEAR(peak.level_db, pressure_level_db(std::abs(echoes.amplitude[i]) * decay), 1e-9);
  }
}

// Figures 17, 19, 21: without noise, the slice through one scatterer is the beam pattern.
TEST(Thesis, slice_through_one_scatterer_is_the_beam_pattern) {
  const SonarHead head = make_sonar(256);
  const double azimuth = repeated_azimuths()[1], range = slice_range();
  const ComplexGrid pressure = synthesize_direct(targets({range}, {azimuth}), head, medium());
  const Eigen::Index bin = bin_of(head.gate, range);
  const std::complex<double> on_target = pressure(76, bin);  // beam 77 looks at column 77
  for (std::size_t b = 0; b < head.fan.beams(); ++b) {
    const double pattern =
        array_response(head.array, thesis_wavelength, std::sin(azimuth), std::sin(head.fan.azimuth[b])).real();
    ASSERT_NEAR(std::abs(pressure(b, bin) / on_target - pattern), 0, 1e-12);
  }
}

// Figure 21: the "grating lobes" of 256 beams are the five scatterers that stand at one range. Take four of them away
// and nothing but side lobes is left, with the same fan and the same array.
TEST(Thesis, lobes_of_figure_21_go_with_the_repeated_scatterers) {
  const SonarHead head = make_sonar(256);
  const std::vector<double> azimuth = repeated_azimuths();
  ASSERT_EQ(azimuth.size(), 5u);
  const double range = slice_range();
  const auto all = slice(targets(std::vector<double>(5, range), azimuth), head, range);
  const auto one = slice(targets({range}, {azimuth[2]}), head, range);
  const double peak = one[127];
  for (const std::size_t beam : {25, 76, 127, 178, 229}) {
    double sum = 0;  // sum over the five patterns; the neighbours' side lobes take up to a third off
    for (const double a : azimuth)
      sum += array_response(head.array, thesis_wavelength, std::sin(a), std::sin(head.fan.azimuth[beam])).real();
    EXPECT_NEAR(all[beam] / peak, sum, 1e-9) << "beam " << beam + 1;
    EXPECT_GT(sum, 0.65) << "beam " << beam + 1;
  }
  for (std::size_t b = 0; b < 256; ++b) {
    if (std::abs(head.fan.azimuth[b] - azimuth[2]) > radians(6.5)) {
      ASSERT_LT(level_db(one[b], peak), -13.2) << "beam " << b + 1;
    }
  }
}

// True grating lobes need elements more than half a thesis_wavelength apart: full copies at sin g = sin s + n lambda /
// d.
TEST(Thesis, true_grating_lobes_stand_at_the_closed_form) {
  for (const double pitch : {1.5, 2.0, 3.0}) {
    const double target = radians(-10);
    std::vector<double> lobes;
    for (int n = -6; n <= 6; ++n)
      if (const double sine = std::sin(target) + n / pitch; std::abs(sine) <= 1) lobes.push_back(std::asin(sine));
    ASSERT_GE(lobes.size(), 3u);
    SonarHead head = make_sonar(51);
    head.fan.azimuth = lobes;
    head.fan.elevation.assign(lobes.size(), 0);
    head.array = {pitch * thesis_wavelength, uniform_shading(6)};
    const auto copies = slice(targets({2.25}, {target}), head, 2.25);
    for (const double copy : copies) EXPECT_NEAR(level_db(copy, copies.front()), 0, 1e-9);

    // Elements of the same total length, half a thesis_wavelength apart, receive the target and nothing from there.
    head.array = {0.5 * thesis_wavelength, uniform_shading(static_cast<std::size_t>(12 * pitch))};
    const auto dense = slice(targets({2.25}, {target}), head, 2.25);
    const double peak = *std::max_element(dense.begin(), dense.end());
    for (std::size_t b = 0; b < lobes.size(); ++b) {
      if (std::abs(lobes[b] - target) > 1e-9) {
        EXPECT_LT(level_db(dense[b], peak), -13);
      }
    }
  }
}

// Table 4: the three methods give one image.
TEST(Thesis, three_methods_give_one_image) {
  const Case which;
  const Echoes echoes = echoes_of_object(make_object(which));
  const SonarHead head = make_sonar(which.beams, 18, default_bin_size(table_2_pulse(), speed_of_sound));
  const ComplexGrid direct = synthesize_direct(echoes, head, medium());
  const auto error = [&](const ComplexGrid& other) {
    return std::sqrt((other - direct).abs2().sum() / direct.abs2().sum());
  };
  EXPECT_LT(error(synthesize_gridded(echoes, head, medium())), 1e-4);
  EXPECT_LT(error(synthesize_spectrum(echoes, head, medium())), 1e-12);
}
