// SPDX-License-Identifier: BSD-3-Clause
#include "tool/compare/compare_soundings.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "scene/scene_index.hpp"
#include "scene_io/load_scene.hpp"
#include "store/csv_tables.hpp"
#include "tool/export/sounding_map.hpp"
#include "tool/run/any_scene.hpp"
#include "tool/run/ping_setup.hpp"

namespace insonify::tool {
namespace {

using nlohmann::ordered_json;

/// Mean heights by row and column.
class HeightCells {
 public:
  explicit HeightCells(double cell) : cell_(cell) {}
  void add(const Eigen::Vector3d& at) {
    auto& [sum, count] = cells_[{cell_of(at.y(), cell_), cell_of(at.x(), cell_)}];
    sum += at.z(), count += 1;
  }
  std::size_t size() const { return cells_.size(); }
  /// Differences of the means from those of `reference`, of cells that both have.
  std::vector<double> less(const HeightCells& reference) const {
    std::vector<double> differences;
    for (const auto& [at, own] : cells_)
      if (const auto other = reference.cells_.find(at); other != reference.cells_.end())
        differences.push_back(own.first / own.second - other->second.first / other->second.second);
    return differences;
  }

 private:
  double cell_;
  std::map<std::pair<std::int64_t, std::int64_t>, std::pair<double, double>> cells_;  ///< sum of heights, number
};

/// Distances [m] of the soundings from the nearest points of the scene.
std::vector<double> distances(const std::vector<Eigen::Vector3d>& soundings, const SceneCloud& scene) {
  const SceneIndex index(scene.point);
  std::vector<double> distance(soundings.size());
  parallel_blocks(soundings.size(), 256, 0, [&](std::size_t begin, std::size_t end) {
    std::vector<Neighbour> nearest;
    for (std::size_t i = begin; i < end; ++i) {
      index.find_nearest((soundings[i] - scene.origin).cast<float>(), 1, nearest);
      distance[i] = std::sqrt(static_cast<double>(nearest.front().squared_distance));
    }
  });
  return distance;
}

double quantile(std::vector<double> values, double share) {
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

}  // namespace

ordered_json compare_soundings(const CompareOptions& o) {
  if (!(o.cell > 0)) fail(ErrorKind::argument, "--cell = ", o.cell, " m, must be > 0");
  const std::vector<Eigen::Vector3d> soundings = load_positions(o.a);
  SceneOptions of_scene;
  of_scene.path = o.b;
  const SceneCloud scene = load_any_scene(o.common, of_scene).scene;
  HeightCells found(o.cell), given(o.cell);
  for (const Eigen::Vector3d& at : soundings) found.add(at);
  for (const Eigen::Vector3f& at : scene.point) given.add(scene.origin + at.cast<double>());
  const std::vector<double> differences = found.less(given);
  if (differences.size() < 2)
    fail(ErrorKind::content, o.a, ": ", differences.size(), " of its cells of ", o.cell, " m hold points of ", o.b,
         ", must be 2 at least; are both in one frame, or is --cell too small?");
  double sum = 0, squares = 0, largest = 0;
  for (const double d : differences) sum += d, largest = std::max(largest, std::abs(d));
  const double bias = sum / static_cast<double>(differences.size());
  for (const double d : differences) squares += (d - bias) * (d - bias);
  const std::vector<double> distance = distances(soundings, scene);
  constexpr double far = 0.5;  // [m]
  const auto beyond = std::count_if(distance.begin(), distance.end(), [](double d) { return d > far; });
  return {{"schema", 1},
          {"soundings", soundings.size()},
          {"cell_m", o.cell},
          {"cells", found.size()},
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
