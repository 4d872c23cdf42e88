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

/// Draws pings x range as a waterfall: one row per ping, the newest on top; range to the right; colour bar, title. Rows
/// have equal height whatever the time between pings and are labelled by ping number. Rows and bins smaller than half a
/// pixel are averaged in power, as in show_fan. Files and errors as show_fan; also Error(argument) for fewer than two
/// pings, or if numbers, times and rows are not equally many.
void show_waterfall(const PingHistory& history, const PictureOptions& options, const std::string& png_path);

}  // namespace insonify
