// SPDX-License-Identifier: BSD-3-Clause
#include "tool/image/image.hpp"
#include "tool/run/run_pings.hpp"

namespace insonify::tool {
namespace {

void draw_soundings(const PictureRequest& job) {
  const RunPings run = find_run_pings(job.run.path, "");
  const Ping& ping = job.run.cube.pings[job.ping];
  show_soundings(ping, detect_bottom(ping, bottom_options(job.run.cube, ping, run, 1)), job.picture, job.path);
}

}  // namespace

ViewSpec soundings_view() {
  return {.name = "soundings", .shows = "soundings of the bottom across the track", .draw = draw_soundings};
}

}  // namespace insonify::tool
