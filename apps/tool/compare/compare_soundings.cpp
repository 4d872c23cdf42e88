// SPDX-License-Identifier: BSD-3-Clause
#include "tool/compare/compare_soundings.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "files/path_status.hpp"
#include "run/ping_setup.hpp"
#include "run_scenes/parts_of_pings.hpp"
#include "run_scenes/stored_run.hpp"
#include "scene/scene_index.hpp"
#include "scene_io/load_scene.hpp"
#include "store/csv_tables.hpp"
#include "store/cube.hpp"
#include "tool/export/sounding_map.hpp"
#include "tool/run/run_pings.hpp"

namespace insonify::tool {
namespace {

using nlohmann::ordered_json;

constexpr double latest_scene_time = 1e8;  // [s]; what is later counts from 1970

/// The scene of soundings: one for all, or of parts as they stood at the ping of each.
struct SceneOfSoundings {
  std::shared_ptr<const PartsOfPings> parts;  ///< absent: `whole` is of all
  std::vector<SceneMoment> moment;            ///< moment of each sounding; empty without parts
  std::shared_ptr<const SceneCloud> whole;
};

/// The moments of soundings by the run that they are of.
std::vector<SceneMoment> moments_of_run(const CompareOptions& o, const SoundingTable& table, const RunPings& run,
                                        const PartsOfPings& parts) {
  if (table.ping.empty())
    fail(ErrorKind::content, o.a, ": has no column ping, by which parts are placed; export --to csv writes it");
  std::map<std::int64_t, double> time;
  for (const std::string& cube : run.cubes)
    for (const TrackPoint& ping : read_track(cube)) time[ping.number] = ping.time;
  std::vector<SceneMoment> moments;
  for (const std::int64_t number : table.ping) {
    const auto found = time.find(number);
    if (found == time.end()) fail(ErrorKind::content, o.a, ": ping ", number, " is not one of ", o.b);
    moments.push_back(parts.moment_of(found->second, number));
  }
  return moments;
}

/// The moments of soundings by their times, of a scene file alone.
std::vector<SceneMoment> moments_of_times(const CompareOptions& o, const SoundingTable& table,
                                          const PartsOfPings& parts) {
  const bool moves = parts.scene().moves();
  if (moves && table.time.empty())
    fail(ErrorKind::content, o.a, ": has no column time_s, but parts of ", o.b, " move; export --to csv writes it");
  std::vector<SceneMoment> moments(table.position.size(), {parts.scene().begin(), 0});
  for (std::size_t i = 0; moves && i < moments.size(); ++i) {
    moments[i].time = table.time[i];
    if (table.time[i] > latest_scene_time)
      fail(ErrorKind::content, o.a, ": time_s counts from 1970, but parts of ", o.b,
           " move from time 0 on; give the run or the survey's head of the soundings in place of the scene");
  }
  return moments;
}

SceneOfSoundings scene_of_soundings(const CompareOptions& o, const SoundingTable& table) {
  SceneOfSoundings scene;
  SceneOptions options;
  options.path = o.b;
  std::string folder;
  if (is_folder(o.b)) {
    const std::vector<std::string> heads = head_names(o.b);
    folder = heads.size() == 1 ? (std::filesystem::path(o.b) / heads.front()).string() : o.b;
    options = StoredRun(folder).scene();
    if (options.path.empty())
      fail(ErrorKind::content, o.b,
           heads.size() > 1 ? ": is a survey of several heads; give the folder of one"
                            : ": does not say what its scene was; give the scene");
  }
  const auto opened = folder.empty() ? open_scene(options, {{o.common.seed, {}}, o.common.threads})
                                     : StoredRun(folder).open_scene(options, o.common.threads, o.common.seed);
  scene.parts = {opened, opened->parts()};
  if (!scene.parts)
    scene.whole = std::make_shared<const SceneCloud>(opened->take_whole({}).scene);
  else
    scene.moment = folder.empty() ? moments_of_times(o, table, *scene.parts)
                                  : moments_of_run(o, table, find_run_pings(o.b, ""), *scene.parts);
  return scene;
}

using HeightCell = std::pair<std::int64_t, std::int64_t>;  ///< row and column

/// Mean heights by row and column of points of a scene, and the nearest of them.
class ScenePoints {
 public:
  ScenePoints(const SceneCloud& scene, std::size_t begin, std::size_t end, double cell)
      : origin_(scene.origin), cell_(cell) {
    const std::vector<Eigen::Vector3f> points(scene.point.begin() + static_cast<std::ptrdiff_t>(begin),
                                              scene.point.begin() + static_cast<std::ptrdiff_t>(end));
    if (!points.empty()) index_.emplace(points);
    for (const Eigen::Vector3f& point : points) {
      auto& [sum, count] = cells_[cell_at(origin_ + point.cast<double>())];
      sum += origin_.z() + static_cast<double>(point.z()), count += 1;
    }
  }
  HeightCell cell_at(const Eigen::Vector3d& at) const { return {cell_of(at.y(), cell_), cell_of(at.x(), cell_)}; }
  /// Sum of heights [m] in a cell, and how many.
  std::pair<double, double> heights_in(const HeightCell& cell) const {
    const auto found = cells_.find(cell);
    return found == cells_.end() ? std::pair(0.0, 0.0) : found->second;
  }
  /// Distance from the nearest point [m]; infinite without points.
  double distance(const Eigen::Vector3d& at) const {
    if (!index_) return std::numeric_limits<double>::infinity();
    std::vector<Neighbour> nearest;
    index_->find_nearest((at - origin_).cast<float>(), 1, nearest);
    return std::sqrt(static_cast<double>(nearest.front().squared_distance));
  }

