// SPDX-License-Identifier: BSD-3-Clause
// Images with poses for neural reconstruction from imaging sonar, as the loader of neusis reads them.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numeric>
#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "core/units.hpp"
#include "files/path_status.hpp"
#include "files/pending_file.hpp"
#include "formats/pickle_file.hpp"
#include "returns/looks.hpp"
#include "run/ping_setup.hpp"
#include "run/run_checks.hpp"
#include "run_scenes/open_scene.hpp"
#include "run_scenes/parts_of_pings.hpp"
#include "run_scenes/stored_run.hpp"
#include "scene_io/save_cloud.hpp"
#include "tool/dataset/level_counts.hpp"
#include "tool/export/product_run.hpp"

namespace insonify::tool {
namespace {

namespace fs = std::filesystem;

constexpr Eigen::Index blanked_rows = 200;  // the farthest rows of an image, which that loader blanks
constexpr double white_share = 0.001;       // share of the samples that are white, as in data sets

Grid<float> gained_level(const Ping& ping) {
  return apply_tvg(shown_level_db(ping), ping.gate, GreyScale::tvg_of(ping));
}

/// Throws Error(content) for a fan that the layout cannot hold: it has columns evenly spaced about the axis.
void require_even_fan(const std::string& run, const BeamFan& fan) {
  if (fan_rows(fan).size() != 1 || fan.beams() < 3)
    fail(ErrorKind::content, run, ": --to neusis takes heads of one row of at least 3 beams");
  const auto [least, most] = std::ranges::minmax(fan.azimuth);
  if (std::abs(least + most) > 1e-6)
    fail(ErrorKind::content, run, ": --to neusis takes fans about the axis of the head; this one is from ",
         degrees(least), " to ", degrees(most), " degrees");
}

/// Positions of the columns among the beams in the order of their azimuths: the beam below, and how much of the next one.
/// Column j looks to -h / 2 + j h / W, so W is one less than the beams, and the last beam is left out.
std::vector<std::pair<std::size_t, double>> columns_of(const std::vector<double>& azimuth) {
  constexpr double rounding = 1e-6;  // share of the distance of two beams
  const std::size_t width = azimuth.size() - 1;
  std::vector<std::pair<std::size_t, double>> columns;
  for (std::size_t j = 0; j < width; ++j) {
    const double at =
        azimuth.front() + (azimuth.back() - azimuth.front()) * static_cast<double>(j) / static_cast<double>(width);
    const auto above = std::upper_bound(azimuth.begin(), azimuth.end() - 1, at) - azimuth.begin();
    std::size_t below = static_cast<std::size_t>(std::max<std::ptrdiff_t>(above - 1, 0));
    double share = (at - azimuth[below]) / (azimuth[below + 1] - azimuth[below]);
    if (share > 1 - rounding) ++below, share = 0;
    columns.emplace_back(below, share < rounding ? 0 : share);
  }
  return columns;
}

/// Returns the amplitude of a ping over `white_db`, at most 1: a row for each sample, the nearest first, then the rows
/// that the loader blanks; a column for each direction from starboard to port.
Grid<float> neusis_image(const Ping& ping, double white_db) {
  const Grid<float> level = gained_level(ping);
  std::vector<std::size_t> order(ping.fan.beams());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, {}, [&](std::size_t b) { return ping.fan.azimuth[b]; });
  std::vector<double> azimuth;
  for (const std::size_t b : order) azimuth.push_back(ping.fan.azimuth[b]);
  const auto columns = columns_of(azimuth);
  Grid<float> image = Grid<float>::Zero(level.cols() + blanked_rows, static_cast<Eigen::Index>(columns.size()));
  const auto energy = [&](std::size_t beam, Eigen::Index n) {
    return power_from_db(static_cast<double>(level(static_cast<Eigen::Index>(order[beam]), n)) - white_db);
  };
  for (std::size_t j = 0; j < columns.size(); ++j)
    for (Eigen::Index n = 0; n < level.cols(); ++n) {
      const auto [below, share] = columns[j];
      const double sum = (1 - share) * energy(below, n) + (share > 0 ? share * energy(below + 1, n) : 0);
      image(n, static_cast<Eigen::Index>(j)) = static_cast<float>(std::min(1.0, std::sqrt(sum)));  // (E199)
    }
  return image;
}

/// Returns Config.json: apertures [deg] and ranges [m] of the head, with the rows that the loader blanks.
nlohmann::ordered_json config_of(const std::string& sonar, const Ping& ping) {
  const auto [least, most] = std::ranges::minmax(ping.fan.azimuth);
  const auto rows = static_cast<double>(ping.pressure.cols() + blanked_rows);
  const nlohmann::ordered_json configuration = {{"Azimuth", degrees(most - least)},
                                                {"Elevation", degrees(ping.fan.elevation_width)},
                                                {"RangeMin", ping.gate.min_range},
                                                {"RangeMax", ping.gate.min_range + rows * ping.gate.bin_size},
                                                {"RangeBins", ping.pressure.cols() + blanked_rows},
                                                {"AzimuthBins", ping.fan.beams() - 1}};
  const nlohmann::ordered_json sensor = {
      {"sensor_type", "ImagingSonar"}, {"sensor_name", sonar}, {"configuration", configuration}};
  return {{"agents", {{{"agent_name", "vehicle"}, {"sensors", {sensor}}}}}};
}

/// Returns the folder that holds the run.toml of the pings: that of a run, or of the head of a survey.
std::string settings_folder_of(const ProductOptions& o) {
  if (!is_folder(o.run)) return fs::path(o.run).parent_path().string();
  const std::vector<std::string> heads = head_names(o.run);
  return heads.empty() ? o.run : (fs::path(o.run) / (o.head.empty() ? heads.front() : o.head)).string();
}

/// Writes the scene of the first ping beside the images, as a mesh if it is one; returns why not, or nothing.
std::string write_truth(const PlacedRun& run, const Ping& first, RunDirectory& directory) {
  try {
    const StoredRun folder(settings_folder_of(run.options));
    const SceneOptions scene = folder.scene();
    if (scene.path.empty()) return "does not name its scene";
    const auto open = folder.open_scene(scene, 0);
    save_scene(directory.file("truth.ply"), open->take_whole(open->moment_of(first.time, first.number)));
    return {};
  } catch (const Error& error) {
    return error.what();
  }
}

}  // namespace

