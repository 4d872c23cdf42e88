// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <vector>

#include <Eigen/Core>

#include "view/placed_text.hpp"
#include "view/show_scene.hpp"

namespace insonify {

/// A perspective camera, relative to scene.origin [m].
struct CameraView {
  Eigen::Vector3d position = Eigen::Vector3d::Zero(), focal_point = Eigen::Vector3d::UnitX();
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  double view_angle = 0;  ///< full vertical angle [rad]

  Eigen::Vector3d forward() const { return (focal_point - position).normalized(); }
};

/// Returns the points that a picture of a scene should show: up to 20 000 of the surfels, relative to scene.origin.
/// With a head they are within its range gate, unless there are none.
std::vector<Eigen::Vector3d> points_of_interest(const SceneCloud& scene, const SceneLook& look);

/// Returns the camera of a preset, as near as possible with all `points` (not empty) inside the window of width x
/// height pixels, leaving `margin` pixels on every side.
CameraView place_view(const SceneCloud& scene, const SceneLook& look, ScenePreset preset,
                      const std::vector<Eigen::Vector3d>& points, double width, double height, double margin);

/// The image of a point in a window [pixels from its lower left corner] and its distance along the camera's axis [m].
/// Behind the camera distance <= 0 and `at` is undefined.
struct ShownPoint {
  Point2 at;
  double distance = 0;
};
ShownPoint show_point(const CameraView& view, const Eigen::Vector3d& point, double width, double height);

}  // namespace insonify
