#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <memory>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/pending_file.hpp"
#include "core/units.hpp"
#include "formats/geotiff_file.hpp"
#include "formats/las_file.hpp"
#include "tool/product_run.hpp"

namespace insonify::tool {

std::size_t las_product(const PlacedRun& run) {
  const UtmWorld world(run.reference());
  std::unique_ptr<LasFile> file;
  const std::size_t soundings = each_swath(run, [&](const Cube&, const Ping& ping, const BottomSoundings& found) {
    if (!file)
      file = std::make_unique<LasFile>(run.options.output, world.zone, world.place(ping.world_from_head.translation()));
    for (std::size_t i = 0; i < found.size(); ++i)
      file->add({world.place(found.position[i]), run.start + ping.time, found.level_db[i], found.deviation[i],
                 static_cast<std::uint32_t>(ping.number), static_cast<std::uint16_t>(found.beam[i])});
  });
  file->finish();
  return soundings;
}

std::size_t geotiff_product(const PlacedRun& run) {
  struct Cell {
    double count = 0, height = 0, intensity = 0;
  };
  if (!(run.options.cell > 0)) fail(ErrorKind::argument, "--cell = ", run.options.cell, " m, must be > 0");
  const UtmWorld world(run.reference());
  std::map<std::pair<std::int64_t, std::int64_t>, Cell> cells;  // by row and column
  const std::size_t soundings = each_swath(run, [&](const Cube&, const Ping&, const BottomSoundings& found) {
    for (std::size_t i = 0; i < found.size(); ++i) {
      const Eigen::Vector3d at = world.place(found.position[i]);
      Cell& cell = cells[{static_cast<std::int64_t>(std::floor(at.y() / run.options.cell)),
                          static_cast<std::int64_t>(std::floor(at.x() / run.options.cell))}];
      cell.count += 1;
      cell.height += at.z();
      cell.intensity += power_from_db(static_cast<double>(found.level_db[i]) + 30 * std::log10(found.range[i]));
    }
  });
  if (cells.empty()) fail(ErrorKind::content, run.options.run, ": has no soundings, so there is nothing to map");
  std::int64_t west = cells.begin()->first.second, east = west;
  for (const auto& [at, cell] : cells) west = std::min(west, at.second), east = std::max(east, at.second);
  const std::int64_t south = cells.begin()->first.first, rows = cells.rbegin()->first.first - south + 1;
  const std::int64_t columns = east - west + 1;
  if (static_cast<double>(rows) * static_cast<double>(columns) > 0x1p26)
    fail(ErrorKind::argument, "--cell = ", run.options.cell, " m gives ", rows, " x ", columns,
         " cells, must give at most 2^26");
  const Grid<float> none = Grid<float>::Constant(rows, columns, std::numeric_limits<float>::quiet_NaN());
  std::vector<GeoBand> bands = {
      {"height [m]", none}, {"level [dB re 1 uPa at 1 m]", none}, {"soundings", Grid<float>::Zero(rows, columns)}};
  for (const auto& [at, cell] : cells) {
    const std::int64_t row = at.first - south, column = at.second - west;
    bands[0].values(row, column) = static_cast<float>(cell.height / cell.count);
    bands[1].values(row, column) = static_cast<float>(db_from_power(cell.intensity / cell.count));
    bands[2].values(row, column) = static_cast<float>(cell.count);
  }
  write_geotiff(run.options.output, bands,
                {world.zone, static_cast<double>(west) * run.options.cell,
                 static_cast<double>(south) * run.options.cell, run.options.cell});
  return soundings;
}

std::size_t csv_product(const PlacedRun& run) {
  PendingFile pending(run.options.output);
  std::ofstream out(pending.temporary(), std::ios::binary);
  out << "ping,time_s,beam,x_m,y_m,z_m,range_m,deviation_m,level_db,quality,method"
      << (run.place ? ",latitude_deg,longitude_deg\n" : "\n");
  const std::size_t soundings = each_swath(run, [&](const Cube&, const Ping& ping, const BottomSoundings& found) {
    std::string rows;
    for (std::size_t i = 0; i < found.size(); ++i) {
      const Eigen::Vector3d& at = found.position[i];
      rows += fmt::format("{},{:.6f},{},{:.4f},{:.4f},{:.4f},{:.5f},{:.5f},{:.2f},{:.3f},{}", ping.number,
                          run.start + ping.time, found.beam[i], at.x(), at.y(), at.z(), found.range[i],
                          found.deviation[i], found.level_db[i], found.quality[i],
                          found.method[i] == BottomMethod::phase ? "phase" : "amplitude");
      if (run.place) {
        const GeoPlace place = geo_from_world(run.reference(), at);
        rows += fmt::format(",{:.9f},{:.9f}", degrees(place.latitude), degrees(place.longitude));
      }
      rows += '\n';
    }
    out << rows;
  });
  pending.commit(out);
  return soundings;
}

}  // namespace insonify::tool
