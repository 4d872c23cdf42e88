// SPDX-License-Identifier: BSD-3-Clause
// Tests the plan's promise: the stages that a ping leaves out cost less than the plan states.
#include "simulate/plan_ping.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "core/random.hpp"
#include "core/units.hpp"
#include "scene/built_in_scenes.hpp"
#include "sonar/sonar_spec.hpp"
#include "support/errors.hpp"
#include "support/heads.hpp"
#include "support/simulate_event.hpp"

using namespace insonify;

namespace {

struct Situation {
  SceneCloud scene;
  SonarHead head;
  PingEvent event;
  Environment environment;
  SimulationOptions options;
};

/// Sets all stages out that the budget decides.
void close(SimulationOptions& o) {
  o.sampling.outer_elevations = o.sampling.outer_azimuths = Choice::never;
  o.effects.refraction = o.effects.moving = o.effects.multipath = Choice::never;
  o.effects.absorption_order = 0;
  o.synthesis.true_delays = Choice::never;
}

/// Returns a random head above a random bottom with a wall, in random water; nothing special.
Situation situation(std::uint64_t number) {
  const auto a = random_uniform(number, RandomStage::scene_points, {1, 0, 0});
  const auto b = random_uniform(number, RandomStage::scene_points, {2, 0, 0});
  Situation s;
  s.scene = make_built_in_scene("plane", {.points = 6000, .size = {14, 14}});
  SonarSpec spec;
  spec.name = "random";
  spec.centre_frequency = 300e3 + 600e3 * a[0];
  spec.bandwidth = 10e3 + 30e3 * a[1];
  spec.source_level_db = 200;
  spec.beams = 24;
  spec.field_of_view = radians(30 + 60 * a[2]);
  spec.beam_width = radians(1.5 + 3 * a[3]);
  spec.elevation_width = radians(5 + 8 * b[0]);
  spec.min_range = 3 + 2 * b[1];
  spec.max_range = spec.min_range + 4;
  s.environment.water.temperature_c = 4 + 16 * b[2];
  s.environment.water.depth = 5;
  s.head = make_head(spec, sound_speed(s.environment.water));
  s.event.world_from_head = pose_from_yaw_pitch_roll({0, 0, 1.5 + b[3]}, 0, radians(10 + 15 * b[0]), 0);
  s.options.seed = number;
  s.options.sampling.scatterers_per_cell = 3;
  close(s.options);
  return s;
}

/// Gives the water a surface, from which the depth of the head follows.
void put_under(const SeaSurface& surface, Situation& s) {
  s.environment.surface = surface;
  s.environment.water.depth = 0;
}

ComplexGrid image(const Situation& s) {
  return simulate_event(s.scene, s.head, s.event, s.environment, s.options).ping.pressure.cast<std::complex<double>>();
}

const PlannedStage& stage(const PingPlan& plan, const std::string& name) {
  for (const PlannedStage& s : plan.stages)
    if (s.name == name) return s;
  throw std::runtime_error("no stage " + name);
}

/// Returns the relative L2 change of the image `without` of a situation when `name` is forced in.
double effect_of(const Situation& s, const std::string& name, const ComplexGrid& without) {
  Situation forced = s;
  force_stage(name, true, forced.event, forced.environment, forced.options);
  const ComplexGrid with = image(forced);
  return std::sqrt((with - without).abs2().sum() / without.abs2().sum());
}

double effect_of(const Situation& s, const std::string& name) { return effect_of(s, name, image(s)); }

PingPlan plan_of(const Situation& s) { return plan_ping(s.scene, s.head, s.event, s.environment, s.options); }

}  // namespace

TEST(PlanPing, effect_of_every_stage_left_out_stays_below_its_bound) {
  double outer_elevations = 0;
  for (std::uint64_t number = 1; number <= 6; ++number) {
    Situation s = situation(number);
    put_under(SeaSurface{.height = 5, .rms_height = 0.0002}, s);
    s.environment.profile = SoundSpeedProfile{{0, 20}, {1490, 1490.5}};
    const PingPlan plan = plan_of(s);
    const ComplexGrid without = image(s);
    outer_elevations += stage(plan, "outer-elevations").bound_relative;
    for (const std::string name : {"outer-elevations", "outer-azimuths", "absorption-slope", "refraction", "multipath",
                                   "noise", "direct-sum", "true-delays"}) {
      const PlannedStage& out = stage(plan, name);
      EXPECT_FALSE(out.included) << name;
      if (name != "outer-elevations" && name != "multipath") {  // not every pattern reaches bottom or surface
        EXPECT_GT(out.bound_relative, 0) << name;
      }
      EXPECT_LE(effect_of(s, name, without), out.bound_relative + 1e-6) << name << " in situation " << number;
    }
  }
  EXPECT_GT(outer_elevations, 0);
}

