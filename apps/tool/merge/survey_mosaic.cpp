// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <utility>

#include <Eigen/Geometry>

#include "beamforming/head_patterns.hpp"
#include "core/error.hpp"
#include "returns/image_mosaic.hpp"
#include "run/parse_values.hpp"
#include "scene_io/bed_of_returns.hpp"
#include "store/cube.hpp"
#include "store/sonar_file.hpp"
#include "tool/export/sounding_map.hpp"
#include "tool/merge/merge.hpp"
#include "view/save_vtk.hpp"

namespace insonify::tool {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double edge_rounding = 1e-6;  // of a cell

/// Adds the pings of one head in turn: each when the one after it is known.
class HeadStrips {
 public:
  HeadStrips(ImageMosaic& mosaic, const BedSurface& bed, int threads) : mosaic_(mosaic), bed_(bed), threads_(threads) {}

  void add(Ping&& ping, const MosaicSource& source) {
    std::optional<Vector3d> way;
    if (last_) way = ping.world_from_head.translation() - last_->world_from_head.translation();
    if (last_) finish(way);
    last_ = std::make_unique<Ping>(std::move(ping));
    source_ = source;
    way_ = way;
  }
  /// Adds the last ping.
  void finish() {
    if (last_) finish(std::nullopt);
    last_.reset();
  }

 private:
  /// Half the way to the nearer neighbour: a turn between two lines is no strip.
  void finish(const std::optional<Vector3d>& next) {
    const Vector3d strip = next && (!way_ || next->norm() < way_->norm()) ? *next : way_.value_or(Vector3d::Zero());
    mosaic_.add(*last_, source_, strip / 2, bed_, threads_);
  }

  ImageMosaic& mosaic_;
  const BedSurface& bed_;
  int threads_;
  std::unique_ptr<Ping> last_;
  std::optional<Vector3d> way_;  ///< way to the last ping from the one before [m]; absent: none
  MosaicSource source_;
};

/// The smallest grid of a plane, with the cells of a mosaic, that holds all of its edges.
struct RasterFrame {
  std::int64_t west, south;
  Eigen::Index columns, rows;
};
RasterFrame raster_frame(const MosaicMap& map, const RasterPlane& plane) {
  const auto columns = map.strength_db.rows(), rows = map.strength_db.cols();
  Eigen::AlignedBox2d box;
  const auto extend = [&](Eigen::Index row, Eigen::Index column) {
    box.extend(plane
                   .from_world(
                       {map.x + map.cell * static_cast<double>(column), map.y + map.cell * static_cast<double>(row), 0})
                   .head<2>());
  };
  for (Eigen::Index row = 0; row <= rows; ++row) extend(row, 0), extend(row, columns);
  for (Eigen::Index column = 0; column <= columns; ++column) extend(0, column), extend(rows, column);
  const std::int64_t west = cell_of(box.min().x(), map.cell), south = cell_of(box.min().y(), map.cell);
  const double wide = std::ceil(box.max().x() / map.cell - edge_rounding) - static_cast<double>(west);
  const double high = std::ceil(box.max().y() / map.cell - edge_rounding) - static_cast<double>(south);
  if (wide * high > 0x1p26)
    fail(ErrorKind::argument, "--mosaic = ", map.cell, " m gives ", wide, " x ", high,
         " cells of mosaic.tif, must give at most 2^26");
  return {west, south, static_cast<Eigen::Index>(wide), static_cast<Eigen::Index>(high)};
}

/// Writes a mosaic as a GeoTIFF in the plane. Between nodes 64 cells apart the plane is as good as even.
void save_mosaic_raster(const std::string& path, const MosaicMap& map, const RasterPlane& plane) {
  constexpr Eigen::Index between = 64;
  const RasterFrame frame = raster_frame(map, plane);
  const auto centre = [&](Eigen::Index row, Eigen::Index column) {
    return plane.world_of(map.cell * Vector2d(static_cast<double>(frame.west + column) + 0.5,
                                              static_cast<double>(frame.south + row) + 0.5),
                          Vector2d(map.x, map.y));
  };
  GeoBand strength{"strength", "dB re 1 m^2 per m^2",
                   Grid<float>::Constant(frame.rows, frame.columns, std::numeric_limits<float>::quiet_NaN())};
  GeoBand samples{"samples", "", Grid<float>::Zero(frame.rows, frame.columns)};
  for (Eigen::Index south = 0; south < frame.rows; south += between)
    for (Eigen::Index west = 0; west < frame.columns; west += between) {
      const Vector2d corner = centre(south, west), east = (centre(south, west + between) - corner) / between,
                     north = (centre(south + between, west) - corner) / between;
      for (Eigen::Index row = south; row < std::min(south + between, frame.rows); ++row)
        for (Eigen::Index column = west; column < std::min(west + between, frame.columns); ++column) {
          const Vector2d at =
              corner + static_cast<double>(column - west) * east + static_cast<double>(row - south) * north;
          const auto x = static_cast<Eigen::Index>(std::floor((at.x() - map.x) / map.cell));
          const auto y = static_cast<Eigen::Index>(std::floor((at.y() - map.y) / map.cell));
          if (x < 0 || y < 0 || x >= map.strength_db.rows() || y >= map.strength_db.cols()) continue;
          strength.values(row, column) = map.strength_db(x, y);
          samples.values(row, column) = map.samples(x, y);
        }
    }
  write_geotiff(path, {strength, samples},
                plane.in_system({0, map.cell * static_cast<double>(frame.west),
                                 map.cell * static_cast<double>(frame.south), map.cell}));
}

/// The bed has cells of its own, in which a few returns are enough.
constexpr double bed_cells = 4;

}  // namespace

void save_mosaic(const std::string& folder, const std::vector<HeadCubes>& heads, const std::string& returns,
                 const MosaicOptions& o, const std::optional<RasterPlane>& plane, int threads) {
  const BedSurface bed =
      o.bottom.empty() ? bed_of_returns(returns, bed_cells * o.cell) : flat_bed(parse_number("--bottom", o.bottom));
  ImageMosaic mosaic(o.cell, o.by == "best" ? MosaicRule::best : MosaicRule::mean);
  for (const HeadCubes& head : heads) {
    const SonarSpec sonar = load_sonar_file((std::filesystem::path(folder) / head.name / "run.toml").string()).spec;
    HeadStrips strips(mosaic, bed, threads);
    for (const std::string& path : head.cubes) {
      Cube cube = read_cube(path);
      const SonarHead own = make_head(sonar, cube.sound_speed);
      const EchoOptions patterns = with_patterns({}, own);
      for (Ping& ping : cube.pings) {
        const MosaicSource source{
            cube.source_level_db,     ping.absorption_db_per_m, range_resolution(own.pulse, ping.sound_speed),
            patterns.elevation_shape, patterns.elevation_width, patterns.elevation_centre};
        strips.add(std::move(ping), source);
      }
    }
    strips.finish();
  }

  const MosaicMap laid = mosaic.map();
  const HorizontalMap map{
      laid.x, laid.y, laid.cell, {{"strength_db", laid.strength_db, "dB re 1 m^2 per m^2"}, {"samples", laid.samples}}};
  const std::string stem = (std::filesystem::path(folder) / "mosaic").string();
  constexpr double window_db = 45;
  save_map_image(stem + ".vti", map);
  save_map_picture(stem, map, window_db);
  if (plane) save_mosaic_raster(stem + ".tif", laid, *plane);
}

}  // namespace insonify::tool
