// SPDX-License-Identifier: BSD-3-Clause
#include "formats/grey_fan.hpp"

#include "core/error.hpp"
#include "returns/fan_areas.hpp"
#include "returns/looks.hpp"
#include "returns/picture_grid.hpp"

namespace insonify {

void require_one_row(const Ping& ping, const char* who) {
  if (fan_rows(ping.fan).size() > 1)
    fail(ErrorKind::content, who, ": ping ", ping.number, " has several rows of beams, must have one");
}

GreyFan grey_fan(const Ping& ping, const Tvg& tvg, const GreyWindow& window, int rows) {
  require_one_row(ping, "grey_fan");
  const Grid<float> level = apply_tvg(shown_level_db(ping), ping.gate, tvg);
  const FanRaster raster = fan_raster_from_head(ping.fan, ping.gate, rows);
  return {quantise_8(fan_levels(level, ping.fan, ping.gate, raster), window), raster.metres_per_pixel};
}

}  // namespace insonify
