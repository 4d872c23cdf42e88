// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <vtkActor.h>
#include <vtkRenderer.h>
#include <vtkSmartPointer.h>
#include <vtkTextActor.h>

#include "view/fan_layout_internal.hpp"
#include "view/scene_camera_internal.hpp"
#include "view/scene_colours_internal.hpp"
#include "view/scene_lines_internal.hpp"
#include "view/scene_points_internal.hpp"
#include "view/show_scene.hpp"

namespace insonify {

constexpr Rgb hole_rgb = {222, 45, 38};

/// Level of detail. A subset of the surfels is chosen by their ids alone and drawn larger to close the gaps.
enum class SceneDetail {
  still,  ///< at most SceneLook::most_surfels
  moving  ///< at most 200 000, while the user turns the scene
};

/// A scene in a VTK renderer, built once and changed in place. Positions in the renderer are relative to scene.origin
/// (world position = origin + renderer position). The scene is not copied: it must outlive the actors and not move.
/// No function renders; the owner of the window does. Not thread-safe.
class SceneActors {
 public:
  /// Throws as show_scene for an unusable look. `who` names the caller in errors.
  SceneActors(const SceneCloud& scene, SceneLook look, const PictureOptions& options, const char* who);
  SceneActors(const SceneActors&) = delete;
  SceneActors& operator=(const SceneActors&) = delete;

  /// Adds all actors to a renderer, or removes them.
  void add_to(vtkRenderer* renderer);
  void remove_from(vtkRenderer* renderer);

  /// Recolours the surfels. Throws as show_scene if the data of that colour are missing.
  void set_colour(SceneColour colour);
  void set_visibility(std::vector<Visibility> visibility);  ///< per surfel; recolours if shown
  void set_level_range(double min_db, double max_db);       ///< range of the level colours; NaN: automatic
  void set_colour_map(const std::string& name);             ///< colour map of the level colours

  void highlight(std::span<const std::uint32_t> surfels);          ///< replaces the highlighted surfels
  void show_soundings(const Soundings& soundings);                 ///< replaces the soundings; empty: none
  void show_holes(const std::vector<Eigen::Vector3d>& positions);  ///< world [m]; replaces the holes
  void show_normals(bool on);
  void show_head(const Pose& world_from_head, const BeamFan& fan, const RangeGate& gate);

  void set_detail(SceneDetail detail);
  void set_point_size(double point_size);  ///< see SceneLook::point_size
  double point_size() const { return look_.point_size; }

  /// Updates edges, ticks and labels of the axes, on the far side from the camera; call it after the camera has moved.
  void update_axes(vtkRenderer* renderer);
  /// Does the same, but returns the labels for the caller to place.
  std::vector<AxisLabel> turn_axes(vtkRenderer* renderer);
  void show_axes(bool on);

  /// Sets the renderer's camera, fitted to the renderer's aspect ratio, and its clipping range.
  void place_camera(vtkRenderer* renderer, ScenePreset preset) const;

  /// Returns the renderer's camera.
  static CameraView view(vtkRenderer* renderer);

  /// Returns the frontmost surfel within two pixels of a position in the window [pixels from its lower left corner], if
  /// any. Only surfels drawn at `still` detail are found.
  std::optional<std::uint32_t> surfel_at(vtkRenderer* renderer, double x, double y) const;

  const SceneLook& look() const { return look_; }
  const SceneKey& key() const { return key_; }    ///< for the surfels' colours
  std::optional<SceneKey> soundings_key() const;  ///< for the soundings, if their colours differ
  std::vector<LegendEntry> line_key() const;      ///< for the lines of head and track

 private:
  const SceneCloud& scene_;
  SceneLook look_;
  PictureOptions options_;
  const char* who_;
  SceneKey key_;
  std::vector<Eigen::Vector3d> interest_;  // framed by the camera

  // Arrays of the surfels, shared by both levels of detail.
  PointCloudArrays surfels_;
  std::vector<std::uint32_t> drawn_;  // surfels drawn at detail `still`
  std::size_t moving_drawn_ = 0;
  vtkSmartPointer<vtkActor> still_, moving_, footprint_, marks_;

  std::vector<Eigen::Vector3f> sounding_positions_;
  PointCloudArrays sounding_arrays_;
  vtkSmartPointer<vtkActor> soundings_;
  std::vector<Eigen::Vector3f> hole_positions_;
  PointCloudArrays hole_arrays_;
  vtkSmartPointer<vtkActor> holes_, normals_;

  vtkSmartPointer<vtkActor> outline_, arcs_, beams_, body_, floor_, grid_, track_;
  std::array<vtkSmartPointer<vtkActor>, 3> head_axes_;
  std::vector<vtkSmartPointer<vtkTextActor>> labels_;
  bool axes_shown_ = true;

  std::vector<vtkActor*> actors() const {
    return {still_.Get(),   moving_.Get(), footprint_.Get(),    marks_.Get(),        soundings_.Get(),   outline_.Get(),
            arcs_.Get(),    beams_.Get(),  body_.Get(),         floor_.Get(),        grid_.Get(),        holes_.Get(),
            normals_.Get(), track_.Get(),  head_axes_[0].Get(), head_axes_[1].Get(), head_axes_[2].Get()};
  }
  double thin() const { return line_width_for(font_size_for(options_)); }
  Eigen::AlignedBox3d box() const;  // box of `interest` and of the axes

  void make_surfels();
  void make_lines();
  void make_marks();  // holes and normals
  void recolour();
  void grow();
  void look_again() { interest_ = points_of_interest(scene_, look_); }
};

}  // namespace insonify
