#pragma once
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "view/scene_camera_internal.hpp"
#include "view/scene_head_internal.hpp"

namespace insonify {

/// A number or name beside an axis: at `place`, from which `outward` (a unit vector) leads away from the box.
struct AxisLabel {
  std::string text;
  Eigen::Vector3d place = Eigen::Vector3d::Zero(), outward = Eigen::Vector3d::UnitX();
  bool is_name = false;  ///< of the axis: belongs beyond its numbers
};

/// Axes of a box: floor and its grid, ticks and labels along the edges that turn to the camera. Relative to scene.origin.
struct SceneAxes {
  std::vector<Polyline> edges, grid, ticks;
  std::vector<AxisLabel> labels;  ///< those of one axis by ascending value, then its name
};

/// Labels are world coordinates [m]. No axis is labelled that the camera looks along.
SceneAxes lay_out_axes(const Eigen::AlignedBox3d& box, const Eigen::Vector3d& scene_origin, const CameraView& view);

/// Where labels stand in the part `frame` of a picture that shows `view`: numbers beside their ticks, names beyond them and
/// as far out as they need to touch nothing. What finds no room inside the frame is left out.
std::vector<PlacedText> place_labels(const std::vector<AxisLabel>& labels, const CameraView& view, const Box& frame,
                                     int font_size);

}  // namespace insonify
