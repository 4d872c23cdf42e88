#pragma once
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "view/scene_camera_internal.hpp"
#include "view/scene_head_internal.hpp"

namespace insonify {

/// A number or name beside an axis, at `place`; `outward` is a unit vector away from the box.
struct AxisLabel {
  std::string text;
  Eigen::Vector3d place = Eigen::Vector3d::Zero(), outward = Eigen::Vector3d::UnitX();
  bool is_name = false;  ///< name of the axis, placed beyond its numbers
};

/// Axes of a box: floor grid, ticks and labels along the edges facing the camera. Relative to scene.origin.
struct SceneAxes {
  std::vector<Polyline> edges, grid, ticks;
  std::vector<AxisLabel> labels;  ///< of one axis by ascending value, then its name
};

/// The axes of a box as seen in `view`. Labels are world coordinates [m]. An axis along the line of sight gets no
/// labels.
SceneAxes lay_out_axes(const Eigen::AlignedBox3d& box, const Eigen::Vector3d& scene_origin, const CameraView& view);

/// Places labels in the part `frame` of a picture that shows `view`: numbers beside their ticks, names beyond them, far
/// enough out to overlap nothing. Labels that do not fit inside the frame are omitted.
std::vector<PlacedText> place_labels(const std::vector<AxisLabel>& labels, const CameraView& view, const Box& frame,
                                     int font_size);

}  // namespace insonify
