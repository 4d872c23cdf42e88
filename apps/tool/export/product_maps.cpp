// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <fstream>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/text.hpp"
#include "core/units.hpp"
#include "files/pending_file.hpp"
#include "formats/geotiff_file.hpp"
#include "formats/las_file.hpp"
#include "tool/export/product_run.hpp"
#include "tool/export/raster_plane.hpp"
#include "tool/export/sounding_map.hpp"
#include "tool/export/sounding_uncertainty.hpp"

namespace insonify::tool {

namespace {

/// Number of each sounding among those of its beam, nearest first, from 1, and how many these are.
std::vector<std::pair<std::uint8_t, std::uint8_t>> returns_of_beams(const BottomSoundings& found) {
  std::vector<std::pair<std::uint8_t, std::uint8_t>> numbers;
  for (std::size_t i = 0; i < found.size(); ++i) {
    std::uint8_t number = 1, returns = 0;
    for (std::size_t k = 0; k < found.size(); ++k)
      if (found.beam[k] == found.beam[i]) {
        ++returns;
        if (found.range[k] < found.range[i] || (found.range[k] == found.range[i] && k < i)) ++number;
      }
    numbers.emplace_back(number, returns);
  }
  return numbers;
}

/// Angle of a position from straight down [rad], positive to the starboard of a head.
double angle_from_nadir(const Pose& world_from_head, const Eigen::Vector3d& position) {
  const Eigen::Vector3d away = position - world_from_head.translation();
  const Eigen::Vector2d port = world_from_head.linear().col(1).head<2>();
  const double across = port.norm() > 0 ? -port.normalized().dot(away.head<2>()) : 0;
  return std::atan2(across, -away.z());
}

}  // namespace

SoundingCount las_product(const PlacedRun& run) {
  const RasterPlane plane("", run.georeference);
  std::unique_ptr<LasFile> file;
  const LasOptions options{run.options.las_version == "1.2" ? 2 : 4, run.start, profile_remark(run.options)};
  const auto count = each_swath(run, [&](const Cube&, const Ping& ping, const BottomSoundings& found) {
    if (!file)
      file = std::make_unique<LasFile>(run.options.output, plane.las_system(),
                                       plane.from_world(ping.world_from_head.translation()), options);
    const auto returns = returns_of_beams(found);
    const auto line = static_cast<std::uint16_t>(leg_at(run.pings.legs, ping.time));
    for (std::size_t i = 0; i < found.size(); ++i)
      file->add({plane.from_world(found.position[i]), run.start + ping.time, found.level_db[i], found.deviation[i],
                 static_cast<std::uint32_t>(ping.number), static_cast<std::uint16_t>(found.beam[i]), line,
                 returns[i].first, returns[i].second, angle_from_nadir(ping.world_from_head, found.position[i]),
                 found.reject[i] != 0});
  });
  file->finish();
  return count;
}

SoundingCount geotiff_product(const PlacedRun& run) {
  if (!(run.options.cell > 0)) fail(ErrorKind::argument, "--cell = ", run.options.cell, " m, must be > 0");
  const RasterPlane plane(run.options.crs, run.georeference);
  SoundingMap map(run.options.cell);
  const auto count = each_swath(run, [&](const Cube&, const Ping&, const BottomSoundings& found) {
    for (std::size_t i = 0; i < found.size(); ++i) {
      const Eigen::Vector3d position = plane.from_world(found.position[i]);
      if (found.reject[i] != 0)
        map.add_rejected(position);
      else
        map.add(position, power_from_db(static_cast<double>(found.level_db[i]) + 30 * std::log10(found.range[i])));
    }
  });
  if (map.empty()) fail(ErrorKind::content, run.options.run, ": has no soundings, so there is nothing to map");
  GeoGrid grid = plane.in_system(map.grid());
  grid.remark = profile_remark(run.options);
  write_geotiff(run.options.output, map.bands(run.options.keep_rejected), grid);
  return count;
}

SoundingCount csv_product(const PlacedRun& run) {
  PendingFile pending(run.options.output);
  std::ofstream out(pending.temporary(), std::ios::binary);
  if (const std::string remark = profile_remark(run.options); !remark.empty()) out << "# " << remark << '\n';
  const std::span columns(csv_columns);
  const RunUncertainty uncertainty(run);
  const std::optional<RasterPlane> plane =
      run.georeference ? std::optional<RasterPlane>({"", run.georeference}) : std::nullopt;
  out << joined(plane ? columns : columns.first(columns.size() - placed_columns), ",", &BandMeaning::name);
  if (uncertainty.known()) out << ',' << joined(uncertainty_columns(), ",");
  out << '\n';
  const auto count = each_swath(run, [&](const Cube&, const Ping& ping, const BottomSoundings& found) {
    std::vector<std::size_t> entry(found.size());
    std::size_t entries = 0;
    for (const SwathEntry& each : entries_from_port(ping, ship_axes(run.pings, ping), found)) {
      if (each.sounding) entry[*each.sounding] = entries;
      ++entries;
    }
    std::string rows;
    for (std::size_t i = 0; i < found.size(); ++i) {
      const Eigen::Vector3d& at = found.position[i];
      rows += fmt::format("{},{:.6f},{},{:.4f},{:.4f},{:.4f},{:.5f},{:.5f},{:.2f},{:.3f},{},{},{}", ping.number,
                          run.start + ping.time, found.beam[i], at.x(), at.y(), at.z(), found.range[i],
                          found.deviation[i], found.level_db[i], found.quality[i],
                          found.method[i] == BottomMethod::phase ? "phase" : "amplitude", found.reject[i], entry[i]);
      if (plane) {
        const GeoPosition position = geo_from_world(run.reference(), at);
        const Eigen::Vector3d east_north = plane->from_world(at);
        rows += fmt::format(",{:.9f},{:.9f},{:.4f},{:.4f}", degrees(position.latitude), degrees(position.longitude),
                            east_north.x(), east_north.y());
      }
      if (uncertainty.known())
        for (const double number : uncertainty_numbers(uncertainty.at(ping, found, i)))
          rows += fmt::format(",{:.5f}", number);
      rows += '\n';
    }
    out << rows;
  });
  pending.commit(out);
  return count;
}

}  // namespace insonify::tool
