// SPDX-License-Identifier: BSD-3-Clause
#include "view/ping_record.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/text.hpp"
#include "core/units.hpp"
#include "returns/looks.hpp"
#include "returns/sounding_columns.hpp"

namespace insonify {

std::string level_unit(const std::optional<Tvg>& tvg) {
  if (!tvg) return "dB re 1 µPa";
  return tvg->spreading == 40 ? "dB re 1 µPa at 1 m, range compensated"
                              : printed("dB re 1 µPa, gain %g log r", tvg->spreading);
}

LevelImage level_image(const Ping& ping, const std::optional<Tvg>& tvg) {
  Grid<float> level = shown_level_db(ping);
  if (tvg) level = apply_tvg(std::move(level), ping.gate, *tvg);
  return {ping.fan, ping.gate, std::move(level), level_unit(tvg), looks_down(ping.world_from_head, ping.scan)};
}

Soundings soundings_of_ping(const Soundings& all, std::int64_t number, const std::optional<Tvg>& tvg) {
  Soundings own;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (static_cast<std::int64_t>(all.ping[i]) != number) continue;
    append_row(own, all, i);
    if (tvg) own.level_db.back() += static_cast<float>(gain_db(*tvg, static_cast<double>(all.range[i])));
  }
  return own;
}

PingHistory history_of(const BeamRecord& record) {
  PingHistory history;
  history.gate = record.gate;
  history.level_db = record.level_db;
  history.unit = record.unit;
  for (const TrackPoint& ping : record.pings) {
    history.number.push_back(ping.number);
    history.time.push_back(ping.time);
  }
  return history;
}

PingHistory silent_history(const PingHistory& other, double min_range, double max_range) {
  PingHistory history = other;
  history.gate.min_range = min_range;
  history.gate.max_range = max_range;
  history.level_db.setConstant(other.level_db.rows(), static_cast<Eigen::Index>(history.gate.bins()),
                               static_cast<float>(silence_db));
  return history;
}

PingHistory side_by_side(const PingHistory& port, const PingHistory& starboard) {
  const RangeGate &a = port.gate, &b = starboard.gate;
  if (a.min_range != b.min_range || a.bin_size != b.bin_size || port.level_db.rows() != starboard.level_db.rows() ||
      port.level_db.cols() != starboard.level_db.cols())
    fail(ErrorKind::content, "port has ", port.level_db.rows(), " pings of ", a.min_range, " to ", a.max_range,
         " m, starboard ", starboard.level_db.rows(), " of ", b.min_range, " to ", b.max_range,
         " m, must be the same, with bins of one size");
  const Eigen::Index bins = port.level_db.cols();
  const double end = a.min_range + static_cast<double>(bins) * a.bin_size;
  PingHistory both = silent_history(port, -end, end);
  both.level_db.leftCols(bins) = port.level_db.rowwise().reverse();
  both.level_db.rightCols(bins) = starboard.level_db;
  both.range_title = "Port          " + port.range_title + "          Starboard";
  return both;
}

SweepImage sweep_image(const BeamRecord& record, const BeamFan& fan, std::size_t first, std::size_t shown) {
  constexpr double same_bearing = 1e-6;  // [rad]
  const Eigen::Index bins = record.level_db.cols();
  const TrackPoint& at = record.pings[shown];
  SweepImage sweep;
  sweep.image = {fan, record.gate, {}, record.unit, looks_down(at.world_from_head, at.scan)};
  std::vector<double>& azimuth = sweep.image.fan.azimuth;
  Grid<float>& level_db = sweep.image.level_db;
  azimuth.clear();
  level_db.setConstant(std::ssize(record.pings), bins, static_cast<float>(silence_db));

  // Collect the bearings of this sweep up to the ping, then those that only the sweep before has.
  const auto beam_at = [&](double angle) {
    return std::find_if(azimuth.begin(), azimuth.end(),
                        [&](double known) { return std::abs(std::remainder(known - angle, 2 * pi)) < same_bearing; }) -
           azimuth.begin();
  };
  const auto add = [&](std::size_t from, bool is_insonified) {
    const double angle = record.pings[from].scan->angle;
    const auto beam = beam_at(angle);
    const bool is_new = beam == std::ssize(azimuth);
    if (is_new) azimuth.push_back(std::remainder(angle, 2 * pi)), sweep.ping.push_back(from);
    if (!is_insonified || (!is_new && sweep.ping[static_cast<std::size_t>(beam)] <= shown && from < first)) return;
    sweep.ping[static_cast<std::size_t>(beam)] = from;
    level_db.row(beam) = record.level_db.row(static_cast<Eigen::Index>(from));
  };
  for (std::size_t i = first; i < record.pings.size(); ++i) add(i, i <= shown);
  for (std::size_t i = 0; i < first; ++i) add(i, true);
  level_db.conservativeResize(std::ssize(azimuth), bins);
  sweep.image.fan.elevation.assign(azimuth.size(), fan.elevation.front());
  return sweep;
}

}  // namespace insonify
