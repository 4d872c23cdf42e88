// SPDX-License-Identifier: BSD-3-Clause
// Tests the water at the head's own depth: sound speed, absorption and rays of each ping follow from the head's
// position.
#include "core/units.hpp"
#include "simulate/plan_ping.hpp"
#include "simulate/simulate_ping.hpp"
#include "support/heads.hpp"
#include "support/test.hpp"

namespace {

/// Returns a warm layer over cold water, under a surface at `height`.
Environment layered_sea(double height = 0) {
  Environment sea;
  sea.water.latitude_deg = -33;
  sea.profile = SoundSpeedProfile{{0, 4, 6, 60}, {1520, 1518, 1450, 1446}};
  sea.surface = SeaSurface{.height = height};
  return sea;
}

/// Returns horizontal way and travel time of a ray of Snell's invariant p [s/m] down a layer: Simpson's rule over
/// depth.
Eigen::Vector2d through_layer(const SoundSpeedProfile& profile, double from, double to, double p) {
  constexpr int steps = 2000;
  const double step = (to - from) / steps;
  Eigen::Vector2d sum(0, 0);
  for (int k = 0; k <= steps; ++k) {
    const double c = sound_speed_at(profile, from + k * step), sine = std::sqrt(1 - p * p * c * c);
    sum += (k == 0 || k == steps ? 1 : k % 2 == 1 ? 4 : 2) * Eigen::Vector2d(p * c / sine, 1 / (c * sine));
  }
  return sum * step / 3;
}

/// Returns the one-way travel time of the ray between two depths so far apart; its invariant is found by bisection.
double traced_time(const SoundSpeedProfile& profile, double from, double to, double horizontal) {
  std::vector<double> edges{from, to};
  for (const double depth : profile.depth)
    if (depth > from && depth < to) edges.push_back(depth);
  std::sort(edges.begin(), edges.end());
  double fastest = 0;
  for (const double depth : edges) fastest = std::max(fastest, sound_speed_at(profile, depth));
  const auto ray = [&](double p) {
    Eigen::Vector2d sum(0, 0);
    for (std::size_t i = 1; i < edges.size(); ++i) sum += through_layer(profile, edges[i - 1], edges[i], p);
    return sum;
  };
  double low = 0, high = (1 - 1e-7) / fastest;
  for (int k = 0; k < 60; ++k) (ray(0.5 * (low + high))[0] < horizontal ? low : high) = 0.5 * (low + high);
  const Eigen::Vector2d found = ray(low);
  EXPECT_NEAR(found[0], horizontal, 1e-6) << "a ray that turns is not traced here";
  return found[1];
}

/// Returns one small patch 12 m ahead of the head, down its axis.
SceneCloud patch_ahead(const Pose& head) {
  SceneCloud scene;
  scene.materials = {Material{}};
  scene.origin = head * Eigen::Vector3d(12, 0, 0);
  add_surfel(scene, scene.origin, -head.linear().col(0), 1e-4);
  return scene;
}

/// Options without echoes by way of the surface, where a patch is one scatterer.
const SimulationOptions one_by_one{.amplitude = SurfaceAmplitude::coherent,
                                   .sampling = {.scatterers_per_cell = 0},
                                   .effects = {.multipath = Choice::never, .refraction = Choice::always},
                                   .outputs = {.scatterers = true}};

/// Returns tilted heads of a dive; the last one is close below the surface.
std::vector<Pose> dive(double surface) {
  const auto at = [&](double depth, double yaw, double pitch, double roll) {
    return pose_from_yaw_pitch_roll({300 + depth, -40, surface - depth}, radians(yaw), radians(pitch), radians(roll));
  };
  return {at(1, 20, 35, 12), at(4.7, -130, 50, -20), at(5.6, 10, 70, 0),
          at(8, 75, 25, 30), at(20, -60, 40, -8),    at(0.05, 0, 40, 15)};
}

std::string refusal_of(const Environment& environment, double z) {
  const SonarHead head = small_head({});
  return error_of([&] {
    simulate_ping(patch_ahead(Pose::Identity()), head, pose_from_yaw_pitch_roll({0, 0, z}, 0, 0, 0), environment);
  });
}

}  // namespace

