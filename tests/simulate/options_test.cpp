// SPDX-License-Identifier: BSD-3-Clause
// Options of a ping are refused by name, before any work.
#include "simulate/plan_ping.hpp"
#include "simulate/simulate_ping.hpp"
#include "support/heads.hpp"
#include "support/test.hpp"

namespace {

using O = SimulationOptions;

constexpr double infinity = HUGE_VAL;
const double not_a_number = std::nan("");

std::string error_of_tolerance(SynthesisMethod method, double tolerance, bool elements = false) {
  const O options{.synthesis = {method, tolerance}, .outputs = {.elements = elements}};
  return error_of([&] { require_valid(options, "ping"); });
}

}  // namespace

TEST(PingOptions, are_refused_by_name_before_the_scene_is_looked_at) {
  const std::pair<O, const char*> cases[] = {
      {{.sampling = {.scatterers_per_cell = -1}}, "sampling.scatterers_per_cell = -1, must be finite and >= 0"},
      {{.sampling = {.scatterers_per_cell = infinity}}, "sampling.scatterers_per_cell = inf, must be finite and >= 0"},
      {{.sampling = {.rays_per_beam = 0}}, "sampling.rays_per_beam = 0, must be at least 1"},
      {{.sampling = {.elevation_floor_db = 0}}, "sampling.elevation_floor_db = 0, must be < 0 dB"},
      {{.sampling = {.azimuth_margin = -0.1}}, "sampling.azimuth_margin = -0.1, must be finite and >= 0 rad"},
      {{.effects = {.absorption_order = 3}}, "effects.absorption_order = 3, must be 0, 1 or 2"},
      {{.effects = {.double_echoes = -1}}, "effects.double_echoes = -1, must be 0, or within 1e-6 and 10000"},
      {{.outputs = {.paths = -1}}, "outputs.paths = -1, must be at least 0"},
      {{.outputs = {.contributors = 300}}, "outputs.contributors = 300, must be within 0 and 255"},
      {{.outputs = {.contributors = -1}}, "outputs.contributors = -1, must be within 0 and 255"},
      {{.synthesis = {.method = SynthesisMethod::incoherent}, .outputs = {.elements = true}},
       "outputs.elements = true, must be false with method incoherent"},
      {{.detection = {.noise_floor_db = infinity}}, "detection.noise_floor_db = inf, must be finite, or -inf"},
      {{.detection = {.threshold_db = not_a_number}}, "detection.threshold_db = nan, must be a number"},
      {{.detection = {.false_alarm_rate = 0}}, "detection.false_alarm_rate = 0, must be above 0 and at most 1"},
      {{.detection = {.range_resolution = -1}}, "detection.range_resolution = -1, must be >= 0 m"},
      {{.detection = {.side_lobe_margin_db = not_a_number}}, "detection.side_lobe_margin_db = nan, must be a number"},
      {{.detection = {.above_db = not_a_number}}, "detection.above_db = nan, must be a number"},
      {{.accuracy_db = 0}, "accuracy_db = 0, must be above 0 and at most 20 dB"},
      {{.accuracy_db = -0.1}, "accuracy_db = -0.1, must be above 0"},
      {{.accuracy_db = not_a_number}, "accuracy_db = nan, must be above 0"},
      {{.accuracy_db = infinity}, "accuracy_db = inf, must be above 0"},
      {{.accuracy_db = 21}, "accuracy_db = 21, must be above 0 and at most 20 dB"},
      {{.effects = {.absorption_order = -2}}, "effects.absorption_order = -2, must be 0, 1 or 2"},
      {{.threads = -1}, "threads = -1, must be at least 0; 0: all cores"}};
  SceneCloud broken;  // no stage accepts it: a later check would complain about the scene
  broken.point.resize(1);
  for (const auto& [options, message] : cases) {
    const std::string text =
        error_of([&, &o = options] { simulate_ping(broken, small_head({}), Pose::Identity(), {}, o); });
    EXPECT_THAT(text, testing::StartsWith(std::string("PingSimulator: options.") + message));
  }
  EXPECT_THAT(error_of([] {
                simulate_ping(SceneCloud{}, small_head({}), Pose::Identity(), {},
                              {.effects = {.multipath = Choice::always}});
              }),
              HasSubstr("effects.multipath = always, but the environment has neither surface nor bottom"));
}