std::size_t neusis_product(const PlacedRun& run, RunDirectory& directory, std::vector<std::string>& notes) {
  LevelCounts levels;
  std::optional<Ping> first;
  std::string sonar;
  each_ping(run.pings, [&](const Cube& cube, const Ping& ping) {
    if (!first) require_even_fan(run.options.run, ping.fan), first = ping, sonar = cube.sonar;
    levels.add(gained_level(ping));
  });
  if (!first) fail(ErrorKind::content, run.options.run, ": has no pings");
  const double white_db = levels.exceeded_by(white_share);
  fs::create_directories(directory.file("Data"));
  std::size_t pings = 0;
  each_ping(run.pings, [&](const Cube&, const Ping& ping) {
    write_pickle(directory.file(fmt::format("Data/{:06}.pkl", pings++)),
                 {named_array("ImagingSonar", neusis_image(ping, white_db)),
                  named_array("PoseSensor", ping.world_from_head.matrix())});
  });
  write_file(directory.file("Config.json"), config_of(sonar, *first).dump(2) + "\n");
  if (const std::string why = write_truth(run, *first, directory); !why.empty())
    notes.push_back("no truth.ply: " + run.options.run + ": " + why);
  write_manifest(directory, {{"schema", 1},
                             {"insonify_version", INSONIFY_VERSION},
                             {"exported", run.options.run},
                             {"white_db", white_db},
                             {"levels", "dB re 1 uPa at 1 m"},
                             {"image", "amplitude = 10^((level - white_db) / 20), at most 1"},
                             {"rows_of_samples", first->pressure.cols()},
                             {"pings", pings}});
  directory.commit();
  return pings;
}

}  // namespace insonify::tool
