#pragma once
#include <string>

#include "tool/image_run.hpp"

namespace insonify::tool {

/// Draws the view that the options name of one ping, into `path`. A waterfall shows all pings.
void draw_view(const ImageRun& run, const ImageOptions& options, const PictureOptions& picture, std::size_t ping,
               const std::string& path);

/// The brightest level that the view would choose for all pings together, so that a series of pictures does not flicker.
double common_max_db(const ImageRun& run, const ImageOptions& options, double window_db);

}  // namespace insonify::tool
