// SPDX-License-Identifier: BSD-3-Clause
// Implements the view-dependent functions of SceneActors: camera, axes, picking.
#include <algorithm>
#include <cmath>

#include <vtkCamera.h>
#include <vtkMatrix4x4.h>

#include "core/units.hpp"
#include "view/canvas_internal.hpp"
#include "view/scene_actors_internal.hpp"
#include "view/scene_camera_internal.hpp"
#include "view/scene_lines_internal.hpp"
#include "view/scene_surfels_internal.hpp"

namespace insonify {

Eigen::AlignedBox3d SceneActors::box() const {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& point : interest_) box.extend(point);
  return box;
}

void SceneActors::show_axes(bool on) {
  axes_shown_ = on;
  for (vtkProp* prop : {static_cast<vtkProp*>(floor_), static_cast<vtkProp*>(grid_)}) prop->SetVisibility(on);
  for (const auto& label : labels_) label->SetVisibility(on);
}

std::vector<AxisLabel> SceneActors::turn_axes(vtkRenderer* renderer) {
  show_axes(axes_shown_);
  if (!axes_shown_) return {};
  SceneAxes axes = lay_out_axes(box(), scene_.origin, view(renderer));
  axes.edges.insert(axes.edges.end(), axes.ticks.begin(), axes.ticks.end());
  set_lines(floor_, axes.edges);
  set_lines(grid_, axes.grid);
  return axes.labels;
}

void SceneActors::update_axes(vtkRenderer* renderer) {
  for (const auto& label : labels_) renderer->RemoveActor2D(label);
  labels_.clear();
  const int* size = renderer->GetSize();
  const Box frame{0, static_cast<double>(size[0]), 0, static_cast<double>(size[1])};
  for (const PlacedText& text : place_labels(turn_axes(renderer), view(renderer), frame, font_size_for(options_)))
    renderer->AddActor2D(labels_.emplace_back(text_actor(text, theme(options_.dark), VTK_VIEWPORT)));
}

void SceneActors::place_camera(vtkRenderer* renderer, ScenePreset preset) const {
  const int* size = renderer->GetSize();
  const double narrow = std::min(size[0], size[1]);
  const auto view_of = [&](const std::vector<Eigen::Vector3d>& points, double margin) {
    return place_view(scene_, look_, preset, points, size[0], size[1], margin);
  };
  CameraView view = view_of(interest_, 0.04 * narrow);

  // The view determines which edges carry the axes; the labels are then placed in it.
  if (axes_shown_) {
    std::vector<Eigen::Vector3d> points = interest_;
    double widest = 0;
    const int font = font_size_for(options_);
    for (const AxisLabel& label : lay_out_axes(box(), scene_.origin, view).labels) {
      points.push_back(label.position);
      widest = std::max(widest, text_size(label.text, font).width);
    }
    view = view_of(points, std::min(widest + 1.2 * font, 0.16 * narrow));
  }
  vtkCamera* eye = renderer->GetActiveCamera();
  eye->ParallelProjectionOff();
  eye->SetViewAngle(degrees(view.view_angle));
  eye->SetPosition(view.position.data());
  eye->SetFocalPoint(view.focal_point.data());
  eye->SetViewUp(view.up.data());
  renderer->ResetCameraClippingRange();
}

std::optional<std::uint32_t> SceneActors::surfel_at(vtkRenderer* renderer, double x, double y) const {
  vtkMatrix4x4* clip =
      renderer->GetActiveCamera()->GetCompositeProjectionTransformMatrix(renderer->GetTiledAspectRatio(), -1, 1);
  const Eigen::Matrix4d clip_from_world =
      Eigen::Map<const Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(clip->GetData());
  const double focal_length = 1 / std::tan(radians(renderer->GetActiveCamera()->GetViewAngle()) / 2);
  const PickingWindow window{clip_from_world,
                             {x - renderer->GetOrigin()[0], y - renderer->GetOrigin()[1]},
                             static_cast<double>(renderer->GetSize()[0]),
                             static_cast<double>(renderer->GetSize()[1]),
                             focal_length * mapper_of(still_)->growth};
  return front_surfel(scene_, drawn_, sides_of(surfels_), window);
}

CameraView SceneActors::view(vtkRenderer* renderer) {
  vtkCamera* camera = renderer->GetActiveCamera();
  return {Eigen::Vector3d(camera->GetPosition()), Eigen::Vector3d(camera->GetFocalPoint()),
          Eigen::Vector3d(camera->GetViewUp()), radians(camera->GetViewAngle())};
}

}  // namespace insonify
