// SPDX-License-Identifier: BSD-3-Clause
#include "scene_io/describe_file.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "core/parallel.hpp"
#include "scene/scene_index.hpp"
#include "scene_io/complete_scene_internal.hpp"
#include "scene_io/scene_readers_internal.hpp"

namespace insonify {
namespace {

constexpr std::size_t most_queries = 20000;

/// The finite points without duplicates: those of `raw` themselves, or in `kept` if some are dropped.
std::span<const Eigen::Vector3f> distinct_points(const RawCloud& raw, std::vector<Eigen::Vector3f>& kept,
                                                 std::size_t& duplicates) {
  const bool all_finite = raw.unused() == 0;
  if (all_finite && raw.tags.prepared) return raw.point;  // save_scene writes no duplicates
  const std::vector<std::uint32_t> first = first_at_same_place(raw.point);
  for (std::uint32_t i = 0; i < first.size(); ++i) duplicates += first[i] != i;
  if (all_finite && duplicates == 0) return raw.point;
  kept.reserve(first.size());
  for (std::uint32_t i = 0; i < first.size(); ++i)
    if (first[i] == i && raw.point[i].allFinite()) kept.push_back(raw.point[i]);
  return kept;
}

/// Median distance to the nearest neighbour of up to 20 000 points spread over the cloud.
double median_spacing(std::span<const Eigen::Vector3f> points) {
  if (points.size() < 2) return 0;
  const SceneIndex index(points);
  const std::size_t queries = std::min(points.size(), most_queries);
  std::vector<double> distance(queries);
  parallel_blocks(queries, 256, 0, [&](std::size_t begin, std::size_t end) {
    std::vector<Neighbour> nearest;
    for (std::size_t q = begin; q < end; ++q) {
      index.find_nearest(points[q * points.size() / queries], 2, nearest);
      distance[q] = std::sqrt(nearest.back().squared_distance);
    }
  });
  std::nth_element(distance.begin(), distance.begin() + queries / 2, distance.end());
  return distance[queries / 2];
}

/// The areas by which materials are weighed [m^2]: those of the file if all are usable, of a mesh a third of each
/// corner's triangles; empty if there are none.
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

/// Shares of the materials, or a problem if the labels cannot stand for materials. Takes labels and areas.
void add_materials(RawCloud& raw, FileDescription& file) {
  if (!file.has_materials) return;
  std::vector<std::uint16_t> label = std::move(raw.label);
  label.resize(raw.point.size(), 0);
  std::vector<float> area = areas_of_points(raw);
  if (raw.triangle.empty() && file.duplicates + raw.unused() > 0) {
    const std::vector<std::uint32_t> first = first_at_same_place(raw.point);
    std::size_t kept = 0;
    for (std::uint32_t i = 0; i < first.size(); ++i) {
      if (first[i] != i || !raw.point[i].allFinite()) continue;
      label[kept] = label[i];
      if (!area.empty()) area[kept] = area[i];
      ++kept;
    }
    label.resize(kept);
    if (!area.empty()) area.resize(kept);
  }
  const std::uint16_t largest = label.empty() ? 0 : *std::max_element(label.begin(), label.end());
  if (std::string problem = label_problem(raw, raw.tags.materials, largest); !problem.empty())
    file.problems.push_back(std::move(problem));
  else
    file.materials = material_shares(raw.tags.materials, label, area);
}

/// Lists what load_scene would drop, repair or assume.
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
    problems.push_back(fans_out        ? "no normals: will be estimated, towards that place"
                       : raw.viewpoint ? "no normals: will be estimated, towards the viewpoint in the file"
                       : looks_up(raw)
                           ? looks_up_note
                           : "no normals and no viewpoint: estimated normals will not be oriented; give a viewpoint");
  if (!raw.tags.oriented) problems.push_back("the normals are not oriented: both sides will reflect");
  for (std::string& doubt : doubts_about(raw, file.median_spacing)) problems.push_back(std::move(doubt));
}

}  // namespace

FileDescription describe_file(const std::string& path, const AskedMeaning& asked) {
  RawCloud raw = read_cloud(path, {.meaning = asked});
  FileDescription file;
  file.path = raw.path;
  file.format = raw.format;
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
  std::vector<Eigen::Vector3f> kept;
  const std::span<const Eigen::Vector3f> distinct = distinct_points(raw, kept, file.duplicates);
  file.median_spacing = median_spacing(distinct);
  file.has_normals = !raw.normal.empty();
  file.has_area = !raw.area.empty();
  file.has_materials = !raw.label.empty() || !raw.tags.materials.empty();
  const std::optional<Eigen::Vector3d> seen_from = viewpoint_by_rows(raw);
  file.viewpoint = raw.viewpoint ? raw.viewpoint : seen_from;
  if (!file.has_normals && !file.viewpoint && raw.triangle.empty()) raw.raster = raster_triangles(distinct);
  add_problems(raw, seen_from.has_value(), file);
  add_materials(raw, file);
  return file;
}

}  // namespace insonify
