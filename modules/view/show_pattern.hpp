#pragma once
#include <string>
#include <vector>

#include "view/picture.hpp"

namespace insonify {

/// Draws the level of a beam [dB re its peak] against bearing in degrees, positive to starboard, as a chart. `azimuth`
/// [rad] in head axes (positive to port), monotonic; levels of -inf (nulls) are not drawn. min_db and max_db limit the
/// level axis; defaults are -60 and 0. Files as show_fan; Error(argument) unless there are at least two points, as many
/// levels as azimuths, all azimuths finite, no level NaN, and max_db > min_db.
void show_pattern(const std::vector<double>& azimuth, const std::vector<double>& level_db,
                  const PictureOptions& options, const std::string& png_path);

}  // namespace insonify
