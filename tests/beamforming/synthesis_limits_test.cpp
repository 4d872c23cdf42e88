// SPDX-License-Identifier: BSD-3-Clause
// Synthesis at its limits: the edges of the gate, the smallest and largest numbers, odd and large sizes.
#include "beamforming/synthesize.hpp"
#include "core/random.hpp"
#include "support/point_targets.hpp"

namespace insonify::synthesis_limits {

using Synthesis = ComplexGrid (*)(const Echoes&, const SonarHead&, const Medium&, const SynthesisOptions&);
const std::vector<Synthesis> methods = {synthesize_direct, synthesize_gridded, synthesize_spectrum};

/// Returns echoes spread over ranges 1.5 to 11.5 m and directions of the fan, with random amplitudes.
Echoes spread_echoes(std::size_t count, double reach = 0.5) {
  Echoes e;
  for (std::size_t i = 0; i < count; ++i) {
    const auto u = random_uniform(7, RandomStage::scene_points, {i, 0, 0});
    e.delay.push_back(2 * (1.5 + 10 * u[0]) / 1500);
    e.u.push_back(reach * (2 * u[1] - 1));
    e.amplitude.push_back(random_complex_normal(7, RandomStage::surface_amplitude, {i, 0, 0}));
  }
  return e;
}

// A plain frequency sum shows a target at 14.017 m in a window of 13.017 m at 1 m, at full level.
TEST(SynthesisLimits, echo_from_beyond_the_gate_does_not_wrap_round) {
  const SonarHead head = single_beam(pulse_900k, 0.5, 13.517);
  for (const double r : {14.017, 14.517, 27.034, 300.0}) {
    const Echoes echoes = echoes_of(targets_at({r}), pulse_900k, clear_water());
    const double unwrapped = std::abs(echoes.amplitude[0]);
    for (const Synthesis& synthesize : methods)
      EXPECT_LT(synthesize(echoes, head, clear_water(), {}).abs().maxCoeff(), 1e-12 * unwrapped) << r << " m";
  }
}

TEST(SynthesisLimits, gate_cuts_an_echo_at_its_edges_but_does_not_change_it) {
  const Echoes echoes = echoes_of(targets_at({2.0, 8.0}), pulse_900k, clear_water());
  const SonarHead wide = single_beam(pulse_900k, 1, 9), narrow = single_beam(pulse_900k, 2, 8);
  const auto skipped = static_cast<Eigen::Index>(std::llround((2.0 - 1.0) / 0.002));
  for (const Synthesis& synthesize : methods) {
    const ComplexGrid all = synthesize(echoes, wide, clear_water(), {1e-12}),
                      cut = synthesize(echoes, narrow, clear_water(), {1e-12});
    EXPECT_LT(relative_l2(cut, all.middleCols(skipped, cut.cols())), 1e-9);
    EXPECT_NEAR(std::abs(cut(0, 0)), std::abs(echoes.amplitude[0]), 1e-9 * std::abs(cut(0, 0)));
    EXPECT_NEAR(std::abs(cut(0, cut.cols() - 1)), std::abs(echoes.amplitude[1]), 1e-4 * std::abs(cut(0, 0)));
  }
}

// 2 alpha r of 80, 200 and 900 Np: beyond single, then beyond double precision.
TEST(SynthesisLimits, absorption_beyond_double_precision_is_silence) {
  const SonarHead head = single_beam(pulse_900k, 9, 11);
  for (const double alpha : {4.0, 10.0, 45.0, 1e300}) {
    const Medium medium{1500, {alpha, 0, 0}};
    const Echoes echoes = echoes_of(targets_at({10}), pulse_900k, medium);
    for (const ComplexGrid& p :
         {synthesize_direct(echoes, head, medium), synthesize_gridded(echoes, head, medium, {1e-12})}) {
      EXPECT_TRUE(p.isFinite().all()) << alpha;
      const double expected = std::abs(echoes.amplitude[0]) * std::exp(-2 * alpha * 10);
      EXPECT_NEAR(p.abs().maxCoeff(), expected, 1e-9 * expected) << alpha;
    }
  }
}

TEST(SynthesisLimits, without_absorption_pressure_falls_as_one_over_range_squared) {
  const SonarHead head = single_beam(pulse_900k, 1, 20);
  double first = 0;
  for (const double r : {1.0, 2.0, 5.0, 10.0, 20.0}) {
    const double here =
        synthesize_direct(echoes_of(targets_at({r}), pulse_900k, clear_water()), head, clear_water()).abs().maxCoeff();
    if (first == 0) first = here;
    EXPECT_NEAR(here * r * r / first, 1, 1e-10) << r;
  }
}

TEST(SynthesisLimits, absorption_that_would_amplify_is_refused) {
  const SonarHead head = single_beam(pulse_900k, 9, 11);
  const Echoes echoes = echoes_of(targets_at({10}), pulse_900k, clear_water());
  for (const auto synthesize : {synthesize_direct, synthesize_gridded, synthesize_spectrum})
    expect_error(ErrorKind::argument, {"absorption = -1 dB/m", "must be >= 0"}, [&] {
      synthesize(echoes, head, {1500, {-nepers_per_db, 0, 0}}, {});
    });
  // A slope that makes part of the band grow faster than the rest is lost.
  expect_error(ErrorKind::argument, {"absorption", "growing"}, [] {
    echo_envelope({1e6, 0.9e6, 220}, {10, 2e-5, 0}, 100);
  });
  expect_error(ErrorKind::argument, {"absorption", "growing"}, [] {
    echo_envelope({1e6, 0.9e6, 220}, {0, 0, -1e-13}, 100);
  });
}

TEST(SynthesisLimits, pulse_longer_than_the_gate_is_flat_across_it) {
  const Pulse tone{900e3, 2, 220};  // 165 m
  const SonarHead head = single_beam(tone, 4, 6);
  const ComplexGrid p = synthesize_gridded(echoes_of(targets_at({5}), tone, clear_water()), head, clear_water());
  EXPECT_TRUE(p.isFinite().all());
  EXPECT_NEAR(p.abs().minCoeff() / p.abs().maxCoeff(), 1, 1e-4);
}

// A Gaussian spectrum cut off at +-Bs/2 loses erfc(sqrt(2 ln2) Bs / 2B) of its peak: -24.6 dB for the band that the
// default bins can hold (Bs = 2.27 B), -38 dB at 3 B. The spectrum form takes 10 B whatever the bins: e^-34.
TEST(SynthesisLimits, spectrum_is_so_wide_that_its_truncation_is_negligible) {
  const Pulse pulse{900e3, 29.5e3, 220};
  const auto lost_db = [](double band) {
    return db_from_amplitude(std::erfc(std::sqrt(2 * std::log(2)) * 0.5 * band));
  };
  EXPECT_NEAR(lost_db(1 / 0.44), -24.6, 0.1);
  EXPECT_NEAR(lost_db(3), -38.1, 0.1);
  EXPECT_LT(lost_db(10), -300);
  SonarHead head = single_beam(pulse, 4, 6);
  for (const double bin : {0.002, default_bin_size(pulse, 1500), 0.05}) {
    head.gate.bin_size = bin;
    const Echoes echoes = echoes_of(targets_at({4.503, 5.0, 5.49}), pulse, clear_water());
    const double peak = std::abs(echoes.amplitude[0]);
    const ComplexGrid spectrum = synthesize_spectrum(echoes, head, clear_water()),
                      exact = synthesize_direct(echoes, head, clear_water());
    EXPECT_LT((spectrum - exact).abs().maxCoeff(), 1e-12 * peak) << "bins of " << bin << " m";
  }
}

// No range side lobes between two targets: the spectrum form is as silent there as the pulse itself.
TEST(SynthesisLimits, nothing_rings_between_two_echoes) {
  const Pulse pulse{900e3, 29.5e3, 220};
  const SonarHead head = single_beam(pulse, 4, 6);
  const Echoes echoes = echoes_of(targets_at({4.5, 5.5}), pulse, clear_water());
  const ComplexGrid p = synthesize_spectrum(echoes, head, clear_water());
  const auto at = [&](double range) { return static_cast<Eigen::Index>(std::lround((range - 4) / 0.002)); };
  EXPECT_LT(p.row(0).segment(at(4.6), at(5.4) - at(4.6)).abs().maxCoeff(), 1e-13 * std::abs(echoes.amplitude[0]));
}

TEST(SynthesisLimits, echoes_below_the_smallest_numbers_change_nothing) {
  const SonarHead head = nine_beam_head();
  Echoes echoes = echoes_of(targets_at({5}, 0.1), head.pulse, clear_water());
  const SynthesisOptions fine{.tolerance = 1e-12};
  const ComplexGrid alone = synthesize_gridded(echoes, head, clear_water(), fine);
  const ComplexGrid exact = synthesize_direct(echoes, head, clear_water());
  for (int i = 0; i < 300; ++i) {  // amplitudes from 1e-290 Pa down to 0 through the denormals
    echoes.delay.push_back(2 * (2 + 0.03 * i) / 1500);
    echoes.u.push_back(0.001 * i);
    echoes.v.push_back(0);
    echoes.amplitude.push_back(std::pow(10.0, -290 - 0.12 * i));
  }
  const ComplexGrid together = synthesize_gridded(echoes, head, clear_water(), fine);
  EXPECT_TRUE(together.isFinite().all());
  EXPECT_LT(relative_l2(together, alone), 1e-12);
  EXPECT_LT(relative_l2(synthesize_direct(echoes, head, clear_water()), exact), 1e-30);
}

// Two targets 300 dB apart; the weak one keeps its own accuracy.
TEST(SynthesisLimits, weak_echo_keeps_its_accuracy_beside_one_300_db_louder) {
  const SonarHead head = nine_beam_head();
  const Scatterers targets = targets_at({3, 9}, 0.1);
  const std::vector<double> sigma{1e30, 81};  // over r^2: 1e15 / 9 and 1 / 9
  const std::vector<std::complex<double>> xi{1, 1};
  const Echoes echoes = target_echoes(targets, sigma, xi, head.pulse, clear_water());
  const ComplexGrid fast = synthesize_gridded(echoes, head, clear_water(), {.tolerance = 1e-6});
  const ComplexGrid slow = synthesize_direct(echoes, head, clear_water());
  const Eigen::Index far = slow.cols() / 2;  // from 6.5 m on
  EXPECT_LT(relative_l2(fast.rightCols(far), slow.rightCols(far)), 1e-6);
  EXPECT_GT(slow.leftCols(far).abs().maxCoeff() / slow.rightCols(far).abs().maxCoeff(), 0.9e15);
}

TEST(SynthesisLimits, thousands_of_beams_are_what_each_is_alone) {
  SonarHead head = nine_beam_head();
  head.array = {head.array.spacing, uniform_shading(256)};
  head.gate = {4, 5, 0.0157};
  head.fan = make_fan(4096, radians(90), radians(0.5), radians(20));
  const Echoes echoes = spread_echoes(300);
  const ComplexGrid all = synthesize_gridded(echoes, head, clear_water());
  EXPECT_TRUE(all.isFinite().all());
  for (const Eigen::Index b : {0, 1000, 4095}) {
    SonarHead lone = head;
    lone.fan.azimuth = {head.fan.azimuth[static_cast<std::size_t>(b)]};
    lone.fan.elevation = {0};
    EXPECT_LT(relative_l2(all.row(b), synthesize_direct(echoes, lone, clear_water())), 1e-4) << b;
  }
}

TEST(SynthesisLimits, prime_numbers_of_bins_beams_and_elements_keep_the_tolerance) {
  const Echoes echoes = spread_echoes(200);
  for (const auto& [beams, bins, elements] : {std::array{1, 1, 1}, std::array{7, 61, 13}, std::array{13, 67, 31},
                                              std::array{31, 127, 61}, std::array{101, 997, 53}}) {
    SonarHead head = nine_beam_head();
    head.fan = make_fan(static_cast<std::size_t>(beams), radians(50), radians(3), radians(20));
    head.array = {head.array.spacing, uniform_shading(static_cast<std::size_t>(elements))};
    head.gate = {4, 4 + 0.0075 * bins, 0.0075};
    ASSERT_EQ(head.gate.bins(), static_cast<std::size_t>(bins));
    const ComplexGrid slow = synthesize_direct(echoes, head, clear_water());
    EXPECT_LT(relative_l2(synthesize_gridded(echoes, head, clear_water(), {.tolerance = 1e-6}), slow), 1e-6) << bins;
    EXPECT_LT(relative_l2(synthesize_spectrum(echoes, head, clear_water()), slow), 1e-9) << bins;
  }
}

TEST(SynthesisLimits, beams_even_in_angle_and_in_direction_cosine_agree_where_they_coincide) {
  SonarHead angle = nine_beam_head(), cosine = nine_beam_head();
  angle.fan.azimuth = {-pi / 6, -pi / 12, 0, pi / 12, pi / 6};  // u = -0.5 and 0.5 are in both
  cosine.fan.azimuth = {-pi / 6, std::asin(-0.25), 0, std::asin(0.25), pi / 6};
  angle.fan.elevation.assign(5, 0);
  cosine.fan.elevation.assign(5, 0);
  const Echoes echoes = spread_echoes(200);
  const ComplexGrid a = synthesize_gridded(echoes, angle, clear_water()),
                    b = synthesize_gridded(echoes, cosine, clear_water());
  for (const Eigen::Index beam : {0, 2, 4}) EXPECT_TRUE(same(a.row(beam), b.row(beam))) << beam;
  for (const Eigen::Index beam : {1, 3}) EXPECT_FALSE(same(a.row(beam), b.row(beam))) << beam;
}

TEST(SynthesisLimits, sound_speed_of_zero_or_no_number_is_refused) {
  for (const double c : {0.0, -1500.0, not_a_number, infinity}) {
    expect_error(ErrorKind::argument, {"make_head: sound_speed = ", "m/s", "> 0"}, [&] { make_head(nine_beams(), c); });
    const SonarHead head = nine_beam_head();
    const Echoes echoes = echoes_of(targets_at({5}), head.pulse, clear_water());
    expect_error(ErrorKind::argument, {"sound_speed = ", "m/s", "> 0"}, [&] {
      synthesize_gridded(echoes, head, {c, {}});
    });
    expect_error(ErrorKind::argument, {"sound_speed = ", "m/s", "> 0"}, [&] {
      echoes_of(targets_at({5}), head.pulse, {c, {}});
    });
  }
}

}  // namespace insonify::synthesis_limits
