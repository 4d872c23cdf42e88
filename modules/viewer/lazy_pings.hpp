// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "returns/ping.hpp"
#include "returns/soundings.hpp"

namespace insonify {

/// Reads pings by their index in a reel.
struct PingSource {
  std::function<Ping(std::size_t ping)> ping;
  /// Returns the pressure of one beam in `count` pings from the `first` on, pings x bins [Pa].
  std::function<ComplexGridF(std::size_t first, std::size_t count, std::size_t beam)> beam;
  std::function<Soundings(std::size_t ping)> returns;  ///< returns of one ping; empty: there are none
};

/// The pings that a viewer plays. The positions of all pings are known; images are read one at a time, so that memory
/// does not grow with their number. All pings have the fan and the gate of the first.
class LazyPings {
 public:
  LazyPings() = default;
  /// `source.ping` and `source.beam` must be given.
  LazyPings(std::vector<TrackPoint> positions, PingSource source);

  /// Returns the number of pings.
  std::size_t size() const { return positions_.size(); }
  /// Returns true if there is no ping.
  bool empty() const { return positions_.empty(); }
  /// Returns time and pose of ping `i`.
  const TrackPoint& position(std::size_t i) const { return positions_[i]; }
  /// Returns time and pose of all pings.
  const std::vector<TrackPoint>& positions() const { return positions_; }

  /// Returns the fan of every ping, read with the first one.
  const BeamFan& fan() const { return frame().fan; }
  /// Returns the range gate of every ping, read with the first one.
  const RangeGate& gate() const { return frame().gate; }
  /// Returns a ping; the last one stays in memory. Throws Error(content) for a ping that is invalid or differs from the
  /// first in fan or gate. Errors of the source propagate.
  std::shared_ptr<const Ping> ping(std::size_t i) const;
  /// Returns the pressure of one beam in some pings, pings x bins [Pa].
  ComplexGridF beam(std::size_t first, std::size_t count, std::size_t beam) const;
  /// Returns true if the source gives returns.
  bool has_returns() const { return static_cast<bool>(source_.returns); }
  /// Returns the returns of one ping; none if has_returns is false.
  Soundings returns(std::size_t i) const;

 private:
  struct Frame {
    BeamFan fan;
    RangeGate gate;
  };
  const Frame& frame() const;

  std::vector<TrackPoint> positions_;
  PingSource source_;
  mutable std::optional<Frame> frame_;
  mutable std::shared_ptr<const Ping> last_;
  mutable std::size_t last_index_ = 0;
};

}  // namespace insonify
