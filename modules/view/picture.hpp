// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "core/grid.hpp"
#include "core/pose.hpp"
#include "returns/ping.hpp"
#include "sonar/beam_fan.hpp"
#include "sonar/range_gate.hpp"

namespace insonify {

/// Levels of one ping for drawing.
struct LevelImage {
  BeamFan fan;
  RangeGate gate;
  Grid<float> level_db;    ///< beams x bins
  std::string unit;        ///< unit of the colour bar, e.g. "dB re 1 µPa" or "dB re 1 µPa, range compensated"
  bool downwards = false;  ///< true: the head looks down, as for a swath; the fan is drawn with the head at the top
};

/// Returns true if a head looks down by more than 45 degrees; for a scanning head, at its scan angle zero.
inline bool looks_down(const Pose& world_from_head, const std::optional<ScanDirection>& scan) {
  const double turn = scan ? scan->angle : 0;
  return (world_from_head.linear() * Eigen::Vector3d(std::cos(turn), -std::sin(turn), 0)).z() < -0.7072;
}

/// A position in a picture, marked with a ring and, if there is room, its name.
struct Mark {
  double bearing = 0;  ///< [rad], positive to starboard
  double range = 0;    ///< [m]
  std::string text;
};

/// The default colour map of levels.
inline constexpr const char* default_colour_map = "bronze";

/// Size and style of a picture.
struct PictureOptions {
  int width = 1400, height = 1050;  ///< [pixels]
  std::string title;
  std::string colour_map = default_colour_map;               ///< one of colour_map_names()
  double min_db = std::numeric_limits<double>::quiet_NaN();  ///< NaN: max_db - window_db
  double max_db = std::numeric_limits<double>::quiet_NaN();  ///< NaN: 99.9 % quantile of the levels above the
                                                             ///< lowest, rounded up to 5
  double window_db = 45;
  bool dark = false;          ///< true: dark background
  bool trim = false;          ///< true: show_fan cuts off the width or height that fan and labels do not need
  int font_size = 0;          ///< size of ordinary text [pixels]; 0: chosen from the picture size
  std::vector<Mark> marks{};  ///< marks in show_fan, show_rect and show_panels; those outside the image are omitted
};

/// Returns the names accepted as colour_map.
std::vector<std::string> colour_map_names();

}  // namespace insonify
