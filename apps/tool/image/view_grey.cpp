// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "tool/image/image.hpp"

namespace insonify::tool {
namespace {

/// Draws the samples as grey values: white at the brightest level, black at the end of the window.
void draw_grey(const PictureRequest& job) {
  const LevelImage levels = levels_of(job);
  const PictureOptions& picture = job.picture;
  const double max_db = std::isnan(picture.max_db) ? levels.level_db.maxCoeff() : picture.max_db;
  const GreyWindow window{max_db - picture.window_db, max_db};
  if (job.options.bits == 8)
    show_grey(quantise_8(levels.level_db, window), levels.fan, job.path);
  else
    show_grey(quantise_16(levels.level_db, window), levels.fan, job.path);
}

}  // namespace

ViewSpec grey_view() {
  return {.name = "grey", .shows = "the bare samples as 8- or 16-bit .png or .pgm", .draw = draw_grey};
}

}  // namespace insonify::tool
