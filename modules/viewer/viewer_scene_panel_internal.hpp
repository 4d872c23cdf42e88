// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <memory>
#include <optional>
#include <vector>

#include "view/scene_actors_internal.hpp"
#include "viewer/viewer_data.hpp"
#include "viewer/viewer_explain.hpp"
#include "viewer/viewer_panel_internal.hpp"

namespace insonify {

/// The 3-D panel: the scene, or, without one, the returns; the head, the returns of the ping, and the selection.
class ViewerScene {
 public:
  /// Keeps references: `data` and `panel` must outlive it.
  ViewerScene(const ViewerData& data, ViewerPanel& panel, const ViewerState& state, const PictureOptions& options);

  /// Updates the panel to a state. `view` is the visibility from the head, or null. `max_db` is the brightest level of
  /// the returns, which are always range compensated so that near and far ones are comparable.
  void update(const ViewerState& state, const HeadView* view, double max_db);
  void highlight(const std::vector<std::uint32_t>& surfels);
  /// Draws title, legend and colour bars on an emptied upper layer; legend and bars beside the scene, which fills the
  /// first `scene_width` pixels.
  void draw_key(const PictureOptions& options, double scene_width, const ViewerState& state);
  void reset_camera();
  void set_moving(bool moving);
  void follow_camera();  ///< call before drawing if the camera has moved
  /// Returns the surfel of the scene of the ping, or the world position, at a position in the window.
  std::optional<std::uint32_t> surfel_at(Point2 position) const;
  std::optional<Eigen::Vector3d> world_at(Point2 position) const;

  /// Returns the position in the window where a point of the world is drawn [pixels].
  Point2 pixel_of(const Eigen::Vector3d& world) const;

  static bool has_content(const ViewerData& data) { return has_scene(data) || data.returns.size() > 0; }

 private:
  const SceneCloud& shown() const { return *scene_; }
  void change_scene(const ViewerState& state);
  void move_camera(const Eigen::Vector3d& by);
  SceneHead head_of(const ViewerState& state) const;
  void follow_head(const ViewerState& state);

  const ViewerData& data_;
  ViewerPanel& panel_;
  bool own_ = false;                         ///< true: the scene shown is made from the returns
  std::shared_ptr<const SceneCloud> scene_;  ///< scene shown; the actors refer to it
  std::unique_ptr<SceneActors> actors_;
  PictureOptions options_;
  ViewerState drawn_;
  bool has_visibility_ = false;
};

}  // namespace insonify
