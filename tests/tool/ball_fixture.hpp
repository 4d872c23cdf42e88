// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "core/geodesy.hpp"
#include "formats/las_decoder.hpp"
#include "scene_io/save_cloud.hpp"
#include "support/scenes.hpp"
#include "tool/tool_runner.hpp"

// The fan of a head that looks 30 degrees ahead of straight down, turned 20 degrees to port; the ball in beam 44.
inline constexpr double yaw_deg = 20, pitch_deg = 60, beam_deg = 24, ball_range = 12, ball_radius = 0.3;
inline const Anchor ball_anchor{54.1, 7.9, 90};  // x east, y north

inline Pose head_above(const Eigen::Vector3d& ball) {
  Pose pose = pose_from_yaw_pitch_roll({0, 0, 0}, radians(yaw_deg), radians(pitch_deg), 0);
  pose.translation() = ball - ball_range * (pose.linear() * unit_vector({radians(beam_deg), 0}));
  return pose;
}

class ExportProducts : public ToolTest {
 protected:
  const Pose pose = head_above({3, 4, -15});

  void SetUp() override {
    SceneCloud scene;
    add_sphere(scene, {3, 4, -15}, ball_radius, 4000);
    save_scene(path("ball.ply"), scene);
    const Eigen::Vector3d at = pose.translation();
    std::ostringstream command;
    command.precision(12);
    command << "ping ball.ply --sonar r2sonic-2024 --mount=0,0,0,0,0,0 --set sonar.beams=65 --range 8:14 --split "
               "--noise --no-picture -q "
               "--pose="
            << at.x() << ',' << at.y() << ',' << at.z() << ',' << yaw_deg << ',' << pitch_deg << ",0 -o out";
    succeed(command.str());
  }
  std::string read_bytes(const std::string& name) const { return file_bytes(path(name)); }

  /// The strongest point of a LAS file, in UTM.
  Eigen::Vector3d strongest_point(const std::string& name) const {
    const std::vector<decode::LasRow> rows = decode::read_las(read_bytes(name));
    const auto best = std::max_element(rows.begin(), rows.end(),
                                       [](const auto& a, const auto& b) { return a.level_db < b.level_db; });
    return {best->position[0], best->position[1], best->position[2]};
  }
  /// A position in zone 32N in the world.
  static Eigen::Vector3d in_world(const Eigen::Vector3d& utm) {
    const Eigen::Vector3d world =
        world_from_geo(ball_anchor, geo_position_of(UtmPosition{utm.x(), utm.y()}, {32, true}));
    return {world.x(), world.y(), utm.z()};
  }

  /// The beam's sounding, at the front of the ball within half a range resolution or somewhat behind.
  static constexpr double least = ball_range - ball_radius - 0.006, most = ball_range - ball_radius + 0.25;
};
