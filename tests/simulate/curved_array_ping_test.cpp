// SPDX-License-Identifier: BSD-3-Clause
// Tests pings of a head with a curved array (E205): plan, sampled region, levels and outputs.
#include "beamforming/engine.hpp"
#include "scene/built_in_scenes.hpp"
#include "simulate/plan_ping.hpp"
#include "simulate/resolve_ping.hpp"
#include "simulate/simulate_ping.hpp"
#include "sonar/receive_array.hpp"
#include "support/heads.hpp"
#include "support/scenes.hpp"
#include "support/test.hpp"

namespace insonify::curved_array_ping_tests {

SonarHead bent_head() {
  SonarSpec spec = small_sonar({.beams = 11,
                                .field_of_view_deg = 66,
                                .beam_width_deg = 6,
                                .elevation_width_deg = 30,
                                .min_range = 2,
                                .max_range = 6});
  spec.array = ArrayShape::curved, spec.array_radius = 0.04;
  return make_head(spec, c0);
}

const Pose above = pose_from_yaw_pitch_roll({0, 0, 2}, 0, radians(25), 0);

const SceneCloud& level_ground() {
  static const SceneCloud scene = make_built_in_scene("plane", {.points = 3000, .size = {14, 14}});
  return scene;
}

SimulationOptions few_parts(SynthesisMethod method = SynthesisMethod::gridded) {
  SimulationOptions o;
  o.synthesis.method = method, o.sampling.scatterers_per_cell = 2;
  return o;
}

const PlannedStage& stage_of(const PingPlan& plan, const std::string& name) {
  return *std::ranges::find(plan.stages, name, &PlannedStage::name);
}

double energy(const SimulatedPing& ping) { return ping.ping.pressure.cast<std::complex<double>>().abs2().sum(); }

TEST(CurvedArrayPing, is_planned_with_an_engine_that_serves_it) {
  const PingPlan plan = plan_ping(level_ground(), bent_head(), {.world_from_head = above}, {}, {});
  EXPECT_EQ(plan.options.synthesis.method, SynthesisMethod::element_exact);
  EXPECT_TRUE(stage_of(plan, "true-delays").included);
  SimulationOptions narrow;
  narrow.synthesis.true_delays = Choice::never;
  EXPECT_EQ(plan_ping(level_ground(), bent_head(), {.world_from_head = above}, {}, narrow).options.synthesis.method,
            SynthesisMethod::direct);
  SimulationOptions display;
  display.outputs.display_bins = 20;
  const PingPlan cells = plan_ping(level_ground(), bent_head(), {.world_from_head = above}, {}, display);
  EXPECT_TRUE(stage_of(cells, "phases").included);
  EXPECT_THAT(stage_of(cells, "phases").why, HasSubstr("patterns of lines"));
}

// A plate of 2 cm at 5 m is a point to beams of 6 degrees: they differ by their responses alone.
TEST(CurvedArrayPing, hears_a_plate_by_the_response_of_each_beam) {
  SonarHead head = bent_head();
  head.fan = make_fan(33, radians(66), radians(6), radians(30));
  const Pose turned = pose_from_yaw_pitch_roll({0, 0, 0}, radians(9), radians(5), 0);
  const Eigen::Vector3d from = (turned.inverse() * Eigen::Vector3d(5, 0, 0)).normalized();
  const auto array = receive_array(head);
  const std::vector<Eigen::Vector3d> axes = beam_axes(head.fan);
  for (const auto method : {SynthesisMethod::incoherent, SynthesisMethod::direct}) {
    SimulationOptions o = few_parts(method);
    o.amplitude = SurfaceAmplitude::coherent;
    const SimulatedPing ping = simulate_ping(plate(5, 0.02, 1), head, turned, {}, o);
    const Eigen::ArrayXd heard = ping.ping.pressure.cast<std::complex<double>>().abs2().rowwise().sum();
    Eigen::ArrayXd expected(heard.size());
    for (std::size_t b = 0; b < axes.size(); ++b)
      expected(static_cast<Eigen::Index>(b)) =
          std::norm(array->response(from, axes[b], sound_speed(Water{}) / head.pulse.centre_frequency));
    int loud = 0;
    for (Eigen::Index b = 0; b < heard.size(); ++b) {
      if (expected(b) < 0.003) continue;
      ++loud;
      EXPECT_NEAR(10 * std::log10(heard(b) / heard.maxCoeff()), 10 * std::log10(expected(b) / expected.maxCoeff()), 0.1)
          << engine_of(method).word << " " << b;
    }
    EXPECT_GE(loud, 3);
  }
}

// Some 1000 independent cells in each of 8 pings: 0.05 dB of one deviation.
TEST(CurvedArrayPing, has_the_expected_level_in_the_mean) {
  const double level =
      energy(simulate_ping(level_ground(), bent_head(), above, {}, few_parts(SynthesisMethod::incoherent)));
  double mean = 0;
  constexpr int pings = 8;
  for (int seed = 1; seed <= pings; ++seed) {
    SimulationOptions speckled = few_parts();
    speckled.seed = static_cast<std::uint64_t>(seed);
    mean += energy(simulate_ping(level_ground(), bent_head(), above, {}, speckled)) / pings;
  }
  EXPECT_NEAR(10 * std::log10(mean / level), 0, 0.25);
}

// Main lobes lie between the cones and the azimuths of the beams, and the sampled sector holds both.
TEST(CurvedArrayPing, samples_its_main_lobes_where_they_bend) {
  const SonarHead head = bent_head();
  const ResolvedPing ping = resolve_ping(whole_of(level_ground()), head, {above}, {}, {}, "test");
  const double extent = ping.view.sampling.elevation_half_extent;
  EXPECT_NEAR(ping.view.sampling.lobe_margin, std::sin(head.fan.azimuth.back()) * (1 - std::cos(extent)), 1e-12);
  SonarHead straight = head;
  straight.array_shape = ArrayShape::line, straight.array_radius = 0;
  EXPECT_EQ(resolve_ping(whole_of(level_ground()), straight, {above}, {}, {}, "test").view.sampling.lobe_margin, 0);
  const auto array = receive_array(head);
  const double u_beam = std::sin(head.fan.azimuth.back()), v = std::sin(0.5 * extent);
  double loudest = 0, at = 0;
  for (double u = 0; u < std::cos(0.5 * extent); u += 1e-3) {
    const double power = std::norm(array->response(ahead(u, v), ahead(u_beam, 0), c0 / head.pulse.centre_frequency));
    if (power > loudest) loudest = power, at = u;
  }
  EXPECT_LT(at, u_beam + 2e-3);
  EXPECT_GT(at, u_beam * std::cos(0.5 * extent) - 2e-3);
  SimulationOptions all = few_parts(SynthesisMethod::incoherent);
  all.sampling.outer_azimuths = Choice::always;
  const double planned = energy(simulate_ping(level_ground(), head, above, {}, few_parts(SynthesisMethod::incoherent))),
               whole = energy(simulate_ping(level_ground(), head, above, {}, all));
  EXPECT_NEAR(10 * std::log10(planned / whole), 0, 0.1);  // the budget of the plan
}

TEST(CurvedArrayPing, lists_the_surfels_of_a_pixel_and_refuses_halves) {
  SimulationOptions o = few_parts();
  o.outputs.contributors = 1;
  const SonarHead head = bent_head();
  const SimulatedPing ping = simulate_ping(level_ground(), head, above, {}, o);
  const Contributors& found = ping.outputs.contributors;
  int near = 0, all = 0;
  for (std::size_t b = 0; b < found.beams; ++b)
    for (std::size_t n = 0; n < found.bins; ++n) {
      const std::uint32_t surfel = found.surfel[b * found.bins + n];
      if (surfel == Contributors::none) continue;
      const Eigen::Vector3d p = above.inverse() * (level_ground().origin + level_ground().point[surfel].cast<double>());
      const double off = std::abs(std::atan2(p.y(), p.x()) - head.fan.azimuth[b]);
      ++all, near += off < radians(12) ? 1 : 0;
    }
  EXPECT_GT(all, 500);
  EXPECT_GT(near, 0.9 * all);
  o.outputs.split_phase = true;
  expect_error(ErrorKind::argument, {"this head has a curved array"},
               [&] { simulate_ping(level_ground(), head, above, {}, o); });
  SimulationOptions fast;
  fast.synthesis.method = SynthesisMethod::true_delays;
  expect_error(ErrorKind::argument, {"true-delays does not form beams of a curved array"},
               [&] { simulate_ping(level_ground(), head, above, {}, fast); });
}

}  // namespace insonify::curved_array_ping_tests
