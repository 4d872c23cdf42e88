// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/units.hpp"
#include "tool/image/image.hpp"

namespace insonify::tool {
namespace {

std::vector<std::size_t> pings_of_sweep(const ImageRun& run, std::size_t ping) {
  const std::vector<Ping>& pings = run.cube.pings;
  if (!pings[ping].scan || pings[ping].fan.beams() != 1)
    fail(ErrorKind::content, run.path, ": is not of a scanning head of one beam; draw it with --view fan");
  std::vector<std::size_t> sweep;
  for (std::size_t p = 0; p < pings.size(); ++p)
    if (pings[p].scan->sweep == pings[ping].scan->sweep) sweep.push_back(p);
  return sweep;
}

/// The angle between neighbouring beams.
double step_of(const std::vector<Ping>& pings, const std::vector<std::size_t>& sweep) {
  if (sweep.size() < 2) return pings[sweep.front()].fan.beam_width;
  return std::abs(pings[sweep[1]].scan->angle - pings[sweep[0]].scan->angle);
}

/// A raster of bearings and ranges that keeps the highest level in each cell.
struct PolarRaster {
  LevelImage image;
  double width;  ///< width of a bearing [rad]

  void add(const Eigen::Vector3d& at, float level_db) {
    const double turn = (std::atan2(at.y(), at.x()) + pi) / width, range = std::hypot(at.x(), at.y());
    const double bin = (range - image.gate.min_range) / image.gate.bin_size;
    if (bin < 0 || bin >= static_cast<double>(image.level_db.cols())) return;
    const auto row = static_cast<Eigen::Index>(turn) % image.level_db.rows();
    float& cell = image.level_db(row, static_cast<Eigen::Index>(bin));
    cell = std::max(cell, level_db);
  }

  /// Removes the bearings that hold nothing, unless they go all round.
  void crop() {
    std::vector<Eigen::Index> seen;
    std::vector<double> azimuth;
    for (Eigen::Index row = 0; row < image.level_db.rows(); ++row)
      if (image.level_db.row(row).maxCoeff() > silence_db) {
        seen.push_back(row);
        azimuth.push_back(image.fan.azimuth[static_cast<std::size_t>(row)]);
      }
    const Grid<float> kept = image.level_db(seen, Eigen::all);
    image.level_db = kept;
    image.fan.azimuth = azimuth;
    image.fan.elevation.assign(azimuth.size(), 0);
  }
};

}  // namespace

LevelImage sweep_of_head(const ImageRun& run, const ImageOptions& o, std::size_t ping) {
  BeamRecord record = beam_record(run, o, pings_of_sweep(run, ping));
  return sweep_image(record, run.cube.pings[ping].fan, 0, record.pings.size() - 1).image;
}

LevelImage sweep_in_world(const ImageRun& run, const ImageOptions& o, std::size_t ping) {
  const std::vector<Ping>& pings = run.cube.pings;
  const std::vector<std::size_t> sweep = pings_of_sweep(run, ping);
  const Ping& middle = pings[sweep[sweep.size() / 2]];
  const Pose reference = middle.world_from_head * Eigen::AngleAxisd(-middle.scan->angle, Eigen::Vector3d::UnitZ());

  // Extend the ranges by the farthest that the head was from the middle of the sweep.
  double gone = 0;
  for (const std::size_t p : sweep)
    gone = std::max(gone, (pings[p].world_from_head.translation() - reference.translation()).norm());
  const double step = step_of(pings, sweep);
  const auto bearings = static_cast<std::size_t>(std::clamp(std::ceil(4 * pi / step), 8.0, 4096.0));
  PolarRaster raster{levels_of(run, o, ping), 2 * pi / static_cast<double>(bearings)};
  LevelImage& image = raster.image;
  image.gate.max_range += std::ceil(gone / image.gate.bin_size) * image.gate.bin_size;
  image.level_db.setConstant(static_cast<Eigen::Index>(bearings), static_cast<Eigen::Index>(image.gate.bins()),
                             static_cast<float>(silence_db));
  image.fan.azimuth.clear();
  for (std::size_t b = 0; b < bearings; ++b)
    image.fan.azimuth.push_back(-pi + (static_cast<double>(b) + 0.5) * raster.width);
  image.fan.elevation.assign(bearings, 0);

  // Every sample covers the angle from beam to beam.
  constexpr int parts = 5;
  for (const std::size_t p : sweep) {
    const Pose here = reference.inverse() * pings[p].world_from_head;
    const LevelImage levels = levels_of(run, o, p);
    for (int part = 0; part < parts; ++part) {
      const double angle = step * ((part + 0.5) / parts - 0.5);
      const Eigen::Vector3d ahead = here.linear() * Eigen::Vector3d(std::cos(angle), std::sin(angle), 0);
      for (Eigen::Index n = 0; n < levels.level_db.cols(); ++n)
        raster.add(here.translation() + levels.gate.centre(static_cast<std::size_t>(n)) * ahead, levels.level_db(0, n));
    }
  }
  raster.crop();
  return image;
}

namespace {

/// The sweep of the ping.
void draw_scan(const PictureRequest& job) {
  const bool in_world = job.options.frame == "world";
  PictureOptions picture = job.picture;
  if (job.options.picture.title.empty())
    picture.title = fmt::format("{}, sweep {}{}", job.run.cube.sonar,
                                job.run.cube.pings[job.ping].scan.value_or(ScanDirection{}).sweep,
                                in_world ? ", motion compensated" : "");
  show_fan((in_world ? sweep_in_world : sweep_of_head)(job.run, job.options, job.ping), picture, job.path);
}

}  // namespace

ViewSpec scan_view() {
  return {.name = "scan",
          .shows = "the sweep of a scanning head",
          .options = {{"--frame",
                       &ImageOptions::frame,
                       "head, as an operator sees it, or world: the vehicle's motion compensated",
                       {.words = {"head", "world"}}}},
          .draw = draw_scan,
          .of_bearings = true};
}

}  // namespace insonify::tool
