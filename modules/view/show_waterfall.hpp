#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "view/picture.hpp"

namespace insonify {

/// Levels along one beam, ping after ping.
struct PingHistory {
  std::vector<std::int64_t> number;  ///< of the pings, oldest first
  std::vector<double> time;          ///< of their transmission [s]
  RangeGate gate;
  Grid<float> level_db;  ///< pings x bins
  std::string unit;      ///< of the colour bar, as LevelImage::unit
};

/// Draws pings x range as sonar operators see it: one row per ping, the newest on top, so that the past flows down; range
/// to the right; colour bar, title. Rows are of equal height whatever the time between pings, and labelled by the ping's
/// number. Rows and bins smaller than half a pixel are combined by mean power, as in show_fan. See there for files and
/// errors; Error(argument) too for fewer than two pings, or as many numbers, times and rows as do not agree.
void show_waterfall(const PingHistory& history, const PictureOptions& options, const std::string& png_path);

}  // namespace insonify