TEST(HeadWater, is_that_of_its_own_depth_in_every_ping_of_a_dive) {
  const SonarHead head = small_head({});
  for (const double surface : {0.0, 376.5}) {
    const Environment sea = layered_sea(surface);
    const PingSimulator simulator(head, sea, one_by_one);
    for (const Pose& pose : dive(surface)) {
      const double depth = surface - pose.translation().z(), c = sound_speed_at(*sea.profile, depth);
      const SceneCloud scene = patch_ahead(pose);
      const SimulatedPing result = simulator.ping(PreparedScene(scene), {pose});
      EXPECT_NEAR(result.ping.sound_speed, c, 1e-4) << depth;
      EXPECT_EQ(result.report.medium.sound_speed, result.ping.sound_speed);
      const double absorption = absorption_db_per_m({.depth = depth, .latitude_deg = -33}, head.pulse.centre_frequency);
      EXPECT_NEAR(result.ping.absorption_db_per_m / absorption, 1, 1e-9);

      // The travel time is that of a ray traced from the head's depth, and the echo stands in its bin.
      ASSERT_EQ(result.outputs.scatterers.size(), 1U);
      const Eigen::Vector3d way = pose.linear().col(0) * 12;
      const double time = traced_time(*sea.profile, depth, depth - way.z(), way.head<2>().norm());
      const double range = result.outputs.scatterers.range[0];
      EXPECT_NEAR(range / c / time, 1, 1e-6) << depth;
      Eigen::Index beam = 0, bin = 0;
      result.ping.pressure.abs().maxCoeff(&beam, &bin);
      EXPECT_NEAR(head.gate.centre(static_cast<std::size_t>(bin)), range, 0.51 * head.gate.bin_size);

      // The tables for beams are kept from ping to ping, and change no byte.
      EXPECT_TRUE((result.ping.pressure == simulate_ping(scene, head, pose, sea, one_by_one).ping.pressure).all());
    }
  }
}

TEST(HeadWater, is_the_given_one_without_a_surface_whatever_the_height) {
  Environment lake;
  lake.water = {.salinity_psu = 0, .depth = 30};
  const Pose pose = pose_from_yaw_pitch_roll({0, 0, 374}, 0, radians(20), 0);
  const SimulatedPing result = simulate_ping(patch_ahead(pose), small_head({}), pose, lake);
  EXPECT_EQ(result.ping.sound_speed, sound_speed(lake.water));
  EXPECT_EQ(result.report.medium, medium_of(lake, small_head({}).pulse.centre_frequency, 2));
}

TEST(HeadWater, is_one_along_a_level_way_but_for_rounding) {
  const Environment sea = layered_sea(2.3);
  const auto at = [&](double z) { return medium_of(environment_at(sea, z, "test"), 450e3); };
  EXPECT_EQ(at(-5.1), at(-5.1 + 1e-12));
  EXPECT_EQ(at(-5.1), at(-5.1001));  // depths count in millimetres, so that pings on a tide share their tables
  EXPECT_NE(at(-5.1), at(-5.101));
  EXPECT_EQ(environment_at(environment_at(sea, -5.1, "test"), -5.1, "test").water.depth,
            environment_at(sea, -5.1, "test").water.depth);
}

TEST(HeadWater, refuses_a_head_without_a_depth) {
  for (const double z : {0.0, 0.5, 1e-7})
    EXPECT_THAT(refusal_of(layered_sea(), z),
                HasSubstr("must be below the surface of the water, surface.height = 0 m"));
  Environment deep = layered_sea();
  deep.water.depth = 3;
  EXPECT_THAT(refusal_of(deep, -3.02), HasSubstr("must agree to 0.01 m; leave water.depth_m out"));
  EXPECT_EQ(refusal_of(deep, -3.005), "no error");
  Environment nowhere = layered_sea();
  nowhere.surface.reset();
  nowhere.water.depth = 5;
  EXPECT_THAT(refusal_of(nowhere, -5), HasSubstr("give surface.height_m, e.g. --set surface.height_m=0"));
  nowhere.profile = SoundSpeedProfile{{0, 60}, {1490, 1490}};  // the same at every depth
  EXPECT_EQ(refusal_of(nowhere, -5), "no error");
}

// The whole scene is in even water below the thermocline, though a ball of the same size is not.
TEST(HeadWater, report_of_refraction_speaks_of_what_is_in_view_as_the_plan_does) {
  Environment sea = layered_sea();
  sea.profile = SoundSpeedProfile{{0, 4, 6, 60}, {1520, 1518, 1450, 1450}};
  const Pose pose = pose_from_yaw_pitch_roll({0, 0, -8}, 0, radians(60), 0);
  const SceneCloud scene = patch_ahead(pose);
  SimulationOptions options{.effects = {.multipath = Choice::never}};
  const auto bound_of_plan = [&] {
    const PingPlan plan = plan_ping(scene, small_head({}), {pose}, sea, options);
    return std::find_if(plan.stages.begin(), plan.stages.end(),
                        [](const auto& s) { return std::string("refraction") == s.name; })
        ->bound_db;
  };
  EXPECT_LT(bound_of_plan(), 1e-6);
  const RefractionReport below = simulate_ping(scene, small_head({}), pose, sea, options).report.refraction;
  EXPECT_FALSE(below.bent);
  EXPECT_LT(below.bound.range, 1e-9);
  EXPECT_LT(below.bound.elevation, 1e-9);

  // From within the thermocline both speak up.
  sea.surface->height = 3;
  sea.profile->depth = {0, 10, 16, 60};
  EXPECT_GT(bound_of_plan(), 0.1);
  const RefractionReport within = simulate_ping(scene, small_head({}), pose, sea, options).report.refraction;
  EXPECT_TRUE(within.bent);
  EXPECT_GT(within.bound.range, 1e-3);
}
