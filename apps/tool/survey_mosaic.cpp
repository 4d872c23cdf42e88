#include "tool/survey_mosaic.hpp"

#include <filesystem>
#include <memory>
#include <optional>
#include <utility>

#include "beamforming/head_patterns.hpp"
#include "returns/image_mosaic.hpp"
#include "scene_io/bed_of_returns.hpp"
#include "store/cube.hpp"
#include "store/sonar_file.hpp"
#include "tool/parse_values.hpp"
#include "view/save_vtk.hpp"

namespace insonify::tool {
namespace {

using Eigen::Vector3d;

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
  std::optional<Vector3d> way_;  ///< to the last ping
  MosaicSource source_;
};

/// The bed has cells of its own, in which a few returns are enough.
constexpr double bed_cells = 4;

}  // namespace

void save_mosaic(const std::string& folder, const std::vector<HeadCubes>& heads, const std::string& returns,
                 const MosaicOptions& o, int threads) {
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
}

}  // namespace insonify::tool
