// SPDX-License-Identifier: BSD-3-Clause
#include "returns/picture_grid.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/error.hpp"
#include "core/units.hpp"

namespace insonify {
namespace {

// Bearings of the beams from port to starboard, ascending, positive to starboard.
struct Bearings {
  Bearings(const BeamFan& fan, const char* who) : beam(columns_from_port(fan)) {
    if (fan_rows(fan).size() > 1)
      fail(ErrorKind::argument, who, ": the fan has beams at several elevations, must have one row of beams");
    for (const Eigen::Index b : beam) at.push_back(-fan.azimuth[static_cast<std::size_t>(b)]);
  }

  Eigen::Index nearest(double bearing) const {
    const auto above = static_cast<std::size_t>(std::lower_bound(at.begin(), at.end(), bearing) - at.begin());
    std::size_t k = std::min(above, at.size() - 1);
    if (k > 0 && bearing - at[k - 1] < at[k] - bearing) --k;
    return beam[k];
  }

  std::vector<Eigen::Index> beam;
  std::vector<double> at;
};

// Fills the pixels of a raster with known scale and head. Beams extend to `margin` beyond the outermost ones.
void fill_raster(FanRaster& raster, Eigen::Index rows, Eigen::Index columns, const Bearings& bearings, double margin,
                 const RangeGate& gate) {
  raster.margin = margin;
  raster.beam = raster.bin = Grid<std::int32_t>::Constant(rows, columns, -1);
  for (Eigen::Index row = 0; row < rows; ++row)
    for (Eigen::Index column = 0; column < columns; ++column) {
      const double x = (raster.head_row - static_cast<double>(row) - 0.5) * raster.metres_per_pixel;
      const double y = (static_cast<double>(column) + 0.5 - raster.head_column) * raster.metres_per_pixel;
      const double bearing = std::atan2(y, x), bin = std::floor((std::hypot(x, y) - gate.min_range) / gate.bin_size);
      if (bearing < bearings.at.front() - margin || bearing > bearings.at.back() + margin || bin < 0 ||
          bin >= static_cast<double>(gate.bins()))
        continue;
      raster.beam(row, column) = static_cast<std::int32_t>(bearings.nearest(bearing));
      raster.bin(row, column) = static_cast<std::int32_t>(bin);
    }
}

}  // namespace

std::vector<Eigen::Index> columns_from_port(const BeamFan& fan) {
  std::vector<Eigen::Index> beams(fan.beams());
  std::iota(beams.begin(), beams.end(), 0);
  std::stable_sort(beams.begin(), beams.end(), [&](Eigen::Index a, Eigen::Index b) {
    return fan.azimuth[static_cast<std::size_t>(a)] > fan.azimuth[static_cast<std::size_t>(b)];
  });
  return beams;
}

FanRaster fan_raster(const BeamFan& fan, const RangeGate& gate, int columns) {
  if (columns < 16 || columns > 8192)
    fail(ErrorKind::argument, "fan_raster: columns = ", columns, ", must be within 16 and 8192");
  const Bearings bearings(fan, "fan_raster");
  const double first = bearings.at.front(), last = bearings.at.back();
  if (std::max(-first, last) >= pi / 2)
    fail(ErrorKind::argument, "fan_raster: the fan extends over ", degrees(last - first),
         " degrees, must look ahead, within 90 degrees to either side");
  const double beams = static_cast<double>(bearings.at.size());
  const double margin = beams > 1 ? 0.5 * (last - first) / (beams - 1) : 0.5 * fan.beam_width;

  // Bound the fan by a box: the far ends of the outermost beams, and below their nearest ranges.
  const double low = first - margin, high = last + margin, reach = gate.max_range;
  const double left = std::min(0.0, reach * std::sin(low)), right = std::max(0.0, reach * std::sin(high));
  const double bottom = gate.min_range * std::min(std::cos(low), std::cos(high));
  FanRaster raster;
  raster.metres_per_pixel = (right - left) / columns;
  raster.head_column = -left / raster.metres_per_pixel;
  raster.head_row = reach / raster.metres_per_pixel;
  const auto rows = static_cast<Eigen::Index>(std::ceil((reach - bottom) / raster.metres_per_pixel));
  fill_raster(raster, rows, columns, bearings, margin, gate);
  return raster;
}

FanRaster fan_raster_from_head(const BeamFan& fan, const RangeGate& gate, int rows) {
  if (rows < 1) fail(ErrorKind::argument, "fan_raster_from_head: rows = ", rows, ", must be at least 1");
  const Bearings bearings(fan, "fan_raster_from_head");
  const double margin = fan.beam_width / 2;
  const double widest = std::max(std::abs(bearings.at.front() - margin), std::abs(bearings.at.back() + margin));
  FanRaster raster;
  raster.metres_per_pixel = gate.max_range / rows;
  const double side = gate.max_range * std::sin(std::min(widest, pi / 2));
  const Eigen::Index half = static_cast<Eigen::Index>(std::ceil(side / raster.metres_per_pixel));
  const Eigen::Index columns = std::max<Eigen::Index>(1, 2 * half);
  raster.head_column = static_cast<double>(columns / 2);
  raster.head_row = rows;
  fill_raster(raster, rows, columns, bearings, margin, gate);
  return raster;
}

}  // namespace insonify
