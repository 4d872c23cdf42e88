// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/lazy_pings.hpp"

#include <utility>

#include "core/error.hpp"

namespace insonify {

LazyPings::LazyPings(std::vector<TrackPoint> positions, PingSource source)
    : positions_(std::move(positions)), source_(std::move(source)) {}

std::shared_ptr<const Ping> LazyPings::ping(std::size_t i) const {
  constexpr const char* who = "show_viewer";
  if (i >= size()) fail(ErrorKind::argument, who, ": ping = ", i, ", must be below ", size(), ", the number of pings");
  if (last_ && last_index_ == i) return last_;
  auto ping = std::make_shared<const Ping>(source_.ping(i));
  require_valid(ping->fan, who);
  require_valid(ping->gate, who);
  if (!frame_) frame_ = {ping->fan, ping->gate};
  const std::size_t beams = frame_->fan.beams(), bins = frame_->gate.bins();
  const auto rows = static_cast<std::size_t>(ping->pressure.rows());
  const auto columns = static_cast<std::size_t>(ping->pressure.cols());
  if (rows != beams || columns != bins || ping->fan.beams() != beams || ping->gate.bins() != bins)
    fail(ErrorKind::content, who, ": ping ", ping->number, " has ", rows, " x ", columns,
         " samples, must be beams x bins = ", beams, " x ", bins);
  last_ = std::move(ping);
  last_index_ = i;
  return last_;
}

const LazyPings::Frame& LazyPings::frame() const {
  if (!frame_) ping(0);
  return *frame_;
}

ComplexGridF LazyPings::beam(std::size_t first, std::size_t count, std::size_t beam) const {
  return source_.beam(first, count, beam);
}

Soundings LazyPings::returns(std::size_t i) const { return has_returns() ? source_.returns(i) : Soundings{}; }

}  // namespace insonify
