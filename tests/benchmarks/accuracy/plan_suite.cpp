// SPDX-License-Identifier: BSD-3-Clause
#include "plan_suite.hpp"

#include <cmath>
#include <ctime>

#include "core/units.hpp"
#include "scene/built_in_scenes.hpp"
#include "store/sonar_file.hpp"

namespace insonify {
namespace {

/// The part of a preset's head that a case uses.
struct HeadPart {
  const char* sonar;
  double min_range, max_range;
  std::size_t beams, rows = 1;  ///< largest numbers, evenly taken
};

/// Keeps every so many-th beam of every so many-th row.
void thin(BeamFan& fan, std::size_t beams, std::size_t rows) {
  const std::vector<FanRow> all = fan_rows(fan);
  const std::size_t row_step = std::max<std::size_t>(1, all.size() / rows);
  BeamFan kept = fan;
  kept.azimuth.clear(), kept.elevation.clear();
  for (std::size_t r = row_step / 2; r < all.size(); r += row_step) {
    const std::size_t step = std::max<std::size_t>(1, all[r].beams.size() / beams);
    for (std::size_t b = step / 2; b < all[r].beams.size(); b += step) {
      kept.azimuth.push_back(fan.azimuth[all[r].beams[b]]);
      kept.elevation.push_back(fan.elevation[all[r].beams[b]]);
    }
  }
  fan = kept;
}

SonarHead head_of(const HeadPart& part, const Environment& environment) {
  SonarSpec spec = find_sonar(part.sonar).spec;
  spec.min_range = part.min_range;
  spec.max_range = part.max_range;
  SonarHead head = make_head(spec, sound_speed(environment.water));
  thin(head.fan, part.beams, part.rows);
  return head;
}

/// Returns a height field of hills and ripples: x from 0 to `length`, y from -width/2 to width/2.
SceneCloud rough_field(double length, double width, double cell) {
  SceneCloud scene;
  for (int i = 0; i < length / cell; ++i)
    for (int j = 0; j < width / cell; ++j) {
      const double jitter = 0.3 * std::sin(12.9898 * i + 78.233 * j);
      const double x = (i + 0.5 + jitter) * cell, y = (j + 0.5 - jitter) * cell - width / 2;
      const double z = 0.15 * std::sin(1.1 * x + 0.4 * y) + 0.08 * std::sin(2.3 * y - 0.7 * x);
      const double dx = 0.165 * std::cos(1.1 * x + 0.4 * y) - 0.056 * std::cos(2.3 * y - 0.7 * x);
      const double dy = 0.06 * std::cos(1.1 * x + 0.4 * y) + 0.184 * std::cos(2.3 * y - 0.7 * x);
      const Eigen::Vector3d normal(-dx, -dy, 1);
      add_surfel(scene, {x, y, z}, normal.normalized(), cell * cell * normal.norm());
    }
  return scene;
}

Pose pose(double x, double y, double z, double pitch_deg, double yaw_deg = 0) {
  return pose_from_yaw_pitch_roll({x, y, z}, radians(yaw_deg), radians(pitch_deg), 0);
}

SceneCloud built_in(const char* name, std::size_t points, double length = 10, double width = 12) {
  return make_built_in_scene(name, {.points = points, .size = {length, width}});
}

Environment water_of(double temperature_c, double depth) {
  Environment e;
  e.water.temperature_c = temperature_c;
  e.water.depth = depth;
  return e;
}

Environment with_surface(double height, double depth) {
  Environment e = water_of(12, depth);
  e.surface = SeaSurface{.height = height, .rms_height = 0.0005};
  return e;
}

/// Returns water with a profile under a sea so rough that it reflects nothing.
Environment with_profile() {
  Environment e = with_surface(8, 5);
  e.surface->rms_height = 1;
  e.profile = SoundSpeedProfile{{0, 5, 20}, {1497, 1496.9, 1494}};
  return e;
}

}  // namespace

std::vector<PlanCase> plan_cases() {
  std::vector<PlanCase> cases;
  const auto add = [&](const char* scene, SceneCloud cloud, const HeadPart& part, const Pose& at,
                       const Environment& environment, const Motion& motion = {}) {
    PlanCase& c = cases.emplace_back(
        PlanCase{scene, part.sonar, std::move(cloud), head_of(part, environment), {at, motion}, environment, {}});
    c.options.seed = cases.size();
    c.options.sampling.outer_elevations = c.options.sampling.outer_azimuths = Choice::never;
    c.options.effects.multipath = c.options.effects.refraction = c.options.effects.moving = Choice::never;
    c.options.effects.absorption_order = 0;
    c.options.synthesis.true_delays = Choice::never;
  };
  const Environment coast = water_of(12, 5);
  add("plane", built_in("plane", 7000), {"oculus-m750d", 5, 6.5, 12}, pose(0, 0, 3, 15), coast);
  add("plane", built_in("plane", 7000), {"p900-45", 4, 7, 16}, pose(0, 0, 3, 15), coast);
  add("rough field", rough_field(2, 14, 0.06), {"em2040", 4, 6, 12}, pose(1, 0, 5, 90), coast);
  add("rough field", rough_field(8, 12, 0.12), {"m900-130", 4, 6, 12}, pose(0, 0, 2.5, 20), coast);
  add("rough field", rough_field(12, 14, 0.16), {"ping360", 3, 9, 1}, pose(0, 0, 2.5, 20), coast);
  add("wall", built_in("wall", 6000, 3, 3), {"aris-3000", 3, 3.3, 8}, pose(2, 0, 0, 0, 5), coast);
  add("wall", built_in("wall", 6000, 10, 8), {"imagenex-881l", 3, 7, 1}, pose(0, 0, 0, 0, 20), coast);
  add("harbour", built_in("harbour", 30000), {"gemini-720im", 5, 9, 12}, pose(0, 0, -3, 10), coast);
  add("harbour", built_in("harbour", 30000), {"oculus-m750d", 20, 23, 12}, pose(0, 0, -3, 10), coast);
  add("harbour, surface", built_in("harbour", 30000), {"p900-45", 10, 16, 12}, pose(0, 0, -3, 5), with_surface(0, 3));
  add("plane, surface", built_in("plane", 5000), {"gemini-720im", 4, 7, 12}, pose(0, 0, 3, 15), with_surface(5, 2));
  add("plane, profile", built_in("plane", 5000), {"gemini-720im", 4, 7, 12}, pose(0, 0, 3, 15), with_profile());
  add("plane, moving head", built_in("plane", 5000), {"gemini-720im", 4, 7, 12}, pose(0, 0, 3, 15), coast,
      {{0.01, 0.002, 0}, {0, 0, 0.001}});
  add("deep water", built_in("plane", 9000, 4, 60), {"em2040", 25, 30, 12}, pose(2, 0, 25, 90), water_of(3, 1000));
  add("plane", built_in("plane", 6000, 6, 8), {"waterlinked-3d15", 4, 5, 8, 3}, pose(0, 0, 2, 20), coast);
  return cases;
}

namespace {

ComplexGrid image(const PlanCase& c) {
  const PingSimulator simulator(c.head, c.environment, c.options);
  return simulator.ping(PreparedScene(c.cloud), c.event).ping.pressure.cast<std::complex<double>>();
}

}  // namespace

std::vector<PlanEffect> plan_effects(const PlanCase& c) {
  const PingPlan plan = plan_ping(c.cloud, c.head, c.event, c.environment, c.options);
  const ComplexGrid without = image(c);
  std::vector<PlanEffect> effects;
  for (const PlannedStage& stage : plan.stages) {
    if (stage.by != DecidedBy::budget || stage.bound_relative == 0) continue;
    PlanCase forced = c;
    force_stage(stage.name, true, forced.event, forced.environment, forced.options);
    const std::clock_t start = std::clock();
    const ComplexGrid with = image(forced);
    const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
    const double energy = without.abs2().sum();
    effects.push_back({stage.name, c.scene, c.sonar, stage.bound_db,
                       db_from_amplitude(1 + std::sqrt((with - without).abs2().sum() / energy)),
                       db_from_power(with.abs2().sum() / energy), seconds});
  }
  return effects;
}

LeftOut left_out_of_default(const PlanCase& c, double accuracy_db) {
  PlanCase by_default = c;
  by_default.options = {};
  by_default.options.accuracy_db = accuracy_db;
  by_default.options.seed = c.options.seed;
  const PingPlan plan = plan_ping(c.cloud, c.head, c.event, c.environment, by_default.options);
  by_default.options = plan.options;
  PlanCase whole = by_default;
  LeftOut result;
  double squares = 0;
  for (const PlannedStage& stage : plan.stages) {
    const bool too_slow = stage.name == "true-delays" && c.head.column;
    if (stage.by != DecidedBy::budget || stage.included || stage.bound_relative == 0 || too_slow) continue;
    force_stage(stage.name, true, whole.event, whole.environment, whole.options);
    result.stages += (result.stages.empty() ? "" : ", ") + stage.name;
    squares += stage.bound_relative * stage.bound_relative;
  }
  if (result.stages.empty()) return result;
  const ComplexGrid without = image(by_default), with = image(whole);
  result.bound_db = db_from_amplitude(1 + std::sqrt(squares));
  result.actual_db = db_from_amplitude(1 + std::sqrt((with - without).abs2().sum() / without.abs2().sum()));
  return result;
}

}  // namespace insonify