TEST(PlanPing, bounds_are_not_idle) {
  const Situation s = situation(3);
  const PingPlan plan = plan_of(s);
  EXPECT_LT(stage(plan, "outer-elevations").bound_relative, 0.2);
  EXPECT_LT(stage(plan, "outer-azimuths").bound_relative, 0.5);
  EXPECT_LT(stage(plan, "noise").bound_relative, 0.1);
  EXPECT_LT(stage(plan, "other-ranges").bound_relative, 1e-3);
}

// Pulses from beyond the gate reach into it; farther than the sampled ranges they do not.
TEST(PlanPing, ranges_beyond_the_sampled_ones_change_nothing_above_their_bound) {
  for (std::uint64_t number = 1; number <= 6; ++number) {
    Situation s = situation(number);
    s.options.synthesis.method = SynthesisMethod::direct;  // whole pulses: only what is sampled differs
    s.options.synthesis.tolerance = 0.03;
    const ComplexGrid narrow = image(s);
    const double bound = stage(plan_of(s), "other-ranges").bound_relative;
    Situation wide = s;
    wide.head.gate.max_range += 1;
    const ComplexGrid both = image(wide).leftCols(narrow.cols());
    const double effect = std::sqrt((both - narrow).abs2().sum() / narrow.abs2().sum());
    EXPECT_LE(effect, bound) << number;
    EXPECT_GT(effect, 0) << number;
    RecordProperty("part_of_the_bound_" + std::to_string(number), std::to_string(effect / bound));
  }
}

// A narrow band close by: what focusing leaves of the waves' curvature is most of what true delays change.
TEST(PlanPing, bound_of_the_far_field_holds_close_by) {
  for (std::uint64_t number = 1; number <= 4; ++number) {
    Situation s = situation(number);
    SonarSpec spec;
    spec.name = "close";
    spec.centre_frequency = 600e3;
    spec.bandwidth = 1.5e3;
    spec.source_level_db = 200;
    spec.beams = 24;
    spec.field_of_view = radians(90);
    spec.beam_width = radians(1.2);
    spec.elevation_width = radians(20);
    spec.min_range = 0.5;
    spec.max_range = 2.5;
    s.head = make_head(spec, sound_speed(s.environment.water));
    s.event.world_from_head = pose_from_yaw_pitch_roll({0, 0, 0.4}, 0, radians(20), 0);
    const double effect = effect_of(s, "true-delays"), bound = stage(plan_of(s), "true-delays").bound_relative;
    EXPECT_LE(effect, bound) << number;
    RecordProperty("part_of_the_bound_" + std::to_string(number), std::to_string(effect / bound));
  }
}

// Without a cause there is nothing to leave out, and forcing says what is missing.
TEST(PlanPing, what_has_no_cause_costs_nothing_and_cannot_be_forced_in) {
  const Situation s = situation(1);
  const PingPlan plan = plan_of(s);
  for (const std::string name : {"back-faces", "refraction", "motion", "multipath", "volume", "surface", "bottom",
                                 "micro-relief", "coherent-part"}) {
    EXPECT_FALSE(stage(plan, name).included) << name;
    EXPECT_EQ(stage(plan, name).bound_relative, 0) << name;
  }
  for (const std::string name : {"refraction", "motion", "multipath", "volume", "surface", "bottom"})
    EXPECT_THROW(effect_of(s, name), Error) << name;
  EXPECT_THROW(effect_of(s, "back-faces"), Error);
}

