// SPDX-License-Identifier: BSD-3-Clause
#include "beamforming/synthesize.hpp"

#include "acoustics/direct_echoes.hpp"
#include "core/random.hpp"
#include "sonar/shading.hpp"
#include "support/point_targets.hpp"
#include "support/test.hpp"

namespace insonify::synthesize_tests {

SonarHead head_of(std::size_t beams, std::size_t elements, double max_range = 3) {
  return line_head({.beams = beams, .elements = elements, .max_range = max_range});
}

/// Random echoes in and around the gate of `head`, amplitudes over 40 dB.
Echoes random_echoes(std::size_t n, double min_range, double max_range, std::uint64_t seed = 3) {
  Echoes e;
  for (std::uint64_t i = 0; i < n; ++i) {
    const auto x = random_uniform(seed, RandomStage::scene_points, {i, 0, 0});
    e.delay.push_back(2 * (min_range + (max_range - min_range) * x[0]) / c0_cold);
    e.u.push_back(-0.9 + 1.8 * x[1]);
    e.amplitude.push_back(std::polar(std::pow(10, -2 * x[2]), 2 * pi * x[3]));
  }
  return e;
}

Medium medium(int order = 0) { return {c0_cold, absorption_about({}, 750e3, order)}; }

using Synthesis = ComplexGrid (*)(const Echoes&, const SonarHead&, const Medium&, const SynthesisOptions&);

// One scatterer on axis at a bin centre: the peak is the sonar equation, SL - 2 TL + TS, in every method.
TEST(Synthesize, peak_of_one_scatterer_is_the_sonar_equation) {
  const SonarHead head = head_of(1, 32);
  const double r = head.gate.centre(200), ts = -20;
  const Echoes echoes = echoes_of(targets_at({r}), head.pulse, medium(), power_from_db(ts));
  const double loss = 20 * std::log10(r) + medium().absorption.a0 / nepers_per_db * r;
  for (const Synthesis synthesize : {synthesize_direct, synthesize_gridded, synthesize_spectrum}) {
    const ComplexGrid p = synthesize(echoes, head, medium(), {1e-12, 0});
    Eigen::Index beam, bin;
    const double peak = p.abs().maxCoeff(&beam, &bin);
    EXPECT_EQ(bin, 200);
    EXPECT_NEAR(pressure_level_db(peak), 220 - 2 * loss + ts, 1e-9);
  }
}

// SL 220 dB, 10 m, 0.2994626 dB/m, TS -20 dB: 220 - 2 (20 + 2.994626) - 20 dB = 70.97 Pa peak.
TEST(Synthesize, worked_example_of_the_sonar_equation) {
  SonarHead head = head_of(1, 1, 12);
  head.pulse.centre_frequency = 900e3;
  head.gate.min_range = 10 - 100.5 * head.gate.bin_size;
  const double r = head.gate.centre(100);
  ASSERT_NEAR(r, 10, 1e-12);
  const Medium m{c0_cold, {0.2994626 * nepers_per_db, 0, 0}};
  const Echoes echoes = echoes_of(targets_at({r}), head.pulse, m, 0.01);
  for (const Synthesis synthesize : {synthesize_direct, synthesize_gridded}) {
    const double peak = synthesize(echoes, head, m, {1e-12, 0}).abs().maxCoeff();
    EXPECT_NEAR(pressure_level_db(peak), 154.010748, 1e-10);
    EXPECT_NEAR(peak, 70.97, 0.005);
  }
}

TEST(Synthesize, gridded_keeps_its_tolerance_against_the_referee) {
  for (const std::size_t beams : {1, 17, 64})
    for (const std::size_t n : {1, 10, 1000}) {
      const SonarHead head = head_of(beams, 37);
      const Echoes echoes = random_echoes(n, 0.9, 3.1);
      for (const int order : {0, 2}) {
        const ComplexGrid reference = synthesize_direct(echoes, head, medium(order));
        for (const double tolerance : {1e-2, 1e-4, 1e-6, 1e-8, 1e-10})
          EXPECT_LT(relative_l2(synthesize_gridded(echoes, head, medium(order), {tolerance, 0}), reference), tolerance)
              << beams << " beams, " << n << " echoes, order " << order;
      }
    }
}

// An independent method: sum over frequencies, one FFT, no closed form of the pulse.
TEST(Synthesize, spectrum_form_agrees_with_the_referee) {
  const SonarHead head = head_of(5, 16, 2);
  const Echoes echoes = random_echoes(40, 1.0, 2.0);
  for (const int order : {0, 1, 2})
    EXPECT_LT(
        relative_l2(synthesize_spectrum(echoes, head, medium(order)), synthesize_direct(echoes, head, medium(order))),
        1e-11)
        << "absorption order " << order;
}

TEST(Synthesize, is_linear_in_the_echoes) {
  const SonarHead head = head_of(9, 16);
  const Echoes a = random_echoes(30, 1, 3, 1), b = random_echoes(30, 1, 3, 2);
  Echoes both = a;
  both.delay.insert(both.delay.end(), b.delay.begin(), b.delay.end());
  both.u.insert(both.u.end(), b.u.begin(), b.u.end());
  for (const auto& z : b.amplitude) both.amplitude.push_back(2.0 * z);
  const auto gridded = [&](const Echoes& echoes) { return synthesize_gridded(echoes, head, medium(), {1e-12, 0}); };
  EXPECT_LT(relative_l2(gridded(both), gridded(a) + 2 * gridded(b)), 1e-12);
}

TEST(Synthesize, gives_the_same_bits_for_any_number_of_threads) {
  const SonarHead head = head_of(33, 20);
  const Echoes echoes = random_echoes(500, 1, 3);
  for (const Synthesis synthesize : {synthesize_direct, synthesize_gridded, synthesize_spectrum}) {
    const ComplexGrid one = synthesize(echoes, head, medium(), {1e-6, 1});
    for (const int threads : {2, 3, 4, 5, 6, 7})
      EXPECT_TRUE((synthesize(echoes, head, medium(), {1e-6, threads}) == one).all());
  }
}

TEST(Synthesize, of_nothing_is_silence) {
  const SonarHead head = head_of(3, 8);
  const ComplexGrid p = synthesize_gridded({}, head, medium());
  EXPECT_EQ(p.rows(), 3);
  EXPECT_EQ(p.cols(), static_cast<Eigen::Index>(head.gate.bins()));
  EXPECT_EQ(p.abs().maxCoeff(), 0);
  EXPECT_EQ(synthesize_direct({}, head, medium()).abs().maxCoeff(), 0);
}

// The beam pattern along the fan is the array's: noiseless single echo, slice = B(u).
TEST(Synthesize, slice_across_beams_is_the_array_response) {
  const SonarHead head = head_of(101, 24);
  Echoes e;
  e.delay = {2 * head.gate.centre(100) / c0_cold}, e.u = {0.2}, e.amplitude = {1};
  const Medium lossless{c0_cold, {}};
  const ComplexGrid p = synthesize_gridded(e, head, lossless, {1e-12, 0});
  for (std::size_t b = 0; b < 101; ++b) {
    const double expected = array_response(head.array, c0_cold / 750e3, 0.2, std::sin(head.fan.azimuth[b])).real();
    EXPECT_LT(std::abs(p(static_cast<Eigen::Index>(b), 100) - expected), 1e-12);
  }
}

TEST(Synthesize, names_the_echo_that_is_not_finite) {
  const SonarHead head = head_of(3, 8);
  Echoes e = random_echoes(5, 1, 3);
  e.amplitude[3] = {std::nan(""), 0};
  for (const Synthesis synthesize : {synthesize_direct, synthesize_gridded, synthesize_spectrum})
    expect_error(ErrorKind::argument, {"echo 3"}, [&] { synthesize(e, head, medium(), {}); });
  EXPECT_THROW(synthesize_gridded({}, head, medium(), {0, 0}), Error);
  EXPECT_THROW(synthesize_gridded({}, head, Medium{-1, {}}, {}), Error);
}

}  // namespace insonify::synthesize_tests
