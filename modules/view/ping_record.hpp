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

/// Levels of a ping as they are drawn; without `tvg`, as they were received.
LevelImage level_image(const Ping& ping, const std::optional<Tvg>& tvg);

/// The unit of levels with a TVG, or as they were received.
std::string level_unit(const std::optional<Tvg>& tvg);

/// The soundings of the ping with a number, with the gain of a TVG.
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

/// What the display of a scanning head of one beam shows at a ping: every bearing of the sweep as it was heard last;
/// what was not heard yet is silent.
struct SweepImage {
  LevelImage image;
  std::vector<std::size_t> ping;  ///< by beam of the image: place in the record of the ping that heard it, or will
};
/// Draws the sweep that begins at place `first` of a record and ends with it, up to place `shown`; what this sweep has
/// not heard yet is that of the pings before. `fan` is that of the head.
SweepImage sweep_image(const BeamRecord& record, const BeamFan& fan, std::size_t first, std::size_t shown);

}  // namespace insonify