TEST(PlanPing, what_the_environment_calls_for_is_in) {
  Situation s = situation(1);
  put_under(SeaSurface{.height = 5, .scattering_strength_db = -30.0}, s);
  s.environment.bottom = FlatBottom{.height = -1, .lambert_mu = 0.002};
  s.environment.volume_scattering_db = -70;
  s.options.effects.multipath = Choice::always;
  s.options.effects.noise = true;
  s.options.effects.absorption_order = 1;
  s.options.effects.moving = Choice::as_needed;
  s.event.motion.velocity = {1, 0, 0};
  s.scene.materials[0].relief_slope = 0.1;
  s.scene.materials[0].coherent_fraction = 0.5;
  const PingPlan plan = plan_of(s);
  for (const std::string name : {"volume", "surface", "bottom", "multipath", "noise", "absorption-slope", "motion",
                                 "micro-relief", "coherent-part", "occlusion"})
    EXPECT_TRUE(stage(plan, name).included) << name;
  for (const std::string name : {"volume", "surface", "bottom", "multipath", "noise", "motion", "occlusion"})
    force_stage(name, false, s.event, s.environment, s.options);
  const PingPlan less = plan_of(s);
  for (const std::string name : {"volume", "surface", "bottom", "multipath", "noise", "motion", "occlusion"})
    EXPECT_FALSE(stage(less, name).included) << name;
}

// Out of a ping of another method, a way of summing is out already; into one of intensities it does not go.
TEST(PlanPing, forcing_a_method_out_leaves_another_method_alone) {
  using enum SynthesisMethod;
  const auto is_true = [](SynthesisMethod m) { return m == element_exact || m == true_delays; };
  for (const SynthesisMethod chosen : {gridded, direct, spectrum, element_exact, true_delays, incoherent})
    for (const std::string name : {"direct-sum", "true-delays"}) {
      Situation s = situation(1);
      s.options.synthesis.method = chosen;
      force_stage(name, false, s.event, s.environment, s.options);
      const bool was_it = name == "direct-sum" ? chosen == direct : is_true(chosen);
      EXPECT_EQ(s.options.synthesis.method, was_it ? gridded : chosen) << name;
      if (chosen == incoherent) {
        EXPECT_THROW(effect_of(s, name), Error) << name;
        continue;
      }
      force_stage(name, true, s.event, s.environment, s.options);
      EXPECT_EQ(s.options.synthesis.method, name == "direct-sum" ? direct : true_delays) << name;
    }
}

// Finer than the fast method keeps, true delays are those of the referee; a tolerance that it refuses is lowered.
TEST(PlanPing, true_delays_keep_the_tolerance) {
  Situation s = situation(1);
  s.options.synthesis.tolerance = 1e-7;
  force_stage("true-delays", true, s.event, s.environment, s.options);
  EXPECT_EQ(s.options.synthesis.method, SynthesisMethod::element_exact);
  s.options.synthesis = {.tolerance = 0.5};
  force_stage("true-delays", true, s.event, s.environment, s.options);
  EXPECT_EQ(s.options.synthesis.tolerance, 0.1);
}

// Each of seven stages has a seventh of the budget's square, and is in if its bound is larger.
TEST(PlanPing, budget_decides_what_is_left_open) {
  Situation s = situation(2);
  put_under(SeaSurface{.height = 5, .rms_height = 0.0002}, s);
  s.environment.profile = SoundSpeedProfile{{0, 20}, {1490, 1490.5}};
  s.options.effects = {};
  s.options.sampling = {.scatterers_per_cell = 3};
  s.options.synthesis = {};
  std::size_t in_before = 99;
  for (const double accuracy_db : {1e-6, 0.1, 1.0, 20.0}) {
    s.options.accuracy_db = accuracy_db;
    const PingPlan plan = plan_of(s);
    EXPECT_NEAR(plan.share_relative, (amplitude_from_db(accuracy_db) - 1) / std::sqrt(7), 1e-12);
    EXPECT_LE(plan.left_out_db, accuracy_db);
    std::size_t in = 0;
    for (const PlannedStage& stage : plan.stages)
      if (stage.by == DecidedBy::budget) {
        EXPECT_EQ(stage.included, stage.bound_relative > plan.share_relative) << stage.name;
        in += stage.included;
      }
    EXPECT_LE(in, in_before) << accuracy_db;
    in_before = in;
    const bool exact = stage(plan, "true-delays").included;
    EXPECT_EQ(plan.options.synthesis.method, exact ? SynthesisMethod::true_delays : SynthesisMethod::gridded);
  }
  EXPECT_LE(in_before, 1U);  // only straight rays cost more than 20 dB, if any
}

