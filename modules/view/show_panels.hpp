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

/// What one picture tells about one ping.
struct Panels {
  LevelImage image;
  std::size_t beam = 0;                     ///< of the A-scan
  std::vector<double> azimuth, pattern_db;  ///< of the beam's pattern, as show_pattern takes them; empty: none known
  std::string pattern_title;
  std::vector<Fact> facts;
};

/// Draws the fan, the A-scan of one beam, its pattern (or, if none is known, beams x range as show_rect does) and a table
/// of facts into one picture. The title stands above all of it; marks are drawn on the fan. See show_fan, show_ascan and
/// show_pattern for files and errors; Error(argument) too for a picture smaller than 640 x 480.
void show_panels(const Panels& panels, const PictureOptions& options, const std::string& png_path);

}  // namespace insonify
