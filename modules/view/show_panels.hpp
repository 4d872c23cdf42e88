#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "view/picture.hpp"

namespace insonify {

/// A fact about a ping, e.g. "Pose", "0, 0, -3 m".
struct Fact {
  std::string name, value;
};

/// The contents of a summary picture of one ping.
struct Panels {
  LevelImage image;
  std::size_t beam = 0;                     ///< of the A-scan
  std::vector<double> azimuth, pattern_db;  ///< beam pattern, as for show_pattern; empty: unknown
  std::string pattern_title;
  std::vector<Fact> facts;
};

/// Draws the fan, the A-scan of one beam, its pattern (or, if unknown, beams x range as show_rect) and a table of facts
/// into one picture with the title on top; marks are drawn on the fan. Files and errors as show_fan, show_ascan and
/// show_pattern; also Error(argument) for a picture smaller than 640 x 480.
void show_panels(const Panels& panels, const PictureOptions& options, const std::string& png_path);

}  // namespace insonify
