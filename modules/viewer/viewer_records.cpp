// SPDX-License-Identifier: BSD-3-Clause
// Selects the pings that the viewer shows together: pages of a waterfall, and sweeps of a scanning head.
#include <algorithm>
#include <cmath>

#include "core/units.hpp"
#include "viewer/viewer_records_internal.hpp"

namespace insonify {
namespace {

constexpr std::size_t pings_of_a_page = 600;
constexpr std::size_t longest_sweep = 4000;

PageOfPings sweep_of(const LazyPings& pings, std::size_t ping) {
  const auto in_sweep = [&](std::size_t i) {
    return pings.position(i).scan && pings.position(i).scan->sweep == pings.position(ping).scan->sweep;
  };
  std::size_t first = ping, end = ping + 1;
  while (first > 0 && in_sweep(first - 1) && ping - first < longest_sweep) --first;
  while (end < pings.size() && in_sweep(end) && end - first < longest_sweep) ++end;
  return {first, end - first};
}

}  // namespace

void turn_page(BeamPage& page, const LazyPings& pings, std::size_t first, std::size_t count, std::size_t beam) {
  if (page.first == first && page.count == count && page.beam == beam) return;
  page = {first, count, beam, pings.beam(first, count, beam)};
}

PageOfPings page_of(const LazyPings& pings, std::size_t ping) {
  std::size_t first = ping - ping % pings_of_a_page;
  const std::size_t count = std::min(pings_of_a_page, pings.size() - first);
  if (count < 2 && first > 0) --first;  // one row is no waterfall
  return {first, std::max<std::size_t>(count, std::min<std::size_t>(2, pings.size()))};
}

BeamRecord record_of(const ViewerData& data, const BeamPage& page, bool tvg) {
  BeamRecord record{{}, data.pings.gate(), {}, unit_of(data, tvg)};
  record.level_db = page.pressure.unaryExpr([](std::complex<float> pressure) {
    return static_cast<float>(std::max(silence_db, pressure_level_db(static_cast<double>(std::abs(pressure)))));
  });
  for (std::size_t i = page.first; i < page.end(); ++i) {
    const TrackPoint& position = record.pings.emplace_back(data.pings.position(i));
    auto row = record.level_db.row(std::ssize(record.pings) - 1);
    if (tvg) row = apply_tvg(row, record.gate, {40, position.absorption_db_per_m});
  }
  return record;
}

SweepImage sweep_at(const ViewerData& data, std::size_t ping, bool tvg, BeamPage& page) {
  const LazyPings& pings = data.pings;
  const PageOfPings own = sweep_of(pings, ping);
  const PageOfPings before = own.first > 0 ? sweep_of(pings, own.first - 1) : PageOfPings{own.first, 0};
  turn_page(page, pings, before.first, before.count + own.count, 0);
  SweepImage sweep =
      sweep_image(record_of(data, page, tvg), pings.fan(), own.first - before.first, ping - before.first);
  for (std::size_t& each : sweep.ping) each += before.first;
  return sweep;
}

}  // namespace insonify