// A ping of open options is the ping of its plan, to the byte.
TEST(PlanPing, leaves_true_delays_of_a_planar_array_to_its_user) {
  Situation s = situation(1);
  SonarSpec spec =
      small_sonar({.beams = 8, .field_of_view_deg = 40, .beam_width_deg = 4, .min_range = 3, .max_range = 6});
  spec.elevations = {radians(-4), 0, radians(4)};
  spec.column_beam_width = radians(4);
  s.head = make_head(spec, sound_speed(s.environment.water));
  s.options.synthesis.true_delays = Choice::as_needed;
  const PingPlan plan = plan_ping(s.scene, s.head, s.event, s.environment, s.options);
  const PlannedStage out = stage(plan, "true-delays");
  EXPECT_FALSE(out.included);
  EXPECT_THAT(out.why, HasSubstr("--with true-delays"));
  EXPECT_GT(out.bound_relative, plan.share_relative);
  EXPECT_GE(plan.left_out_db, out.bound_db);
  force_stage("true-delays", true, s.event, s.environment, s.options);
  EXPECT_TRUE(stage(plan_ping(s.scene, s.head, s.event, s.environment, s.options), "true-delays").included);
}

TEST(PlanPing, is_what_a_ping_does) {
  Situation s = situation(5);
  put_under(SeaSurface{.height = 5, .rms_height = 0.0002}, s);
  s.options.effects = {};
  s.options.sampling = {.scatterers_per_cell = 1};
  s.options.synthesis = {};
  for (const double accuracy_db : {0.1, 3.0}) {
    s.options.accuracy_db = accuracy_db;
    Situation planned = s;
    planned.options = plan_of(s).options;
    EXPECT_EQ(planned.options.synthesis.method == SynthesisMethod::true_delays, accuracy_db < 1);
    EXPECT_TRUE((image(s) == image(planned)).all());
  }
}

// The direct sum has no tolerance to keep: it takes one that gridding cannot keep.
TEST(PlanPing, of_a_direct_sum_takes_any_tolerance) {
  Situation s = situation(1);
  s.options.synthesis = {SynthesisMethod::direct, 1e-14};
  s.options.sampling.scatterers_per_cell = 0;
  EXPECT_TRUE(stage(plan_of(s), "direct-sum").included);
  EXPECT_GT(image(s).abs().maxCoeff(), 0);
}

TEST(PlanPing, names_the_stages_that_can_be_forced) {
  Situation s = situation(1);
  EXPECT_EQ(error_of([&] { force_stage("noize", true, s.event, s.environment, s.options); }),
            "force_stage: 'noize' cannot be forced; these can: outer-elevations, outer-azimuths, detail, "
            "occlusion, absorption-slope, refraction, motion, multipath, mirrors, double-echoes, volume, surface, "
            "bottom, noise, "
            "direct-sum, "
            "phases, true-delays");
}

TEST(PlanPing, counts_what_a_ping_will_hold) {
  const auto expect_counted = [](const Situation& s) {
    const PreparedScene scene(s.scene);
    const PingSimulator simulator(s.head, s.environment, s.options);
    const SamplingReport counted = simulator.count(scene, s.event),
                         sampled = simulator.ping(scene, s.event).report.sampling;
    EXPECT_GT(counted.scatterers, 100U);
    EXPECT_EQ(counted.scatterers, sampled.scatterers);
    EXPECT_EQ(counted.visible, sampled.visible);
  };
  Situation s = situation(4);
  expect_counted(s);
  s.head = small_head({.beams = 1, .field_of_view_deg = 2, .elevation_width_deg = 40, .max_range = 8});
  s.options.sampling.outer_azimuths = Choice::always;
  expect_counted(s);
  s.options.sampling.kind = SamplingKind::rays;
  const PreparedScene scene(s.scene);
  EXPECT_EQ(PingSimulator(s.head, s.environment, s.options).count(scene, s.event).scatterers, 64U);
}

TEST(PlanPing, of_an_empty_view_is_finite_but_for_what_is_left_out) {
  Situation s = situation(1);
  s.event.world_from_head = pose_from_yaw_pitch_roll({0, 0, 500}, 0, 0, 0);
  const PingPlan plan = plan_of(s);
}
