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

/// What the viewer is looking at: the pings of a run, or a scene before anything is simulated.
enum class ViewerMode { run, inspect };

/// One sample of a ping.
struct PixelPlace {
  std::size_t beam = 0, bin = 0;
  bool operator==(const PixelPlace&) const = default;
};

/// What can be chosen: every index of a ViewerState stays below these.
struct ViewerExtent {
  std::size_t pings = 0, beams = 0, bins = 0;
};

/// Where the head is, in the numbers of --pose, but in radians: see pose_from_yaw_pitch_roll.
struct HeadPlace {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< [m]
  double yaw = 0, pitch = 0, roll = 0;
};
Pose pose_of(const HeadPlace& head);
/// Inverse of pose_of: yaw and roll in (-pi, pi], pitch in [-pi/2, pi/2]; straight up or down, roll is 0.
HeadPlace head_place(const Pose& pose);
/// "--pose=x,y,z,yaw,pitch,roll" in metres and degrees, to the millimetre and the thousandth of a degree.
std::string pose_option(const HeadPlace& head);

/// A distance being measured on the fan: two clicks.
struct Measure {
  bool active = false;
  std::vector<Eigen::Vector2d> points;  ///< none, one or two, [m] to starboard and forward of the head
  double length() const { return points.size() == 2 ? (points[1] - points[0]).norm() : 0; }
};

/// All that keys and clicks change. Panels are drawn from it and keep no state of their own.
struct ViewerState {
  ViewerMode mode = ViewerMode::run;
  std::size_t ping = 0;
  std::optional<PixelPlace> selected;
  std::optional<std::uint32_t> surfel;  ///< to inspect: the one clicked, by index in the scene

  double gain_db = 0;     ///< brightens: the top of the colour scale is the automatic one less this
  double window_db = 45;  ///< from darkest to brightest
  bool tvg = true;        ///< range compensated levels
  std::string colour_map = "copper";

  bool playing = false;
  double pings_per_second = 4;
  Measure measure;

  SceneColour scene_colour = SceneColour::height;
  double point_size = 1;                                              ///< of a surfel, in units of its spacing
  bool show_help = false, show_colour_bars = true, show_grid = true;  ///< the grid: axes of the scene
  bool show_normals = false;                                          ///< of the scene

  HeadPlace head;       ///< to inspect
  double stride = 0.5;  ///< [m] a key moves the head, and 10 degrees per metre that it turns it
};

/// What the window has to do beside drawing the new state.
enum class ViewerRequest { none, screenshot, print_pose, reset_cameras, quit };

struct KeyAnswer {
  ViewerState state;
  ViewerRequest request = ViewerRequest::none;
};

/// A row of the table of keys: what to press, and what it does.
struct ViewerKey {
  std::string keys, action;
};
/// The table that help shows, in its order.
std::vector<ViewerKey> viewer_keys(ViewerMode mode);
/// The table as text, one row per line.
std::string viewer_help(ViewerMode mode);

/// The state after a key. `key` is its X name ("a", "Left", "bracketleft", "space"), preceded by "shift+" for keys that
/// are no letters or signs. Keys of pcl_viewer do what they do there. Unknown keys change nothing.
KeyAnswer apply_key(ViewerState state, const std::string& key, const ViewerExtent& extent);

/// Selects a sample, or adds a point to the measure if one is being taken; a third point starts anew.
/// Places outside `extent` change nothing. `at` is the same place on the fan [m], starboard and forward.
ViewerState select_pixel(ViewerState state, PixelPlace place, const Eigen::Vector2d& at, const ViewerExtent& extent);

/// The state after `seconds` of playing: the ping that is due; from the last one on to the first.
/// `carried` keeps the part of a ping that is left over.
ViewerState play_on(ViewerState state, double seconds, const ViewerExtent& extent, double& carried);

}  // namespace insonify
