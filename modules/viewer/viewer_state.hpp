// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/pose.hpp"
#include "view/show_scene.hpp"

namespace insonify {

/// Mode of the viewer: the pings of a run, or a scene before a ping is simulated.
enum class ViewerMode { run, inspect };

/// One sample of a ping.
struct PixelPosition {
  std::size_t beam = 0, bin = 0;
  bool operator==(const PixelPosition&) const = default;
};

/// Extent of the data: every index of a ViewerState is below these.
struct ViewerExtent {
  std::size_t pings = 0, beams = 0, bins = 0;
};

/// Returns "--pose=x,y,z,yaw,pitch,roll" in metres and degrees, rounded to a millimetre and a thousandth of a degree.
std::string pose_option(const PoseAngles& head);

/// A distance measured on the fan by two clicks.
struct Measure {
  bool active = false;
  std::vector<Eigen::Vector2d> points;  ///< none, one or two, [m] to starboard and forward of the head
  /// Returns the distance [m]; 0 unless there are two points.
  double length() const { return points.size() == 2 ? (points[1] - points[0]).norm() : 0; }
};

/// Everything that keys and clicks change. Panels are drawn from it and keep no state of their own.
struct ViewerState {
  ViewerMode mode = ViewerMode::run;
  std::size_t ping = 0;
  std::optional<PixelPosition> selected;
  std::optional<std::uint32_t> surfel;  ///< inspection: the clicked surfel, by index in the scene

  double gain_db = 0;     ///< brightness: subtracted from the automatic top of the colour scale
  double window_db = 45;  ///< range of levels from darkest to brightest
  bool tvg = true;        ///< true: range compensated levels
  std::string colour_map = default_colour_map;

  bool playing = false;
  double pings_per_second = 4;
  Measure measure;

  SceneColour scene_colour = SceneColour::height;
  double point_size = 1;                                              ///< side of a surfel in units of its spacing
  bool show_help = false, show_colour_bars = true, show_grid = true;  ///< the grid: axes of the scene
  bool show_normals = false;                                          ///< true: draws the normals of the scene
  bool follow = false;                                                ///< true: the scene's camera follows the head
  bool accumulate = false;  ///< true: the scene shows the returns of all pings up to this one

  PoseAngles head;      ///< pose of the head to inspect
  double stride = 0.5;  ///< step of the head per key [m]; turns are 10 degrees per metre of it
};

/// Action of the window in addition to drawing the new state.
enum class ViewerRequest { none, screenshot, print_pose, reset_cameras, quit };

/// Result of a key press.
struct KeyAnswer {
  ViewerState state;
  ViewerRequest request = ViewerRequest::none;
};

/// A key with a button, and its effect on the state or its request to the window.
struct ViewerButton {
  std::string key;                                                ///< name for apply_key
  void (*press)(ViewerState& state, const ViewerExtent& extent);  ///< changes the state
  std::vector<std::string> also{};                                ///< other keys that do the same
  ViewerRequest request = ViewerRequest::none;
};
/// A row of the table of keys. The table is the source of help, buttons and apply_key. A row without buttons describes
/// the mouse.
struct ViewerKey {
  std::string action;
  std::vector<ViewerButton> buttons;
  std::string mouse{};  ///< action of the mouse, in a row without buttons
};
/// Returns the label of a key, e.g. "[" for "bracketleft".
std::string key_label(const std::string& key);
/// Returns the table of a mode.
std::vector<ViewerKey> viewer_keys(ViewerMode mode);
/// Returns the table as text, one row per line.
std::string viewer_help(ViewerMode mode);

/// Returns the state after a key press. `key` is its X name ("a", "Left", "bracketleft", "space"), preceded by "shift+"
/// for keys other than characters. Keys of pcl_viewer have the same meaning as there. Unknown keys change nothing.
KeyAnswer apply_key(ViewerState state, const std::string& key, const ViewerExtent& extent);

/// Returns the state after a click on a sample. The click selects the sample, or adds a point to an active measurement.
/// The second point ends the measurement; its length stays until the next measurement or Escape. Samples outside
/// `extent` change nothing. `at` is the same position on the fan [m], starboard and forward.
ViewerState select_pixel(ViewerState state, PixelPosition position, const Eigen::Vector2d& at,
                         const ViewerExtent& extent);

/// Returns the state after a click on a waterfall or a sweep: goes to a ping and selects its sample; playing stops.
/// Samples outside `extent` change nothing.
ViewerState select_ping(ViewerState state, std::size_t ping, PixelPosition position, const ViewerExtent& extent);

/// Returns the state after `seconds` of playing, with the ping that is due; the first ping follows the last.
/// `carried` holds the remaining fraction of a ping between calls.
ViewerState play_on(ViewerState state, double seconds, const ViewerExtent& extent, double& carried);

}  // namespace insonify
