// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "returns/ping.hpp"
#include "returns/quantise.hpp"
#include "returns/soundings.hpp"
#include "view/show_image.hpp"

namespace insonify {

/// Returns the levels of a ping for drawing: with the gain of `tvg`, or, without `tvg`, as received.
LevelImage level_image(const Ping& ping, const std::optional<Tvg>& tvg);

/// Returns the unit of levels with a TVG, or of levels as received.
std::string level_unit(const std::optional<Tvg>& tvg);

/// Returns the soundings of the ping with this number, with the gain of a TVG.
Soundings soundings_of_ping(const Soundings& all, std::int64_t number, const std::optional<Tvg>& tvg);

/// Levels along one beam, ping after ping.
struct BeamRecord {
  std::vector<TrackPoint> pings;
  RangeGate gate;
  Grid<float> level_db;  ///< pings x bins
  std::string unit;
};

/// Returns the record as a waterfall by slant range.
PingHistory history_of(const BeamRecord& record);

/// Returns a waterfall like another, of other ranges [m] and silent.
PingHistory silent_history(const PingHistory& other, double min_range, double max_range);

/// Returns port and starboard of one line as one history: ranges to port to the left, to starboard to the right, and
/// silence between them where neither has samples. Throws Error(content) unless both have the same gate and number of
/// pings.
PingHistory side_by_side(const PingHistory& port, const PingHistory& starboard);

/// The display of a scanning head of one beam at a ping: the latest samples of every bearing of the sweep. Bearings
/// without samples are silent.
struct SweepImage {
  LevelImage image;
  std::vector<std::size_t> ping;  ///< record index of the ping that last sampled each beam, or will
};
/// Returns the display of the sweep that begins at index `first` of a record and ends with the record, up to index
/// `shown`. Bearings that this sweep has not reached yet show the pings before it. `fan` is that of the head.
SweepImage sweep_image(const BeamRecord& record, const BeamFan& fan, std::size_t first, std::size_t shown);

}  // namespace insonify
