// SPDX-License-Identifier: BSD-3-Clause
#include "tool/image/image.hpp"
#include "view/colour_maps_internal.hpp"

namespace insonify::tool {
namespace {

void draw_ascan(const PictureRequest& job) {
  const std::size_t beam = choose_beam(job.options, fan_of(job)).beam;
  show_ascan(levels_of(job), beam, job.picture, job.path);
}

double max_db_of_ascan(const PictureRequest& job) {
  const LevelImage levels = levels_of(job);
  return next_five(
      levels.level_db.row(static_cast<Eigen::Index>(choose_beam(job.options, levels.fan).beam)).maxCoeff());
}

}  // namespace

ViewSpec ascan_view() {
  return {.name = "ascan",
          .shows = "level of one beam against range",
          .options = {animate_option},
          .draw = draw_ascan,
          .max_db = max_db_of_ascan};
}

}  // namespace insonify::tool
