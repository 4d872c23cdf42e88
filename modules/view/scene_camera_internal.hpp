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
  double view_angle = 0;  ///< [rad], full and upright

  Eigen::Vector3d forward() const { return (focal_point - position).normalized(); }
};

/// What a picture of a scene should hold: up to 20 000 of the surfels, relative to scene.origin. With a head, those in
/// its range, or all if there are none.
std::vector<Eigen::Vector3d> points_of_interest(const SceneCloud& scene, const SceneLook& look);

/// The camera asked for. A preset stands as near as it can with all `points` (not empty) in the window of so many
/// pixels, `margin` of which stay free on every side. Throws Error(argument) if a camera is given by half, is not finite
/// or looks nowhere.
CameraView place_view(const SceneCloud& scene, const SceneLook& look, const SceneCamera& camera,
                      const std::vector<Eigen::Vector3d>& points, double width, double height, double margin,
                      const char* who);

/// Where a camera shows a point in a window [pixels from its lower left corner], and how far along its axis it is [m];
/// behind the camera: distance <= 0, and the place means nothing.
struct ShownPoint {
  Point2 at;
  double distance = 0;
};
ShownPoint show_point(const CameraView& view, const Eigen::Vector3d& point, double width, double height);

}  // namespace insonify
