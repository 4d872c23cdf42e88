// SPDX-License-Identifier: BSD-3-Clause
// Scenes on which drawn display cells are compared with samples, each with a pose of the head.
#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <string>

#include "acoustics/environment.hpp"
#include "core/random.hpp"
#include "core/units.hpp"
#include "scene/built_in_scenes.hpp"

namespace insonify {

/// A scene with the pose of a head.
struct View {
  std::string scene;
  double x, z, pitch_deg;
  std::size_t points = 300000;
  Pose pose(double ahead = 0, double aside = 0, double turned_deg = 0) const {
    return pose_from_yaw_pitch_roll({x + ahead, aside, z}, radians(turned_deg), radians(pitch_deg), radians(4));
  }
};
inline const View views[] = {{"harbour", 0, -2, 15},
                             {"reef", -1, -1.5, 25},
                             {"room", -3, 1.6, 10},
                             {"river", 0, -2, 25},
                             {"sphere on a plane", 0, 1.5, 12},
                             {"wall", 0, 0, 0},
                             {"reef in a tank", -1, -1.5, 25},
                             {"two facets on a plane", 0, 1.5, 12},
                             {"plane", -5, 2.5, 20},
                             {"sphere", 0, 0.3, 3}};
/// The first of them, which tables compare by sonar.
inline std::span<const View> compared_views() { return std::span(views).first(8); }
inline const View& view_of(std::string_view scene) {
  return *std::find_if(std::begin(views), std::end(views), [&](const View& v) { return v.scene == scene; });
}

/// Adds surfels of a rectangle, one in each cell of a grid, at a random position in it.
inline void add_rectangle(SceneCloud& scene, const Eigen::Vector3d& corner, const Eigen::Vector3d& a,
                          const Eigen::Vector3d& b, double spacing) {
  const Eigen::Vector3d normal = a.cross(b).normalized();
  const auto rows = static_cast<std::uint64_t>(std::ceil(a.norm() / spacing)),
             columns = static_cast<std::uint64_t>(std::ceil(b.norm() / spacing));
  const double cells = static_cast<double>(rows * columns);
  for (std::uint64_t i = 0; i < rows * columns; ++i) {
    const auto at = random_uniform(1, RandomStage::scene_points, {scene.size(), 0, 0});
    const double along = (static_cast<double>(i / columns) + at[0]) / static_cast<double>(rows),
                 across = (static_cast<double>(i % columns) + at[1]) / static_cast<double>(columns);
    add_surfel(scene, corner + along * a + across * b, normal, a.norm() * b.norm() / cells);
  }
}

/// The inside of a room of 8 x 6 x 3 m with a chest in it.
inline SceneCloud room() {
  SceneCloud scene = empty_built_in_scene("plane");
  const Eigen::Vector3d x(1, 0, 0), y(0, 1, 0), z(0, 0, 1), low(-4, -3, 0), high(4, 3, 3), chest(1, -0.5, 0);
  const double spacing = 0.025;
  add_rectangle(scene, low, 8 * x, 6 * y, spacing);
  add_rectangle(scene, low, 6 * y, 3 * z, spacing);
  add_rectangle(scene, low, 3 * z, 8 * x, spacing);
  add_rectangle(scene, high, -6 * y, -8 * x, spacing);
  add_rectangle(scene, high, -3 * z, -6 * y, spacing);
  add_rectangle(scene, high, -8 * x, -3 * z, spacing);
  add_rectangle(scene, chest, z, y, spacing);
  add_rectangle(scene, chest + z, x, y, spacing);
  return scene;
}

/// A plane of sand with a sphere on it, or with two facets a hundred times as bright, both in one cell.
inline SceneCloud on_plane(bool sphere) {
  SceneCloud scene = empty_built_in_scene("plane");
  add_rectangle(scene, {2, -4, 0}, {8, 0, 0}, {0, 8, 0}, 0.015);
  if (sphere) {
    const SceneCloud ball = make_built_in_scene("sphere", {.points = 20000});
    for (std::size_t i = 0; i < ball.size(); ++i)
      add_surfel(scene, ball.origin + ball.point[i].cast<double>() + Eigen::Vector3d(0, 0, 0.5),
                 ball.normal[i].cast<double>(), ball.area[i]);
  } else {
    scene.materials.push_back(scene.materials[0]);
    scene.materials[1].lambert_mu *= 100;
    for (const double x : {5.0, 5.02})
      add_surfel(scene, {x, 0, 0.05}, Eigen::Vector3d(-1, 0, 0.3).normalized(), 0.0025, 1);
  }
  return scene;
}

inline SceneCloud scene_of(const View& view, std::size_t points) {
  if (view.scene == "room") return room();
  if (view.scene == "sphere on a plane" || view.scene == "two facets on a plane")
    return on_plane(view.scene == "sphere on a plane");
  return make_built_in_scene(view.scene == "reef in a tank" ? "reef" : view.scene, {.points = points});
}

/// Flat walls around the reef, which reflect.
inline Environment tank() {
  Environment environment;
  environment.tank = Tank{{12, 12, 6}, {-4, -6, -6}, 0.7};
  return environment;
}

}  // namespace insonify
