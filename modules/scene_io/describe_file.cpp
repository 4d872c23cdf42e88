// SPDX-License-Identifier: BSD-3-Clause
#include "scene_io/describe_file.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "core/parallel.hpp"
#include "scene/scene_index.hpp"
#include "scene_io/complete_scene_internal.hpp"
#include "scene_io/scene_readers_internal.hpp"

namespace insonify {
namespace {

constexpr std::size_t most_queries = 20000;
constexpr std::size_t indexed_at_once = 1 << 20;  // an index takes some 30 bytes a point

/// Returns the median distance to the nearest neighbour of up to 20 000 points spread over the cloud.
double median_spacing(std::span<const Eigen::Vector3f> points) {
  if (points.size() < 2) return 0;
  const std::size_t queries = std::min(points.size(), most_queries);
  std::vector<double> distance(queries, std::numeric_limits<double>::infinity());
  for (std::size_t first = 0; first < points.size(); first += indexed_at_once) {
    const SceneIndex index(points.subspan(first, std::min(indexed_at_once, points.size() - first)));
    parallel_blocks(queries, 256, 0, [&](std::size_t begin, std::size_t end) {
      std::vector<Neighbour> nearest;
      for (std::size_t q = begin; q < end; ++q) {
        const std::size_t point = q * points.size() / queries;
        const bool among_them = point >= first && point < first + index.size();  // then it is the nearest itself
        index.find_nearest(points[point], among_them ? 2 : 1, nearest);
        if (nearest.size() > among_them)
          distance[q] = std::min(distance[q], std::sqrt(static_cast<double>(nearest.back().squared_distance)));
      }
    });
  }
  std::nth_element(distance.begin(), distance.begin() + queries / 2, distance.end());
  return distance[queries / 2];
}

/// Returns the areas by which materials are weighed [m^2]: those of the file if all are usable; for a corner of a mesh
/// a third of the area of its triangles. Empty if there are none.
std::vector<float> areas_of_points(RawCloud& raw) {
  if (raw.triangle.empty()) {
    const bool usable =
        std::all_of(raw.area.begin(), raw.area.end(), [](float a) { return std::isfinite(a) && a >= 0; });
    return usable ? std::move(raw.area) : std::vector<float>();
  }
  std::vector<float> area(raw.point.size(), 0.0f);
  for (const auto& [a, b, c] : raw.triangle) {
    const float third = (raw.point[b] - raw.point[a]).cross(raw.point[c] - raw.point[a]).norm() / 6;
    if (!std::isfinite(third)) continue;
    for (const std::uint32_t corner : {a, b, c}) area[corner] += third;
  }
  return area;
}

/// Sets the shares of the materials. Returns a problem if the labels cannot stand for materials.
std::string add_materials(RawCloud& raw, FileDescription& file) {
  if (!file.has_materials) return {};
  raw.label.resize(raw.point.size(), 0);
  const std::uint16_t largest = raw.label.empty() ? 0 : *std::max_element(raw.label.begin(), raw.label.end());
  std::string problem = label_problem(raw, raw.tags.materials, largest);
  if (problem.empty()) file.materials = material_shares(raw.tags.materials, raw.label, areas_of_points(raw));
  return problem;
}

/// Lists everything that load_scene would drop, repair or assume.
void add_problems(const RawCloud& raw, bool fans_out, FileDescription& file) {
  std::vector<std::string>& problems = file.problems;
  problems = raw.notes;
  if (raw.not_finite > 0)
    problems.push_back(share(raw.not_finite, file.points, "points") +
                       " are not finite, or beyond 1e9 m: will be dropped");
  if (raw.withheld > 0)
    problems.push_back(share(raw.withheld, file.points, "points") + " are marked as withheld: will be left out");
  if (file.duplicates > 0 && raw.triangle.empty())
    problems.push_back(share(file.duplicates, file.points, "points") +
                       " coincide with an earlier one: will be dropped");
  if (raw.bad_triangles > 0)
    problems.push_back(share(raw.bad_triangles, file.triangles, "polygons") +
                       " have corners that do not exist: will be dropped");
  if (fans_out) problems.push_back(fans_out_note);
  if (!file.has_normals && raw.triangle.empty())
    problems.push_back(fans_out                ? "no normals: will be estimated, towards that place"
                       : raw.viewpoint         ? "no normals: will be estimated, towards the viewpoint in the file"
                       : !raw.stations.empty() ? "no normals: will be estimated, towards the scanner of each point"
                       : looks_up(raw)
                           ? looks_up_note
                           : "no normals and no viewpoint: estimated normals will not be oriented; give a viewpoint");
  if (!raw.tags.oriented) problems.push_back("the normals are not oriented: both sides will reflect");
  for (std::string& doubt : doubts_about(raw, file.median_spacing)) problems.push_back(std::move(doubt));
}

}  // namespace

FileDescription describe_file(const std::string& path, const MeaningOverride& requested) {
  RawCloud raw = read_cloud(path, {.meaning = requested});
  FileDescription file;
  file.path = raw.path;
  file.format = raw.format;
  file.reader = reader_of(path).package;
  file.points = raw.points_in_file;
  file.triangles = raw.triangles_in_file;
  file.not_finite = raw.not_finite;
  file.withheld = raw.withheld;
  file.width = raw.width;
  file.height = raw.height;
  file.fields = raw.fields;
  file.meaning = raw.meaning.items();
  file.min = raw.box.min;
  file.max = raw.box.max;
  file.has_normals = !raw.normal.empty();
  file.has_area = !raw.area.empty();
  file.has_materials = !raw.label.empty() || !raw.tags.materials.empty();
  const std::optional<Eigen::Vector3d> seen_from = viewpoint_by_rows(raw);
  file.viewpoint = raw.viewpoint ? raw.viewpoint : seen_from;
  file.stations = raw.stations;
  // Count the materials of the points that are kept; for a mesh those of all corners.
  const bool mesh = !raw.triangle.empty();
  std::string bad_labels = mesh ? add_materials(raw, file) : "";
  file.duplicates = drop_unusable(raw);
  if (!mesh) bad_labels = add_materials(raw, file);
  file.median_spacing = median_spacing(raw.point);
  if (!file.has_normals && !file.viewpoint && file.stations.empty() && !mesh) raw.raster = raster_triangles(raw.point);
  add_problems(raw, seen_from.has_value(), file);
  if (!bad_labels.empty()) file.problems.push_back(std::move(bad_labels));
  return file;
}

}  // namespace insonify
