// Echoes at and beyond the edges of the range gate, and pulses that do not fit into it.
#include "extreme_cases.hpp"

using namespace insonify::extreme;

namespace {

using Synthesis = ComplexGrid (*)(const Echoes&, const SonarHead&, const Medium&, const SynthesisOptions&);
const std::vector<Synthesis> methods = {synthesize_direct, synthesize_gridded, synthesize_spectrum};

}  // namespace

// A plain frequency sum shows a target at 14.017 m in a window of 13.017 m at 1 m, at full level.
TEST(ExtremeGates, n09_echo_from_beyond_the_gate_does_not_wrap_round) {
  const SonarHead head = single_beam(pulse_900k, 0.5, 13.517);
  for (const double r : {14.017, 14.517, 27.034, 300.0}) {
    const Echoes echoes = echoes_of(targets_at({r}), pulse_900k, clear_water());
    const double unwrapped = std::abs(echoes.amplitude[0]);
    for (const Synthesis& synthesize : methods)
      EXPECT_LT(synthesize(echoes, head, clear_water(), {}).abs().maxCoeff(), 1e-12 * unwrapped) << r << " m";
  }
}

TEST(ExtremeGates, n10_n11_the_gate_cuts_an_echo_at_its_edges_but_does_not_change_it) {
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

TEST(ExtremeGates, n10_n11_points_exactly_at_the_edges_of_the_gate_are_received_and_detected) {
  for (const double r : {1.0, 12.0}) {
    SceneCloud scene;
    add_surfel(scene, {r, 0, 0}, {-1, 0, 0}, 0.01);
    SonarSpec s = small_sonar();
    s.beams = 1;
    s.bin_size = 0.011;  // 1000 bins fill the gate exactly
    const SimulatedPing p =
        ping_of(scene, {.amplitude = SurfaceAmplitude::coherent, .sampling = {.scatterers_per_cell = 0}}, s);
    EXPECT_TRUE(all_finite(p));
    ASSERT_EQ(p.report.sampling.scatterers, 1U) << r << " m";
    ASSERT_EQ(p.soundings.size(), 1U) << r << " m";
    EXPECT_NEAR(p.soundings.range[0], r, 0.011);
    // Just outside: the end of its pulse_900k is still received; farther away nothing is.
    scene.point[0].x() = static_cast<float>(r < 2 ? r - 0.02 : r + 0.02);
    const double tail = image(ping_of(scene, {.amplitude = SurfaceAmplitude::coherent}, s)).abs().maxCoeff();
    EXPECT_GT(tail, 0) << r << " m";
    EXPECT_LT(tail, 0.5 * image(p).abs().maxCoeff()) << r << " m";
    scene.point[0].x() = static_cast<float>(r < 2 ? r - 0.15 : r + 0.15);
    EXPECT_EQ(ping_of(scene, {}, s).report.sampling.scatterers, 0U) << r << " m";
  }
}

TEST(ExtremeGates, n18_without_absorption_pressure_falls_as_one_over_range_squared) {
  const SonarHead head = single_beam(pulse_900k, 1, 20);
  double first = 0;
  for (const double r : {1.0, 2.0, 5.0, 10.0, 20.0}) {
    const double here =
        synthesize_direct(echoes_of(targets_at({r}), pulse_900k, clear_water()), head, clear_water()).abs().maxCoeff();
    if (first == 0) first = here;
    EXPECT_NEAR(here * r * r / first, 1, 1e-10) << r;
  }
}

TEST(ExtremeGates, n20_pulse_longer_than_the_gate_is_refused) {
  SonarSpec s = small_sonar();
  s.bandwidth = 50;  // c / 2B = 15 m in a gate of 11 m
  expect_error(ErrorKind::argument, {"make_head", "bandwidth_hz = 50 Hz", "15 m", "11 m"}, [&] { make_head(s, 1500); });
  s.bandwidth = 100;  // 7.5 m fits
  EXPECT_EQ(make_head(s, 1500).gate.bins(), 4U);
  for (const double b : {0.0, -1.0, not_a_number}) {
    s.bandwidth = b;
    expect_error(ErrorKind::argument, {"bandwidth_hz", "Hz, must be > 0"}, [&] { make_head(s, 1500); });
  }
}

TEST(ExtremeGates, n20_pulse_longer_than_the_window_of_a_head_made_by_hand_is_flat_across_it) {
  const Pulse tone{900e3, 1, 220};
  const SonarHead head = single_beam(tone, 4, 6);
  const ComplexGrid p = synthesize_gridded(echoes_of(targets_at({5}), tone, clear_water()), head, clear_water());
  EXPECT_TRUE(p.isFinite().all());
  EXPECT_NEAR(p.abs().minCoeff() / p.abs().maxCoeff(), 1, 1e-4);
}

TEST(ExtremeGates, n21_bandwidth_of_twice_the_centre_frequency_is_refused) {
  SonarSpec s = small_sonar();
  s.bandwidth = 900e3;
  expect_error(ErrorKind::argument, {"bandwidth_hz = 900000 Hz", "below twice centre_frequency_hz"},
               [&] { make_head(s, 1500); });
  SonarHead head = small_head();
  head.pulse.bandwidth = 900e3;
  expect_error(ErrorKind::argument, {"PingSimulator", "bandwidth = 900000 Hz", "below twice the centre frequency"},
               [&] { simulate_ping(plate(5, 1, 3), head, Pose::Identity(), {}); });
}

TEST(ExtremeGates, n21_head_that_is_not_valid_is_named_by_the_call_that_got_it) {
  const auto refused = [](auto&& damage, const std::vector<std::string>& parts) {
    SonarHead head = small_head();
    damage(head);
    expect_error(ErrorKind::argument, parts, [&] { simulate_ping(plate(5, 1, 3), head, Pose::Identity(), {}); });
  };
  refused([](SonarHead& h) { h.pulse.bandwidth = 0; }, {"PingSimulator", "bandwidth = 0 Hz"});
  refused([](SonarHead& h) { h.pulse.centre_frequency = -1; }, {"PingSimulator", "centre_frequency = -1 Hz"});
  refused([](SonarHead& h) { h.array.shading.clear(); }, {"PingSimulator", "no elements"});
  refused([](SonarHead& h) { h.gate.min_range = 0; }, {"PingSimulator", "min_range = 0 m"});
  refused([](SonarHead& h) { h.gate.bin_size = not_a_number; }, {"PingSimulator", "bin_size = nan m"});
}

TEST(ExtremeGates, n23_bin_that_would_under_sample_the_pulse_is_refused) {
  SonarSpec s = small_sonar();
  const double coarsest = 0.44 * 1500 / (2 * s.bandwidth);
  s.bin_size = 1.01 * coarsest;
  expect_error(ErrorKind::argument, {"bin_size_m", "under-sample", "0.44 c / 2B = 0.0165 m"},
               [&] { make_head(s, 1500); });
  s.bin_size = coarsest;
  EXPECT_EQ(make_head(s, 1500).gate.bin_size, coarsest);
}
