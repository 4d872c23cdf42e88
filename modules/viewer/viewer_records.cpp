// What the viewer shows of several pings: pages of a waterfall, and sweeps of a scanning head.
#include <algorithm>
#include <cmath>

#include "core/units.hpp"
#include "returns/quantise.hpp"
#include "viewer/viewer_flat_panels_internal.hpp"
#include "viewer/viewer_records_internal.hpp"

namespace insonify {
namespace {

constexpr std::size_t pings_of_a_page = 600;
constexpr std::size_t longest_sweep = 4000;

Grid<float> levels_of_page(const ViewerData& data, const BeamPage& page, bool tvg) {
  Grid<float> level_db = page.pressure.unaryExpr([](std::complex<float> pressure) {
    return static_cast<float>(std::max(silence_db, pressure_level_db(static_cast<double>(std::abs(pressure)))));
  });
  if (!tvg) return level_db;
  for (Eigen::Index row = 0; row < level_db.rows(); ++row) {
    const std::size_t ping = page.first + static_cast<std::size_t>(row);
    level_db.row(row) =
        apply_tvg(level_db.row(row), data.pings.gate(), {40, data.pings.place(ping).absorption_db_per_m});
  }
  return level_db;
}

// The pings of the sweep that `ping` is of.
PageOfPings sweep_of(const PingReel& pings, std::size_t ping) {
  const auto in_sweep = [&](std::size_t i) {
    return pings.place(i).scan && pings.place(i).scan->sweep == pings.place(ping).scan->sweep;
  };
  std::size_t first = ping, end = ping + 1;
  while (first > 0 && in_sweep(first - 1) && ping - first < longest_sweep) --first;
  while (end < pings.size() && in_sweep(end) && end - first < longest_sweep) ++end;
  return {first, end - first};
}

}  // namespace

void turn_page(BeamPage& page, const PingReel& pings, std::size_t first, std::size_t count, std::size_t beam) {
  if (page.first == first && page.count == count && page.beam == beam) return;
  page = {first, count, beam, pings.beam(first, count, beam)};
}

PageOfPings page_of(const PingReel& pings, std::size_t ping) {
  std::size_t first = ping - ping % pings_of_a_page;
  const std::size_t count = std::min(pings_of_a_page, pings.size() - first);
  if (count < 2 && first > 0) --first;  // one row is no waterfall
  return {first, std::max<std::size_t>(count, std::min<std::size_t>(2, pings.size()))};
}

PingHistory history_of(const ViewerData& data, const BeamPage& page, bool tvg) {
  PingHistory history;
  history.gate = data.pings.gate();
  history.unit = level_unit(tvg);
  for (std::size_t i = page.first; i < page.end(); ++i) {
    history.number.push_back(data.pings.place(i).number);
    history.time.push_back(data.pings.place(i).time);
  }
  history.level_db = levels_of_page(data, page, tvg);
  return history;
}

SweepImage sweep_at(const ViewerData& data, std::size_t ping, bool tvg, BeamPage& page) {
  const PingReel& pings = data.pings;
  const PageOfPings own = sweep_of(pings, ping);
  const PageOfPings before = own.first > 0 ? sweep_of(pings, own.first - 1) : PageOfPings{own.first, 0};
  turn_page(page, pings, before.first, before.count + own.count, 0);
  const Grid<float> level_db = levels_of_page(data, page, tvg);

  SweepImage sweep;
  const auto row_of = [&](std::size_t from) { return level_db.row(static_cast<Eigen::Index>(from - page.first)); };
  const Eigen::Index bins = level_db.cols();
  std::vector<double>& azimuth = sweep.image.fan.azimuth;
  Grid<float>& shown = sweep.image.level_db;
  sweep.image = {pings.fan(),
                 pings.gate(),
                 {},
                 level_unit(tvg),
                 looks_down(pings.place(ping).world_from_head, pings.place(ping).scan)};
  azimuth.clear();
  shown.setConstant(static_cast<Eigen::Index>(own.count + before.count), bins, static_cast<float>(silence_db));

  // The bearings of this sweep, heard up to the ping; then those that the sweep before heard and this one did not.
  constexpr double same_bearing = 1e-6;  // [rad]
  const auto beam_at = [&](double angle) {
    return std::find_if(azimuth.begin(), azimuth.end(),
                        [&](double known) { return std::abs(std::remainder(known - angle, 2 * pi)) < same_bearing; }) -
           azimuth.begin();
  };
  const auto add = [&](std::size_t from, bool heard) {
    const double angle = pings.place(from).scan->angle;
    const auto beam = beam_at(angle);
    const bool is_new = beam == std::ssize(azimuth);
    if (is_new) azimuth.push_back(std::remainder(angle, 2 * pi)), sweep.ping.push_back(from);
    if (!heard || (!is_new && sweep.ping[static_cast<std::size_t>(beam)] <= ping && from < own.first)) return;
    sweep.ping[static_cast<std::size_t>(beam)] = from;
    shown.row(beam) = row_of(from);
  };
  for (std::size_t i = own.first; i < own.first + own.count; ++i) add(i, i <= ping);
  for (std::size_t i = before.first; i < own.first; ++i) add(i, true);
  shown.conservativeResize(std::ssize(azimuth), bins);
  sweep.image.fan.elevation.assign(azimuth.size(), pings.fan().elevation.front());
  return sweep;
}

}  // namespace insonify
