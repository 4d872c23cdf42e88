// SPDX-License-Identifier: BSD-3-Clause
#include "acoustics/trace_paths.hpp"
#include "support/test.hpp"

namespace insonify {
namespace {

using Eigen::Vector3d;

double length_of(const std::vector<Vector3d>& points) {
  double length = 0;
  for (std::size_t k = 1; k < points.size(); ++k) length += (points[k] - points[k - 1]).norm();
  return length;
}

/// A patch in a channel 12 m deep, seen from the middle of it.
struct Channel {
  SceneCloud scene;
  Environment environment;
  View view;
  Transmission sent;
  Channel() {
    add_surfel(scene, {10, 1, -7}, {-1, 0, 0}, 0.01);
    environment.surface = SeaSurface{.height = 0, .rms_height = 0.0};
    environment.bottom = FlatBottom{.height = -12};
    view.world_from_head = pose_from_yaw_pitch_roll({0.5, 0, -5}, radians(10), 0, 0);
    view.fan = make_fan(31, radians(120), radians(4), radians(150));
    view.gate = {0.5, 40, 0.05};
    view.sampling.elevation_half_extent = radians(80);
    sent.pulse = {.centre_frequency = 100e3, .bandwidth = 20e3, .source_level_db = 200};
    sent.medium = medium_of(environment, sent.pulse.centre_frequency);
  }
};

TEST(SoundPaths, bounced_lines_are_as_long_as_the_echo_is_late_and_bounce_on_the_boundaries) {
  const Channel c;
  const Scatterers seen =
      find_scatterers(c.scene, c.view.world_from_head, c.view.fan, c.view.gate, c.view.sampling).scatterers;
  const Multipath multipath = multipath_echoes(c.scene, seen, c.environment, c.view, c.sent);
  const SoundPaths paths = multipath_paths(multipath, c.scene, c.view, c.sent.medium, 64);

  // Out and back by direct, surface, bottom: nine pairs of legs less the direct one.
  ASSERT_EQ(paths.size(), 8u);
  double longest = 0;
  for (std::size_t i = 0; i < paths.size(); ++i) {
    const auto& points = paths.points[i];
    ASSERT_EQ(points.size(), 3u + static_cast<std::size_t>(paths.bounces[i]));
    EXPECT_EQ(points.front(), c.view.world_from_head.translation());
    EXPECT_EQ(points.back(), points.front());
    int on_boundary = 0;
    for (const Vector3d& p : points) on_boundary += std::abs(p.z()) < 1e-9 || std::abs(p.z() + 12) < 1e-9;
    EXPECT_EQ(on_boundary, paths.bounces[i]);
    const auto late = [&](double delay) {
      return std::abs(delay * c.sent.medium.sound_speed - length_of(points)) < 1e-4;
    };
    EXPECT_TRUE(std::any_of(multipath.echoes.delay.begin(), multipath.echoes.delay.end(), late)) << length_of(points);
    longest = std::max(longest, length_of(points));
  }
  EXPECT_NEAR(longest, 2 * std::hypot(9.5, 1.0, 12.0), 1e-5);  // out and back by an image
}

TEST(SoundPaths, direct_lines_end_at_the_loudest_patch_of_each_interval_of_direction) {
  SceneCloud scene;
  add_surfel(scene, {4, 0.5, 0}, {-1, 0, 0}, 0.01);
  add_surfel(scene, {4, 0.52, 0.3}, {-1, 0, 0}, 1.0);  // much louder, beside the first
  add_surfel(scene, {4, -2, 0}, {-1, 0, 0}, 0.01);
  const Pose pose = pose_from_yaw_pitch_roll({0, 0, 0}, 0, 0, 0);
  Scatterers seen;
  Echoes echoes;
  const Medium medium = medium_of(Environment{}, 100e3);
  for (std::size_t i = 0; i < scene.size(); ++i) {
    const Vector3d p = scene.point[i].cast<double>();
    const Direction d = direction_of(p);
    seen.range.push_back(p.norm());
    seen.azimuth.push_back(d.azimuth);
    seen.elevation.push_back(d.elevation);
    echoes.u.push_back(p.y() / p.norm());
    echoes.delay.push_back(2 * p.norm() / medium.sound_speed);
    echoes.amplitude.push_back(std::sqrt(static_cast<double>(scene.area[i])));
  }
  const SoundPaths paths = direct_paths(seen, echoes, pose, medium, 8);
  ASSERT_EQ(paths.size(), 2u);
  EXPECT_NEAR((paths.points[0][1] - Vector3d(4, -2, 0)).norm(), 0, 1e-6);
  EXPECT_NEAR((paths.points[1][1] - Vector3d(4, 0.52, 0.3)).norm(), 0, 1e-6);
  const double loss_db = 20 * std::log10(std::exp(-medium.absorption.a0 * length_of(paths.points[1])));
  EXPECT_NEAR(paths.level_db[1], pressure_level_db(1.0) + loss_db, 1e-4);
  EXPECT_THROW(direct_paths(seen, echoes, pose, medium, 0), Error);
}

}  // namespace
}  // namespace insonify
