// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "core/error.hpp"
#include "tool/image/image.hpp"
#include "view/ping_record.hpp"

namespace insonify::tool {
namespace {

/// Throws Error(content) for a history of far too many cells if it shows all ranges from the head on.
void require_room_from_head(const std::string& path, const PingHistory& history) {
  constexpr double always = 0x1p24, most_growth = 16;
  const double bins = history.gate.max_range / history.gate.bin_size;
  const double cells = bins * static_cast<double>(history.level_db.rows());
  const double most = std::max(always, most_growth * static_cast<double>(history.level_db.size()));
  if (!(cells <= most))
    fail(ErrorKind::content, path, ": a picture from the head to ", history.gate.max_range, " m has ", cells,
         " cells of ", history.gate.bin_size, " m, must have at most ", most,
         "; its samples begin too far away: draw one beam by slant range");
}

/// One head by slant range, or by ground range if the options give an altitude.
PingHistory history_of(const ImageRun& run, const ImageOptions& o) {
  const PingHistory slant = beam_history(run, o);
  const std::vector<double> altitude = altitudes_of(run, o);
  if (altitude.empty()) return slant;
  require_room_from_head(run.path, slant);
  return on_flat_bottom(slant, altitude);
}

/// The first channels to port and to starboard of a recording; nothing if it lacks one.
std::optional<std::pair<std::size_t, std::size_t>> channels_of_sides(const BeamFan& fan) {
  const auto first = [&](auto looks) {
    return static_cast<std::size_t>(std::find_if(fan.azimuth.begin(), fan.azimuth.end(), looks) - fan.azimuth.begin());
  };
  const std::size_t port = first([](double azimuth) { return azimuth > 0; });
  const std::size_t starboard = first([](double azimuth) { return azimuth < 0; });
  if (port == fan.beams() || starboard == fan.beams()) return {};
  return std::pair(port, starboard);
}

PingHistory history_of_channel(const ImageRun& run, ImageOptions o, std::size_t channel) {
  o.beam = std::to_string(channel);
  return history_of(run, o);
}

}  // namespace

PingHistory beam_history(const ImageRun& run, const ImageOptions& o) {
  std::vector<std::size_t> all(run.cube.pings.size());
  if (all.size() < 2)
    fail(ErrorKind::content, run.path, ": holds one ping, a waterfall needs several; join runs with insonify merge");
  std::iota(all.begin(), all.end(), 0);
  return history_of(beam_record(run, o, all));
}

std::vector<double> altitudes_of(const ImageRun& run, const ImageOptions& o) {
  const bool by_pose = !o.bottom.empty();
  if (!by_pose && o.altitude.empty()) return {};
  const double given = by_pose ? parse_number("--bottom", o.bottom) : parse_number("--altitude", o.altitude);
  std::vector<double> altitudes;
  for (const Ping& ping : run.cube.pings) {
    altitudes.push_back(by_pose ? ping.world_from_head.translation().z() - given : given);
    if (!(altitudes.back() > 0))
      fail(ErrorKind::argument, by_pose ? "--bottom" : "--altitude", " = ", given, " m puts the head of ping ",
           ping.number, " ", altitudes.back(), " m above the bottom, must be > 0");
  }
  return altitudes;
}

PingHistory on_flat_bottom(const PingHistory& slant, const std::vector<double>& altitude) {
  const RangeGate& gate = slant.gate;
  const double lowest = *std::min_element(altitude.begin(), altitude.end());
  const double highest = *std::max_element(altitude.begin(), altitude.end());
  if (!(highest < gate.max_range))
    fail(ErrorKind::argument, "on_flat_bottom: altitude = ", highest, " m, must be below the max range of ",
         gate.max_range, " m");
  PingHistory ground = silent_history(slant, 0, std::sqrt(gate.max_range * gate.max_range - lowest * lowest));
  ground.range_title = "Ground range on a flat bottom [m]";
  for (Eigen::Index p = 0; p < ground.level_db.rows(); ++p)
    for (Eigen::Index g = 0; g < ground.level_db.cols(); ++g) {
      const double range =
          std::hypot(ground.gate.centre(static_cast<std::size_t>(g)), altitude[static_cast<std::size_t>(p)]);
      const double bin = std::floor((range - gate.min_range) / gate.bin_size);
      if (bin >= 0 && bin < static_cast<double>(slant.level_db.cols()))
        ground.level_db(p, g) = slant.level_db(p, static_cast<Eigen::Index>(bin));
    }
  return ground;
}

namespace {

/// One head, or port and starboard (--starboard), by slant or ground range.
void draw_waterfall(const PictureRequest& job) {
  const ImageOptions& o = job.options;
  PingHistory history;
  std::string what = beam_text(choose_beam(o, fan_of(job)), fan_of(job));
  const auto sides = job.run.side_scan && o.beam.empty() ? channels_of_sides(fan_of(job)) : std::nullopt;
  if (sides) {
    history = history_of_channel(job.run, o, sides->first);
    require_room_from_head(job.run.path, history);
    history = side_by_side(history, history_of_channel(job.run, o, sides->second));
    what = "port and starboard";
  } else {
    history = history_of(job.run, o);
  }
  if (!o.starboard.empty()) {
    require_room_from_head(job.run.path, history);
    history = side_by_side(history, history_of(read_image_run(o.starboard, o.layer), o));
    what = "port and starboard";
  }
  PictureOptions picture = job.picture;
  if (o.picture.title.empty())
    picture.title = fmt::format("{}, {} pings, {}", job.run.cube.sonar, history.number.size(), what);
  show_waterfall(history, picture, job.path);
}

}  // namespace

ViewSpec waterfall_view() {
  return {
      .name = "waterfall",
      .shows = "range against pings",
      .options = {{"--starboard", &ImageOptions::starboard, "the run of the starboard head, RUN being the port one"},
                  {"--altitude", &ImageOptions::altitude, "[m] ground range on a flat bottom so far below the head"},
                  {"--bottom",
                   &ImageOptions::bottom,
                   "[m] the same, with the bottom at this z and the head at its pose",
                   {.excludes = "--altitude"}}},
      .draw = draw_waterfall,
      .beam_word = "max",
      .beam_choice = BeamChoice::strongest};
}

}  // namespace insonify::tool
