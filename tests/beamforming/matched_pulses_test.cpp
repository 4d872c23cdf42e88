// SPDX-License-Identifier: BSD-3-Clause
// All engines, noise and display with tone bursts and hyperbolic sweeps, against sums of the pulses' definitions.
#include "acoustics/direct_echoes.hpp"
#include "beamforming/numerics/beam_spectrum.hpp"
#include "beamforming/synthesize.hpp"
#include "beamforming/synthesize_cells.hpp"
#include "beamforming/synthesize_intensity.hpp"
#include "beamforming/synthesize_noise.hpp"
#include "support/heads.hpp"
#include "support/test.hpp"

namespace insonify::matched_pulses_tests {

using Complex = std::complex<double>;
constexpr double within_db = 0.05;

const Pulse tone{100e3, 10e3, 220, PulseShape::tone_burst};
const Pulse hyperbolic{90e3, 60e3, 220, PulseShape::hyperbolic_fm, 2e-3, ReplicaWindow::hamming};

/// Returns a head of five beams of 16 elements; its gate begins at 5 m.
SonarHead head_of(const Pulse& pulse, double max_range = 9) {
  SonarHead head = line_head(
      {.frequency = pulse.centre_frequency, .bandwidth = pulse.bandwidth, .min_range = 5, .max_range = max_range});
  head.pulse = pulse;
  return head;
}

/// Returns the echo at rest of a pulse of either kind by a sum of its definition.
Complex echo_sum(const Pulse& pulse, double t) {
  const bool sweep = pulse.shape == PulseShape::hyperbolic_fm;
  const double length = sweep ? pulse.duration : 1 / pulse.bandwidth;
  const double p1 = 1 / (pulse.centre_frequency - pulse.bandwidth / 2),
               p2 = 1 / (pulse.centre_frequency + pulse.bandwidth / 2), q = (p2 - p1) / length;
  const auto signal = [&](double tau) {
    return sweep ? std::polar(1.0, 2 * pi * (pulse.centre_frequency * tau - std::log(0.5 * (p1 + p2) + q * tau) / q))
                 : 1;
  };
  const double low = std::max(-0.5 * length, t - 0.5 * length), high = std::min(0.5 * length, t + 0.5 * length);
  if (high <= low) return 0;
  const int parts = 2000;
  Complex sum = 0;
  for (int k = 0; k < parts; ++k) {
    const double tau = low + (k + 0.5) * (high - low) / parts;
    const double weight = sweep ? 0.54 + 0.46 * std::cos(2 * pi * (tau - t) / length) : 1;
    sum += weight * signal(tau) * std::conj(signal(tau - t));
  }
  return sum * (high - low) / (parts * length * (sweep ? 0.54 : 1));
}

Echoes some_echoes() {
  Echoes e;
  for (int i = 0; i < 6; ++i) {
    e.delay.push_back(2 * (5.4 + 0.57 * i) / c0_cold);
    e.u.push_back(-0.6 + 0.23 * i);
    e.amplitude.push_back(std::polar(1 + 0.3 * i, 1.1 * i));
  }
  return e;
}

/// Returns the image by sums over echoes and elements.
ComplexGrid image_sum(const Echoes& e, const SonarHead& head, double alpha) {
  ComplexGrid image =
      ComplexGrid::Zero(static_cast<Eigen::Index>(head.fan.beams()), static_cast<Eigen::Index>(head.gate.bins()));
  for (std::size_t i = 0; i < e.size(); ++i)
    for (Eigen::Index n = 0; n < image.cols(); ++n) {
      const double range = 0.5 * c0_cold * e.delay[i];
      const Complex g = std::exp(-2 * alpha * range) * e.amplitude[i] *
                        echo_sum(head.pulse, 2 * head.gate.centre(static_cast<std::size_t>(n)) / c0_cold - e.delay[i]);
      for (Eigen::Index b = 0; b < image.rows(); ++b)
        image(b, n) += g * array_response(head.array, c0_cold / head.pulse.centre_frequency, e.u[i],
                                          std::sin(head.fan.azimuth[static_cast<std::size_t>(b)]));
    }
  return image;
}

class MatchedPulses : public testing::TestWithParam<Pulse> {};
INSTANTIATE_TEST_SUITE_P(Kinds, MatchedPulses, testing::Values(tone, hyperbolic),
                         [](const auto& of) { return std::string(pulse_shape_name(of.param.shape)); });

TEST_P(MatchedPulses, images_are_sums_of_their_definition) {
  const SonarHead head = head_of(GetParam());
  const Medium medium{c0_cold, {0.01, 0, 0}};
  const Echoes echoes = some_echoes();
  const ComplexGrid expected = image_sum(echoes, head, 0.01);
  EXPECT_LT(relative_l2(synthesize_direct(echoes, head, medium), expected), 2e-3);
  EXPECT_LT(relative_l2(synthesize_spectrum(echoes, head, medium), expected), 2e-3);
  EXPECT_LT(relative_l2(synthesize_gridded(echoes, head, medium, {1e-3}), expected), 3e-3);
  EXPECT_LT(relative_l2(synthesize_gridded(echoes, head, medium, {1e-6}), synthesize_direct(echoes, head, medium)),
            1e-6);
}

// With Doppler shifts and absorption of the second order every echo has a shape of its own.
TEST_P(MatchedPulses, echoes_of_all_shapes_are_alike_in_all_engines) {
  const SonarHead head = head_of(GetParam());
  const Medium medium{c0_cold, absorption_about({}, head.pulse.centre_frequency, 2)};
  Echoes echoes = some_echoes();
  for (std::size_t i = 0; i < echoes.size(); ++i) echoes.doppler.push_back(-300 + 120.0 * static_cast<double>(i));
  const ComplexGrid direct = synthesize_direct(echoes, head, medium);
  EXPECT_LT(relative_l2(synthesize_gridded(echoes, head, medium, {1e-6}), direct), 1e-6);
  EXPECT_LT(relative_l2(synthesize_spectrum(echoes, head, medium), direct), 5e-3);
  const Grid<double> power = synthesize_intensity(echoes, head, medium);
  EXPECT_NEAR(db_from_power(power.sum() / direct.abs2().sum()), 0, 0.5);  // the echoes hardly overlap
}

// One echo on the axis of a beam: energy by each model against the sum of the definition.
TEST_P(MatchedPulses, levels_of_every_engine_are_those_of_the_sum) {
  const SonarHead head = head_of(GetParam());
  const Medium medium{c0_cold, {}};
  Echoes one;
  one.delay = {2 * 7 / c0_cold}, one.u = {0}, one.amplitude = {3};
  const double expected = image_sum(one, head, 0).row(2).abs2().sum();
  for (const auto method : {SynthesisMethod::direct, SynthesisMethod::gridded, SynthesisMethod::spectrum,
                            SynthesisMethod::true_delays, SynthesisMethod::element_exact, SynthesisMethod::incoherent})
    EXPECT_NEAR(db_from_power(synthesize(one, head, medium, method, {1e-2}).row(2).abs2().sum() / expected), 0,
                within_db)
        << static_cast<int>(method);
}

TEST_P(MatchedPulses, display_cells_have_their_energy) {
  const Pulse& pulse = GetParam();
  SonarHead head = head_of(pulse, 12);
  head.gate.bin_size = 0.5;
  SurfaceEchoes one;
  one.echoes.delay = {2 * 8.5 / c0_cold}, one.echoes.u = {0}, one.echoes.amplitude = {3};
  one.id = {1}, one.power = {9}, one.depth = {0}, one.width = {0};
  const Grid<double> cells = synthesize_cells(one, {}, head, {c0_cold, {}}, {.speckle = false});
  double energy = 0;
  for (double t = -pulse_half_length(pulse, 1e-3); t < pulse_half_length(pulse, 1e-3); t += 0.02 / pulse.bandwidth)
    energy += 0.02 / pulse.bandwidth * std::norm(echo_sum(pulse, t));
  EXPECT_NEAR(db_from_power(cells.row(2).sum() * 0.5 / (9 * 0.5 * c0_cold * energy)), 0, within_db);
  EXPECT_NEAR(db_from_power(energy_length(pulse, c0_cold) / (0.5 * c0_cold * energy)), 0, within_db);
}

// White noise behind the filter: its level, and its correlation, which for a uniform replica is the echo.
TEST_P(MatchedPulses, noise_has_level_and_correlation_of_the_filter) {
  SonarHead head = head_of(GetParam(), 400);
  head.fan = make_fan(1, 1, 1, 1), head.array = {0.5 * c0_cold / head.pulse.centre_frequency, {1}};
  head.pulse.window = ReplicaWindow::uniform;
  const ComplexGrid p = synthesize_noise(head, {c0_cold, {}}, 60, {.seed = 4});
  EXPECT_NEAR(pressure_level_db(std::sqrt(p.abs2().mean())), 60, 0.15);
  const EchoEnvelope echo = echo_envelope(head.pulse, {}, 0);
  for (const int lag : {1, 2, 3}) {
    const Eigen::Index n = p.cols() - lag;
    const Complex found = (p.row(0).tail(n) * p.row(0).head(n).conjugate()).sum() / p.row(0).abs2().sum();
    EXPECT_NEAR(std::abs(found), std::abs(echo.at(lag * 2 * head.gate.bin_size / c0_cold)), 0.035) << lag;
  }
}

TEST(ToneBurstSpectrum, of_a_beam_is_the_fourth_power_of_a_sinc) {
  const double length = 1 / tone.bandwidth;
  std::vector<double> frequency;
  for (int k = -30; k <= 30; ++k) frequency.push_back(tone.centre_frequency + 500.0 * k);
  const std::vector<double> density = pulse_density(tone, 0.44 * length, frequency, 1);
  // Eight samples per bin fold sinc^2 back from every 18 B: up to pi^2 / 3 (0.055 / pi)^2 of its peak, of two folds.
  const double corner = 0.055 * 0.055 / 3;
  const auto folded = [](double x) {  // with what the sampling folds back
    double sum = 0;
    for (int fold = -20; fold <= 20; ++fold) {
      const double y = pi * (x + fold / 0.44);
      sum += y == 0 ? 1 : std::pow(std::sin(y) / y, 4);
    }
    return sum;
  };
  for (std::size_t k = 0; k < frequency.size(); ++k) {
    const double y = (frequency[k] - tone.centre_frequency) * length;
    const double expected = folded(y) / folded(0);
    EXPECT_NEAR(density[k] / density[30], expected, 2 * corner * std::sqrt(2 * expected) + corner * corner) << k;
  }
}

}  // namespace insonify::matched_pulses_tests
