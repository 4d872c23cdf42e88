// SPDX-License-Identifier: BSD-3-Clause
// Tests the surfels that made a pixel, through the whole signal path.
#include <set>

#include "returns/coverage.hpp"
#include "scene/built_in_scenes.hpp"
#include "simulate/simulate_ping.hpp"
#include "support/heads.hpp"
#include "support/test.hpp"

namespace {

const SonarHead contributing_head = small_head({.beams = 32, .field_of_view_deg = 50, .max_range = 18});

/// Returns a level plane 3 m below the contributing_head, one material to port (y > 0), another to starboard.
SceneCloud two_materials() {
  SceneCloud scene = make_built_in_scene("plane", {.points = 40000, .size = {30, 30}});
  scene.materials = {{"mud", 0.01}, {"rock", 0.01}};
  for (std::size_t i = 0; i < scene.size(); ++i)
    scene.material[i] = scene.origin.y() + static_cast<double>(scene.point[i].y()) > 0 ? 0 : 1;
  return scene;
}

const Pose over_plane = pose_from_yaw_pitch_roll({0, 0, 3}, 0, radians(15), 0);

}  // namespace

TEST(SimulatedContributors, are_kept_when_asked_for) {
  const SceneCloud scene = two_materials();
  const SimulatedPing without = simulate_ping(scene, contributing_head, over_plane, {});
  EXPECT_TRUE(without.outputs.contributors.empty());
  const SimulatedPing with = simulate_ping(scene, contributing_head, over_plane, {}, {.outputs = {.contributors = 2}});
  EXPECT_EQ(with.outputs.contributors.beams, contributing_head.fan.beams());
  EXPECT_EQ(with.outputs.contributors.bins, contributing_head.gate.bins());
  EXPECT_EQ(with.outputs.contributors.per_pixel, 2U);
  EXPECT_TRUE((with.ping.pressure == without.ping.pressure).all());
}

// Rows of beams are found a few at a time, so that memory does not grow with their number.
TEST(SimulatedContributors, in_bands_of_rows_are_those_of_all_rows_at_once) {
  const SceneCloud scene = two_materials();
  SonarHead head = contributing_head;
  head.fan = {};
  for (int row = 0; row < 7; ++row)
    for (int beam = 0; beam < 6; ++beam) {
      head.fan.azimuth.push_back(radians(6 * beam - 15));
      head.fan.elevation.push_back(radians(3 * row - 9));
    }
  head.fan.beam_width = radians(4), head.fan.elevation_width = radians(6);
  const SimulatedPing whole = simulate_ping(scene, head, over_plane, {}, {.outputs = {.contributors = 2}});
  struct JoinedBands : ContributorSink {
    Contributors joined;
    std::size_t bands = 0;
    void take(const Contributors& band, std::size_t first_beam) override {
      EXPECT_EQ(first_beam, joined.beams);
      joined.beams += band.beams, joined.bins = band.bins, joined.per_pixel = band.per_pixel;
      joined.surfel.insert(joined.surfel.end(), band.surfel.begin(), band.surfel.end());
      joined.share.insert(joined.share.end(), band.share.begin(), band.share.end());
      ++bands;
    }
  } sink;
  const Contributors& joined = sink.joined;
  SimulationOptions options{.outputs = {.contributors = 2}};
  options.outputs.contributor_band_mib = 0.01;  // two rows, and three at last
  options.outputs.contributor_sink = &sink;
  const SimulatedPing parts = simulate_ping(scene, head, over_plane, {}, options);
  EXPECT_EQ(sink.bands, 3u);
  EXPECT_TRUE(parts.outputs.contributors.empty());
  EXPECT_EQ(joined.beams, head.fan.beams());
  EXPECT_EQ(joined.surfel, whole.outputs.contributors.surfel);
  EXPECT_EQ(joined.share, whole.outputs.contributors.share);
  EXPECT_TRUE((parts.ping.labels.material == whole.ping.labels.material).all());
  EXPECT_TRUE((parts.ping.labels.id == whole.ping.labels.id).all());
  EXPECT_TRUE((parts.ping.labels.share == whole.ping.labels.share).all());
  EXPECT_GT((parts.ping.labels.material < 2).count(), 100);
}

// Port is positive azimuth: beams that look to port show the mud there.
TEST(SimulatedContributors, show_a_boundary_of_materials_at_its_bearing) {
  const SimulatedPing p =
      simulate_ping(two_materials(), contributing_head, over_plane, {}, {.outputs = {.contributors = 1}});
  const auto image = material_image(p.outputs.contributors);
  std::size_t right = 0, all = 0;
  for (std::size_t b = 0; b < contributing_head.fan.beams(); ++b) {
    if (std::abs(contributing_head.fan.azimuth[b]) < radians(3)) continue;
    for (std::size_t n = 0; n < contributing_head.gate.bins(); ++n) {
      if (contributing_head.gate.centre(n) < 5 || contributing_head.gate.centre(n) > 14) continue;
      right += image(static_cast<Eigen::Index>(b), static_cast<Eigen::Index>(n)) ==
               (contributing_head.fan.azimuth[b] > 0 ? 0 : 1);
      ++all;
    }
  }
  EXPECT_GT(all, 1000U);
  EXPECT_EQ(right, all);
}

