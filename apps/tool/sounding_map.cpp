#include "tool/sounding_map.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "core/units.hpp"

namespace insonify::tool {
namespace {

constexpr double on_edge = 1e-6;  // [m]

}  // namespace

std::int64_t cell_of(double coordinate, double cell) {
  return static_cast<std::int64_t>(std::floor((coordinate + on_edge) / cell));
}

void SoundingMap::add(const Eigen::Vector3d& place, double intensity) {
  Cell& cell = cells_[{cell_of(place.y(), cell_), cell_of(place.x(), cell_)}];
  cell.count += 1;
  cell.height += place.z();
  cell.intensity += intensity;
}

SoundingMap::Extent SoundingMap::extent() const {
  std::int64_t west = cells_.begin()->first.second, east = west;
  for (const auto& [at, cell] : cells_) west = std::min(west, at.second), east = std::max(east, at.second);
  const std::int64_t south = cells_.begin()->first.first, rows = cells_.rbegin()->first.first - south + 1;
  const std::int64_t columns = east - west + 1;
  if (static_cast<double>(rows) * static_cast<double>(columns) > 0x1p26)
    fail(ErrorKind::argument, "--cell = ", cell_, " m gives ", rows, " x ", columns, " cells, must give at most 2^26");
  return {west, south, columns, rows};
}

std::vector<GeoBand> SoundingMap::bands() const {
  const auto [west, south, columns, rows] = extent();
  const Grid<float> none = Grid<float>::Constant(rows, columns, std::numeric_limits<float>::quiet_NaN());
  std::vector<GeoBand> bands = {
      {"height [m]", none}, {"level [dB re 1 uPa at 1 m]", none}, {"soundings", Grid<float>::Zero(rows, columns)}};
  for (const auto& [at, cell] : cells_) {
    const std::int64_t row = at.first - south, column = at.second - west;
    bands[0].values(row, column) = static_cast<float>(cell.height / cell.count);
    bands[1].values(row, column) = static_cast<float>(db_from_power(cell.intensity / cell.count));
    bands[2].values(row, column) = static_cast<float>(cell.count);
  }
  return bands;
}

GeoGrid SoundingMap::grid() const {
  const Extent e = extent();
  return {{}, static_cast<double>(e.west) * cell_, static_cast<double>(e.south) * cell_, cell_};
}

}  // namespace insonify::tool
