#include "view/picture_grid.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/error.hpp"
#include "core/units.hpp"

namespace insonify {

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
  if (fan_rows(fan).size() > 1)
    fail(ErrorKind::argument, "fan_raster: the fan has beams at several elevations, must have one row of beams");
  const std::vector<Eigen::Index> order = columns_from_port(fan);
  std::vector<double> bearing;  // ascending, positive to starboard
  for (const Eigen::Index beam : order) bearing.push_back(-fan.azimuth[static_cast<std::size_t>(beam)]);
  if (std::max(-bearing.front(), bearing.back()) >= pi / 2)
    fail(ErrorKind::argument, "fan_raster: the fan extends over ", degrees(bearing.back() - bearing.front()),
         " degrees, must look ahead, within 90 degrees to either side");
  const double margin = bearing.size() > 1
                            ? 0.5 * (bearing.back() - bearing.front()) / static_cast<double>(bearing.size() - 1)
                            : 0.5 * fan.beam_width;
  const double low = bearing.front() - margin, high = bearing.back() + margin, reach = gate.max_range;

  // The box about the fan: sides at the far ends of the outermost beams, bottom at the nearest range of these.
  const double left = std::min(0.0, reach * std::sin(low)), right = std::max(0.0, reach * std::sin(high));
  const double bottom = gate.min_range * std::min(std::cos(low), std::cos(high));
  FanRaster raster;
  raster.metres_per_pixel = (right - left) / columns;
  const auto rows = static_cast<Eigen::Index>(std::ceil((reach - bottom) / raster.metres_per_pixel));
  raster.head_column = -left / raster.metres_per_pixel;
  raster.head_row = reach / raster.metres_per_pixel;
  raster.beam = raster.bin = Grid<std::int32_t>::Constant(rows, columns, -1);
  for (Eigen::Index row = 0; row < rows; ++row)
    for (Eigen::Index column = 0; column < columns; ++column) {
      const double x = (raster.head_row - static_cast<double>(row) - 0.5) * raster.metres_per_pixel;
      const double y = (static_cast<double>(column) + 0.5 - raster.head_column) * raster.metres_per_pixel;
      const double range = std::hypot(x, y), at = std::atan2(y, x),
                   bin = std::floor((range - gate.min_range) / gate.bin_size);
      if (at < low || at > high || bin < 0 || bin >= static_cast<double>(gate.bins())) continue;
      const auto above =
          static_cast<std::size_t>(std::lower_bound(bearing.begin(), bearing.end(), at) - bearing.begin());
      std::size_t k = std::min(above, bearing.size() - 1);
      if (k > 0 && at - bearing[k - 1] < bearing[k] - at) --k;
      raster.beam(row, column) = static_cast<std::int32_t>(order[k]);
      raster.bin(row, column) = static_cast<std::int32_t>(bin);
    }
  return raster;
}

}  // namespace insonify