// The elevation that is named is where a plane 3 m below shows at that range: asin(-3 / r) in the world, 15 degrees up
// in the contributing_head, as seen straight ahead.
TEST(SimulatedContributors, of_a_plane_stand_at_the_elevation_of_the_plane) {
  const SimulatedPing p =
      simulate_ping(two_materials(), contributing_head, over_plane, {}, {.outputs = {.contributors = 1}});
  for (std::size_t n = 0; n < contributing_head.gate.bins(); ++n) {
    const double r = contributing_head.gate.centre(n);
    if (r < 7 || r > 14) continue;
    const double expected = std::asin(-3 / r) + radians(15);
    ASSERT_NEAR(p.outputs.contributors.elevation[p.outputs.contributors.at(16, n)], expected, radians(1)) << r;
  }
}

// Under a smooth surface the echo of a target arrives by four paths; those by way of the surface arrive later and from
// above.
TEST(SimulatedContributors, by_way_of_the_surface_carry_their_path_kind) {
  SceneCloud scene;
  scene.materials = {{"m", 0.1}};
  add_surfel(scene, {10, 0, -4}, {-1, 0, 0}, 1e-3);
  SonarHead wide = contributing_head;
  wide.fan.elevation_width = radians(170);
  Environment environment;
  environment.surface = SeaSurface{};
  Pose pose = Pose::Identity();
  pose.translation() = Eigen::Vector3d(0, 0, -2);
  const SimulatedPing p = simulate_ping(scene, wide, pose, environment,
                                        {.effects = {.multipath = Choice::always}, .outputs = {.contributors = 4}});
  const double direct = std::hypot(10, 2), bounced = std::hypot(10, 6);
  const auto at_range = [&](double range) {
    const auto bin = static_cast<std::size_t>((range - wide.gate.min_range) / wide.gate.bin_size);
    return p.outputs.contributors.at(16, bin);
  };
  const Contributors& c = p.outputs.contributors;
  EXPECT_EQ(c.path[at_range(direct)], PathKind::direct);
  EXPECT_EQ(c.path[at_range((direct + bounced) / 2)], PathKind::one_bounce);
  EXPECT_EQ(c.path[at_range(bounced)], PathKind::two_bounces);
  EXPECT_NEAR(c.elevation[at_range(direct)], std::asin(-2 / direct), 1e-3);
  EXPECT_NEAR(c.elevation[at_range(bounced)], std::asin(6 / bounced), 1e-3);
  for (const double range : {direct, (direct + bounced) / 2, bounced}) EXPECT_EQ(c.surfel[at_range(range)], 0U);
  // The mixed path comes from both directions, in equal parts.
  const std::size_t mixed = at_range((direct + bounced) / 2);
  EXPECT_EQ(c.path[mixed + 1], PathKind::one_bounce);
  EXPECT_NEAR(c.share[mixed], 0.5, 0.01);
  EXPECT_NEAR(c.share[mixed + 1], 0.5, 0.01);
  EXPECT_NEAR(c.elevation[mixed] + c.elevation[mixed + 1], std::asin(6 / bounced) + std::asin(-2 / direct), 2e-3);
}

// Loud pixels are made by surfels that stand in their beam and at their range.
TEST(SimulatedContributors, of_the_harbour_stand_where_the_pixel_looks) {
  const SceneCloud scene = make_built_in_scene("harbour", {.points = 30000});
  const Pose pose = pose_from_yaw_pitch_roll({0, 0, -3}, 0, radians(10), 0);
  const SimulatedPing p = simulate_ping(scene, contributing_head, pose, {},
                                        {.outputs = {.contributors = 1}, .detection = {.false_alarm_rate = 1}});
  ASSERT_GT(p.soundings.size(), 100U);
  std::size_t near = 0, of_surfels = 0;
  for (std::size_t i = 0; i < p.soundings.size(); ++i) {
    if (p.soundings.true_surfel[i] == Soundings::none) continue;
    ++of_surfels;
    const std::size_t at = p.outputs.contributors.at(p.soundings.beam[i], p.soundings.bin[i]);
    ASSERT_NE(p.outputs.contributors.surfel[at], Contributors::none);
    const std::uint32_t s = p.outputs.contributors.surfel[at];
    const Eigen::Vector3d position = pose.inverse() * (scene.origin + scene.point[s].cast<double>());
    const double off = direction_of(position).azimuth - contributing_head.fan.azimuth[p.soundings.beam[i]];
    near += std::abs(position.norm() - static_cast<double>(p.soundings.range[i])) < 0.3 && std::abs(off) < radians(4);
  }
  ASSERT_GT(of_surfels, 100U);
  EXPECT_GT(near, 0.9 * static_cast<double>(of_surfels));
}

// The map of a ping agrees with what sampling saw, and covers what contributors name.
TEST(SimulatedContributors, are_insonified) {
  const SceneCloud scene = two_materials();
  const SimulatedPing p =
      simulate_ping(scene, contributing_head, over_plane, {}, {.outputs = {.scatterers = true, .contributors = 1}});
  std::set<std::uint32_t> hit;
  for (const CoveredSurfel& s :
       coverage_of(scene, p.outputs.scatterers, contributing_head, p.report.medium, {.min_response_db = -300}))
    hit.insert(s.id);
  EXPECT_LE(hit.size(), p.report.sampling.visible);
  EXPECT_GT(hit.size(), p.report.sampling.visible / 2);
  std::size_t named = 0, covered = 0;
  for (std::size_t b = 4; b < 28; ++b)
    for (std::size_t n = 100; n < contributing_head.gate.bins() - 100; ++n) {
      const std::uint32_t s = p.outputs.contributors.surfel[p.outputs.contributors.at(b, n)];
      if (s == Contributors::none) continue;
      ++named;
      covered += hit.contains(scene.id[s]);
    }
  EXPECT_GT(named, 1000U);
  EXPECT_EQ(covered, named);
}
