// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <optional>
#include <string>
#include <utility>

#include "core/geodesy.hpp"
#include "formats/swath_record.hpp"
#include "returns/ping.hpp"
#include "returns/soundings.hpp"

namespace insonify::tool {

/// A recorded swath in a world whose origin is the position of its first ping: x east, y north, z up from the vertical
/// datum of the recording. Its pings have one fan across the track and one gate, which hold all soundings.
class SwathPings {
 public:
  /// Keeps the recording. With an anchor, x and y count from there.
  explicit SwathPings(SwathRecord record, const std::optional<Anchor>& anchor = {});

  const SwathRecord& record() const { return record_; }
  const Anchor& anchor() const { return anchor_; }
  /// Returns the place of a sounding [m].
  Eigen::Vector3d position(const SwathPing& ping, const SwathSounding& sounding) const;
  /// Returns a ping as an image: each sounding that is not rejected is a pixel at its angle and range, with its level,
  /// or 0 dB if the recording has no levels; all other pixels are silent.
  Ping ping(std::size_t i) const;
  /// Returns number, time and pose of a ping's head, which looks straight down, without its image.
  TrackPoint track_point(std::size_t i) const;
  /// Returns the soundings of all pings that are not rejected.
  Soundings soundings() const;
  /// Returns the unit of the levels in words.
  std::string unit() const;

 private:
  Eigen::Vector3d head_position(const SwathPing& ping) const;
  /// Returns the number of the pixel's beam and bin.
  std::pair<std::size_t, std::size_t> pixel(const SwathPing& ping, const SwathSounding& sounding) const;

  SwathRecord record_;
  Anchor anchor_{0, 0, 90};
  BeamFan fan_;
  RangeGate gate_;
};

/// Returns the slant range of a sounding [m]: its distance from the head across the track.
double swath_range(const SwathPing& ping, const SwathSounding& sounding);

}  // namespace insonify::tool
