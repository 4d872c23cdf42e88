#pragma once
#include <array>
#include <utility>
#include <vector>

#include <Eigen/Geometry>
#include <vtkActor.h>
#include <vtkSmartPointer.h>
#include <vtkTextActor.h>

#include "view/fan_layout_internal.hpp"
#include "view/scene_actors_internal.hpp"
#include "view/scene_camera_internal.hpp"
#include "view/scene_points_internal.hpp"

namespace insonify {

constexpr Rgb hole_rgb = {222, 45, 38};

/// The data of SceneActors.
struct SceneActors::Parts {
  Parts(const SceneCloud& cloud, SceneLook wanted, const PictureOptions& picture, const char* name)
      : scene(cloud), look(std::move(wanted)), options(picture), who(name) {}

  const SceneCloud& scene;
  SceneLook look;
  PictureOptions options;
  const char* who;
  SceneKey key;
  std::vector<Eigen::Vector3d> interest;  // framed by the camera

  // Surfels; both levels of detail share their arrays.
  PointCloudArrays surfels;
  std::vector<std::uint32_t> drawn;  // at detail `still`
  std::size_t moving_drawn = 0;
  vtkSmartPointer<vtkActor> still, moving, footprint, marks;

  std::vector<Eigen::Vector3f> sounding_places;
  PointCloudArrays sounding_arrays;
  vtkSmartPointer<vtkActor> soundings;
  std::vector<Eigen::Vector3f> hole_places;
  PointCloudArrays hole_arrays;
  vtkSmartPointer<vtkActor> holes, normals;

  vtkSmartPointer<vtkActor> outline, arcs, beams, body, floor, grid;
  std::array<vtkSmartPointer<vtkActor>, 3> head_axes;
  std::vector<vtkSmartPointer<vtkTextActor>> labels;
  bool axes_shown = true;

  std::vector<vtkActor*> actors() const {
    return {still.Get(),   moving.Get(),       footprint.Get(),    marks.Get(),       soundings.Get(), outline.Get(),
            arcs.Get(),    beams.Get(),        body.Get(),         floor.Get(),       grid.Get(),      holes.Get(),
            normals.Get(), head_axes[0].Get(), head_axes[1].Get(), head_axes[2].Get()};
  }
  double thin() const { return line_width_for(font_size_for(options)); }
  Eigen::AlignedBox3d box() const;  // of `interest` and of the axes

  void make_surfels();
  void make_lines();
  void make_marks();  // holes and normals
  void colour();
  void grow();
  void look_again() { interest = points_of_interest(scene, look); }
};

}  // namespace insonify
