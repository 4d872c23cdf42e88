#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <vtkRenderer.h>

#include "view/scene_colours_internal.hpp"
#include "view/scene_lines_internal.hpp"
#include "view/show_scene.hpp"

namespace insonify {

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
  ~SceneActors();
  SceneActors(const SceneActors&) = delete;
  SceneActors& operator=(const SceneActors&) = delete;

  /// Adds all actors to a renderer.
  void add_to(vtkRenderer* renderer);

  /// Recolours the surfels. Throws as show_scene if the data of that colour are missing.
  void set_colour(SceneColour colour);
  void set_visibility(std::vector<Visibility> visibility);  ///< per surfel; recolours if shown
  void set_level_range(double min_db, double max_db);       ///< of the level colours; NaN: automatic
  void set_colour_map(const std::string& name);             ///< of the level colours

  void highlight(std::span<const std::uint32_t> surfels);       ///< replaces the highlighted surfels
  void show_soundings(const Soundings& soundings);              ///< replaces the soundings; empty: none
  void show_holes(const std::vector<Eigen::Vector3d>& places);  ///< world [m]; replaces the holes
  void show_normals(bool on);
  void show_head(const Pose& world_from_head, const BeamFan& fan, const RangeGate& gate);

  void set_detail(SceneDetail detail);
  void set_point_size(double point_size);  ///< as SceneLook::point_size
  double point_size() const;

  /// Updates edges, ticks and labels of the axes, on the far side from the camera; call it after the camera has moved.
  void update_axes(vtkRenderer* renderer);
  /// The same, but returns the labels for the caller to place.
  std::vector<AxisLabel> turn_axes(vtkRenderer* renderer);
  void show_axes(bool on);

  /// Sets the renderer's camera, fitted to the renderer's aspect ratio, and its clipping range.
  void place_camera(vtkRenderer* renderer, const SceneCamera& camera) const;

  /// The renderer's camera.
  static CameraView view(vtkRenderer* renderer);

  /// The frontmost surfel within two pixels of a place in the window [pixels from its lower left corner], if any. Only
  /// surfels drawn at `still` detail are found.
  std::optional<std::uint32_t> surfel_at(vtkRenderer* renderer, double x, double y) const;

  const SceneLook& look() const;
  const SceneKey& key() const;                    ///< for the surfels' colours
  std::optional<SceneKey> soundings_key() const;  ///< for the soundings, if their colours differ

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace insonify