TEST(PingOptions, have_the_tolerance_that_their_method_can_keep) {
  using enum SynthesisMethod;
  for (const SynthesisMethod method : {gridded, direct, spectrum, element_exact, incoherent})
    for (const double tolerance : {0.0, 1.0, not_a_number})
      EXPECT_THAT(error_of_tolerance(method, tolerance), HasSubstr("must be above 0 and below 1"));
  EXPECT_THAT(error_of_tolerance(gridded, 1e-14),
              HasSubstr("synthesis.tolerance = 1e-14, must be within 1e-13 and 1 for method gridded"));
  for (const double tolerance : {1e-6, 0.2})
    EXPECT_THAT(error_of_tolerance(true_delays, tolerance),
                HasSubstr("must be within 1e-05 and 0.1 for method true-delays"));
  for (const SynthesisMethod method : {direct, spectrum, incoherent})
    EXPECT_EQ(error_of_tolerance(method, 1e-14), "no error");
  for (const double tolerance : {1e-13, 0.2}) {
    EXPECT_THAT(error_of_tolerance(element_exact, tolerance), HasSubstr("must be within 1e-12 and 0.1"));
    EXPECT_THAT(error_of_tolerance(gridded, tolerance, true), HasSubstr("the output of elements"));
    EXPECT_EQ(error_of_tolerance(gridded, tolerance), "no error");
  }
}

TEST(PingOptions, are_refused_by_the_plan_as_by_the_ping) {
  const auto plan = [](const O& options) { plan_ping({}, small_head({}), {}, {}, options); };
  EXPECT_EQ(error_of([&] { plan({.outputs = {.contributors = 300}}); }),
            "plan_ping: options.outputs.contributors = 300, must be within 0 and 255");
}

// Water is stated once: the head is made for the sound speed of the simulator's own environment.
TEST(PingSimulators, make_the_head_of_a_sonar_in_their_own_water) {
  const SonarSpec sonar = small_sonar({});
  const Environment cold{Water{.temperature_c = 4}};
  const SonarHead head = PingSimulator(sonar, cold).head(), expected = make_head(sonar, slowest_sound(cold));
  EXPECT_EQ(head.gate.bin_size, expected.gate.bin_size);
  EXPECT_LT(head.gate.bin_size, PingSimulator(sonar, Environment{}).head().gate.bin_size);
}

TEST(PingEvents, are_refused_if_they_are_not_finite) {
  const PingSimulator simulator(small_head({}), {});
  const SceneCloud nothing;
  const auto error = [&](const PingEvent& event) {
    return error_of([&] { simulator.ping(PreparedScene(nothing), event); });
  };
  EXPECT_THAT(error({.motion = {{infinity, 0, 0}}}), HasSubstr("motion.velocity = "));
  EXPECT_THAT(error({.time = infinity}), HasSubstr("event.time = inf, must be finite"));
}

TEST(PingOptions, replace_those_of_a_simulator) {
  SceneCloud bed;
  for (int i = 0; i < 40; ++i) add_surfel(bed, {3 + 0.05 * i, 0, -1}, {0, 0, 1}, 0.0025);
  const PreparedScene scene(bed);
  const PingSimulator first(small_head({}), {}, {.seed = 1}), other = first.with({.seed = 2});
  const auto pressure = [&](const PingSimulator& simulator) {
    return simulator.ping(scene, PingEvent{}).ping.pressure;
  };
  const ComplexGridF by_first = pressure(first);
  EXPECT_TRUE((pressure(other) == pressure(PingSimulator(small_head({}), {}, {.seed = 2}))).all());
  EXPECT_FALSE((pressure(other) == by_first).all());
  EXPECT_TRUE((pressure(first) == by_first).all());
  EXPECT_THAT(error_of([&] { first.with({.accuracy_db = -1}); }), HasSubstr("accuracy_db"));
}