 private:
  Eigen::Vector3d origin_;
  double cell_;
  std::optional<SceneIndex> index_;
  std::map<HeightCell, std::pair<double, double>> cells_;
};

struct SoundingDifferences {
  std::vector<double> distance;  ///< [m] of each from the nearest point of the scene
  std::map<HeightCell, std::pair<double, double>>
      height;             ///< in each cell: sum of differences of height [m], and how many
  std::size_t cells = 0;  ///< number of cells that hold a sounding
};

/// Rows of soundings of one moment; of a scene without parts all.
std::vector<std::vector<std::size_t>> rows_by_moment(const SceneOfSoundings& scene, std::size_t rows) {
  std::map<std::pair<double, std::uint64_t>, std::vector<std::size_t>> of;
  for (std::size_t i = 0; i < rows; ++i) {
    const SceneMoment moment = scene.parts ? scene.moment[i] : SceneMoment{};
    of[{moment.time, moment.draw}].push_back(i);
  }
  std::vector<std::vector<std::size_t>> groups;
  for (auto& [moment, group] : of) groups.push_back(std::move(group));
  return groups;
}

/// Compares each sounding with the scene of its ping. What rests is indexed once: it comes first in all of them.
SoundingDifferences differences_of(const std::vector<Eigen::Vector3d>& soundings, const SceneOfSoundings& scene,
                                   double cell) {
  SoundingDifferences result;
  result.distance.resize(soundings.size());
  std::set<HeightCell> cells;
  std::optional<ScenePoints> rests;
  for (const std::vector<std::size_t>& rows : rows_by_moment(scene, soundings.size())) {
    const std::shared_ptr<const SceneCloud> cloud =
        scene.parts ? scene.parts->cloud_at(scene.moment[rows.front()]) : scene.whole;
    std::size_t resting = cloud->size();
    if (scene.parts) {
      const std::size_t parts = scene.parts->scene().resting().size();
      resting = static_cast<std::size_t>(std::ranges::lower_bound(cloud->part, parts) - cloud->part.begin());
    }
    if (!rests) rests.emplace(*cloud, 0, resting, cell);
    const ScenePoints others(*cloud, resting, cloud->size(), cell);
    parallel_blocks(rows.size(), 256, 0, [&](std::size_t begin, std::size_t end) {
      for (std::size_t k = begin; k < end; ++k) {
        const Eigen::Vector3d& at = soundings[rows[k]];
        result.distance[rows[k]] = std::min(rests->distance(at), others.distance(at));
      }
    });
    for (const std::size_t row : rows) {
      const HeightCell of = rests->cell_at(soundings[row]);
      const auto [sum, count] = rests->heights_in(of);
      const auto [other_sum, other_count] = others.heights_in(of);
      cells.insert(of);
      if (count + other_count == 0) continue;
      auto& [differences, compared] = result.height[of];
      differences += soundings[row].z() - (sum + other_sum) / (count + other_count), compared += 1;
    }
  }
  result.cells = cells.size();
  return result;
}

double quantile(std::vector<double> values, double share) {
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

}  // namespace

ordered_json compare_soundings(const CompareOptions& o) {
  if (!(o.cell > 0)) fail(ErrorKind::argument, "--cell = ", o.cell, " m, must be > 0");
  const SoundingTable table = load_sounding_table(o.a);
  const std::vector<Eigen::Vector3d>& soundings = table.position;
  const SoundingDifferences found = differences_of(soundings, scene_of_soundings(o, table), o.cell);
  std::vector<double> differences;
  for (const auto& [cell, of] : found.height) differences.push_back(of.first / of.second);
  if (differences.size() < 2)
    fail(ErrorKind::content, o.a, ": ", differences.size(), " of its cells of ", o.cell, " m hold points of ", o.b,
         ", must be 2 at least; are both in one frame, or is --cell too small?");
  double sum = 0, squares = 0, largest = 0;
  for (const double d : differences) sum += d, largest = std::max(largest, std::abs(d));
  const double bias = sum / static_cast<double>(differences.size());
  for (const double d : differences) squares += (d - bias) * (d - bias);
  const std::vector<double>& distance = found.distance;
  constexpr double far = 0.5;  // [m]
  const auto beyond = std::count_if(distance.begin(), distance.end(), [](double d) { return d > far; });
  return {{"schema", 1},
          {"soundings", soundings.size()},
          {"cell_m", o.cell},
          {"cells", found.cells},
          {"cells_compared", differences.size()},
          {"bias_m", bias},
          {"deviation_m", std::sqrt(squares / static_cast<double>(differences.size() - 1))},
          {"largest_m", largest},
          {"median_distance_m", quantile(distance, 0.5)},
          {"distance_95_m", quantile(distance, 0.95)},
          {"beyond_half_metre", beyond},
          {"share_beyond_half_metre", static_cast<double>(beyond) / static_cast<double>(distance.size())}};
}

std::string soundings_table(const ordered_json& r) {
  const auto number = [&](const char* key) { return r[key].get<double>(); };
  return fmt::format(
      "{} soundings in {} cells of {:g} m, {} of which hold points of the scene\n"
      "height of soundings less that of the scene: bias {:.4f} m, deviation {:.4f} m, at most {:.3f} m\n"
      "distance from the nearest point of the scene: median {:.4f} m, 95 % within {:.4f} m; {} ({:.3g} %) beyond 0.5 "
      "m\n",
      r["soundings"].get<std::size_t>(), r["cells"].get<std::size_t>(), number("cell_m"),
      r["cells_compared"].get<std::size_t>(), number("bias_m"), number("deviation_m"), number("largest_m"),
      number("median_distance_m"), number("distance_95_m"), r["beyond_half_metre"].get<std::size_t>(),
      100 * number("share_beyond_half_metre"));
}

}  // namespace insonify::tool
