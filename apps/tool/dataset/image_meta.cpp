// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <filesystem>

#include "core/units.hpp"
#include "tool/dataset/dataset.hpp"
#include "tool/dataset/labelled_image.hpp"

namespace insonify::tool {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

std::vector<double> degrees_of(const std::vector<double>& angles) {
  std::vector<double> all;
  for (const double angle : angles) all.push_back(degrees(angle));
  return all;
}

/// Between the outermost sides of the beams.
double field_of_view_deg(const BeamFan& fan) {
  const auto [least, most] = std::ranges::minmax(fan.azimuth);
  return degrees(most - least + fan.beam_width);
}

ordered_json randomised_json(const RandomisedPing& by) {
  return {{"source_level_db", by.source_level_db},
          {"noise_db", by.noise_db},
          {"temperature_c", by.temperature_c},
          {"salinity_psu", by.salinity_psu},
          {"position_m", {by.position.x(), by.position.y(), by.position.z()}},
          {"yaw_pitch_roll_deg", {degrees(by.angles[0]), degrees(by.angles[1]), degrees(by.angles[2])}}};
}

}  // namespace

ordered_json image_meta(const ImageOf& of, const DatasetOptions& options, GreyWindow window,
                        const std::vector<std::size_t>& polar_pixels) {
  const auto& [source, cube, ping, image] = of;
  ordered_json meta = {{"name", image.name},
                       {"split", image.split},
                       {"run", fs::path(source.run).filename().string()},
                       {"head", source.head},
                       {"scene", fs::path(source.scene).filename().string()},
                       {"scene_sha256", source.scene_digest},
                       {"ping", ping.number},
                       {"time", ping.time},
                       {"world_from_head", pose_json(ping.world_from_head)},
                       {"sonar", cube.sonar},
                       {"centre_frequency_hz", cube.centre_frequency},
                       {"bandwidth_hz", cube.bandwidth},
                       {"source_level_db", cube.source_level_db},
                       {"sound_speed", ping.sound_speed},
                       {"absorption_db_per_m", ping.absorption_db_per_m},
                       {"seed", cube.seed},
                       {"azimuths_deg", degrees_of(ping.fan.azimuth)},
                       {"elevations_deg", degrees_of(ping.fan.elevation)},
                       {"field_of_view_deg", field_of_view_deg(ping.fan)},
                       {"beam_width_deg", degrees(ping.fan.beam_width)},
                       {"elevation_width_deg", degrees(ping.fan.elevation_width)},
                       {"min_range_m", ping.gate.min_range},
                       {"max_range_m", ping.gate.max_range},
                       {"bin_size_m", ping.gate.bin_size},
                       {"mapping",
                        {{"min_db", window.min_db},
                         {"max_db", window.max_db},
                         {"tvg_db_per_decade", options.raw ? ordered_json() : ordered_json(options.tvg)}}},
                       {"polar_pixels", polar_pixels}};
  if (image.row) meta["row"] = *image.row, meta["row_elevation_deg"] = degrees(ping.fan.elevation.front());
  for (std::size_t p = 0; p < ping.labels.views.size(); ++p) {
    const Pose& pose = ping.labels.views[p].world_from_part;
    meta["parts"].push_back({{"part", ping.labels.part_names[p]},
                             {"class", ping.labels.part_labels[p]},
                             {"number", p + 1},
                             {"scale", ping.labels.views[p].scale},
                             {"size_m", numbers_json(ping.labels.views[p].size)},
                             {"world_from_part", pose.matrix().isIdentity(0) ? ordered_json() : pose_json(pose)}});
  }
  if (source.randomise.any())
    meta["randomised"] =
        randomised_json(randomised(source.randomise, source.seed, {.head = source.head_index, .number = ping.number}));
  return meta;
}

}  // namespace insonify::tool
