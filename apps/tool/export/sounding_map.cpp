// SPDX-License-Identifier: BSD-3-Clause
#include "tool/export/sounding_map.hpp"

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

SoundingMap::Cell& SoundingMap::cell_at(const Eigen::Vector3d& position) {
  return cells_[{cell_of(position.y(), cell_), cell_of(position.x(), cell_)}];
}

void SoundingMap::add(const Eigen::Vector3d& position, double intensity) {
  Cell& cell = cell_at(position);
  const double z = position.z();
  cell.least = cell.count == 0 ? z : std::min(cell.least, z);
  cell.most = cell.count == 0 ? z : std::max(cell.most, z);
  cell.count += 1;
  const double off = z - cell.mean;  // Welford's sums, which heights far from 0 do not cancel
  cell.mean += off / cell.count;
  cell.squares += off * (z - cell.mean);
  cell.intensity += intensity;
}

void SoundingMap::add_rejected(const Eigen::Vector3d& position) {
  Cell& cell = cell_at(position);
  cell.rejected += 1;
  cell.rejected_mean += (position.z() - cell.rejected_mean) / cell.rejected;
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

std::vector<GeoBand> SoundingMap::bands(bool with_rejected) const {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  const auto [west, south, columns, rows] = extent();
  std::vector<GeoBand> bands;
  for (const BandMeaning& meaning : sounding_bands)
    bands.push_back({meaning.name, meaning.unit, Grid<float>::Constant(rows, columns, static_cast<float>(none))});
  bands[2].values.setZero();
  bands[6].values.setZero();
  for (const auto& [at, cell] : cells_) {
    const bool any = cell.count > 0;
    const double of_cell[] = {any ? cell.mean : none,
                              any ? db_from_power(cell.intensity / cell.count) : none,
                              cell.count,
                              cell.count > 1 ? std::sqrt(cell.squares / (cell.count - 1)) : none,
                              any ? cell.least : none,
                              any ? cell.most : none,
                              cell.rejected,
                              cell.rejected > 0 ? cell.rejected_mean : none};
    for (std::size_t k = 0; k < bands.size(); ++k)
      bands[k].values(at.first - south, at.second - west) = static_cast<float>(of_cell[k]);
  }
  if (!with_rejected) bands.resize(bands.size() - rejected_bands);
  return bands;
}

GeoGrid SoundingMap::grid() const {
  const Extent e = extent();
  return {0, static_cast<double>(e.west) * cell_, static_cast<double>(e.south) * cell_, cell_};
}

}  // namespace insonify::tool
