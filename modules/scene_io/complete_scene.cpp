// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <numeric>
#include <sstream>

#include "core/error.hpp"
#include "scene_io/complete_scene_internal.hpp"
#include "scene_io/scene_columns_internal.hpp"

namespace insonify {
namespace {

template <typename T>
void keep_only(std::vector<T>& column, const std::vector<std::uint32_t>& keep) {
  if (column.empty()) return;
  for (std::size_t i = 0; i < keep.size(); ++i) column[i] = column[keep[i]];
  column.resize(keep.size());
}

/// Returns true if no number occurs twice.
bool unique(std::vector<std::uint32_t> ids) {
  if (!std::is_sorted(ids.begin(), ids.end())) std::sort(ids.begin(), ids.end());
  return std::adjacent_find(ids.begin(), ids.end()) == ids.end();
}

/// Sets the ids: the file's if they are unique, else its row numbers, so that dropping a point renumbers no other.
void complete_ids(RawCloud& raw, LoadReport& report) {
  if (!raw.id.empty() && !unique(raw.id)) {
    report.notes.push_back("the ids in the file are not unique: renumbered by row");
    raw.id.clear();
  }
  if (!raw.id.empty()) return;
  raw.id.resize(raw.point.size());
  std::iota(raw.id.begin(), raw.id.end(), 0u);
}

/// Throws Error(argument) for intervals that are empty, refer to no given material, or overlap.
void check_intervals(const LoadOptions& options, const char* who) {
  const std::vector<MaterialInterval>& intervals = options.material_field.intervals;
  for (std::size_t i = 0; i < intervals.size(); ++i) {
    const MaterialInterval& a = intervals[i];
    if (!(a.from < a.to)) {
      fail(ErrorKind::argument, who, ": material_field.intervals[", i, "] = ", a.from, " .. ", a.to,
           ", from must be below to");
    }
    if (a.material >= options.materials.size() || options.materials.size() >= no_label) {
      fail(ErrorKind::argument, who, ": material_field.intervals[", i, "].material = ", a.material,
           ", must be below the number of options.materials, ", options.materials.size());
    }
    for (std::size_t j = 0; j < i; ++j) {
      const MaterialInterval& b = intervals[j];
      if (a.from < b.to && b.from < a.to) {
        fail(ErrorKind::argument, who, ": material_field.intervals[", j, "] = ", b.from, " .. ", b.to, " and [", i,
             "] = ", a.from, " .. ", a.to, " overlap; each value must belong to one material");
      }
    }
  }
}

/// Returns the typical spacing [m]: of the surfels of a cloud, of the vertices of a mesh.
double typical_spacing(const RawCloud& raw, std::vector<float> areas) {
  if (!raw.triangle.empty()) {
    const double total = static_cast<double>(areas.front()) * static_cast<double>(areas.size());
    return std::sqrt(total / static_cast<double>(raw.points_in_file));
  }
  const auto middle = areas.begin() + static_cast<std::ptrdiff_t>(areas.size() / 2);
  std::nth_element(areas.begin(), middle, areas.end());
  return std::sqrt(*middle);
}

}  // namespace

LoadReport begin_report(const RawCloud& raw) {
  LoadReport report;
  report.path = raw.path;
  report.format = raw.format;
  report.points_read = raw.points_in_file;
  report.triangles_read = raw.triangles_in_file;
  report.dropped_not_finite = raw.not_finite, report.dropped_withheld = raw.withheld;
  report.dropped_classes = raw.other_classes;
  report.notes = raw.notes;
  report.meaning = raw.meaning;
  for (std::string& note : raw.meaning.notes()) report.notes.push_back(std::move(note));
  report.other_columns = raw.other_columns;
  return report;
}

std::string share(std::size_t part, std::size_t whole, const char* noun) {
  std::ostringstream text;
  text.precision(2);
  text << part << " of " << whole << " " << noun << " ("
       << 100.0 * static_cast<double>(part) / static_cast<double>(std::max<std::size_t>(whole, 1)) << " %)";
  return text.str();
}

void note_no_area(double total_area, std::vector<std::string>& notes) {
  if (total_area > 0) return;
  notes.push_back(
      "all areas are 0, so nothing returns an echo: remove the field 'area' to have areas estimated, which takes four "
      "points or more");
}

void check_options(const LoadOptions& options, const char* who) {
  if (const double unit = options.meaning.unit.value_or(1); !(unit > 0) || !std::isfinite(unit)) {
    fail(ErrorKind::argument, who, ": unit = ", unit, " m, must be > 0; 0.001 for millimetres");
  }
  if (!(options.mesh_spacing >= 0) || !std::isfinite(options.mesh_spacing)) {
    fail(ErrorKind::argument, who, ": mesh_spacing = ", options.mesh_spacing, " m, must be >= 0 (0: chosen)");
  }
  if (options.normal_neighbours < 3) {
    fail(ErrorKind::argument, who, ": normal_neighbours = ", options.normal_neighbours, ", must be at least 3");
  }
  if (options.scan_noise && !(*options.scan_noise >= 0 && std::isfinite(*options.scan_noise))) {
    fail(ErrorKind::argument, who, ": scan_noise = ", *options.scan_noise, " m, must be finite and >= 0");
  }
  if (options.viewpoint && !options.viewpoint->allFinite()) {
    fail(ErrorKind::argument, who, ": viewpoint must be finite");
  }
  check_intervals(options, who);
}

std::vector<std::uint32_t> first_at_same_position(std::span<const Eigen::Vector3f> points) {
  constexpr std::uint32_t empty = std::numeric_limits<std::uint32_t>::max();
  const std::size_t slots = points.size() + points.size() / 2 + 1;
  std::vector<std::uint32_t> table(slots, empty), first(points.size());
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    first[i] = i;
    if (!points[i].allFinite()) continue;
    // Adding zero maps -0 to 0; the products mix all bits (Fibonacci hashing).
    const auto bits = [&](int axis) { return std::uint64_t{std::bit_cast<std::uint32_t>(points[i][axis] + 0.0f)}; };
    std::uint64_t hash = (bits(0) | bits(1) << 32) * 0x9e3779b97f4a7c15ull;
    hash = ((hash ^ hash >> 29) + bits(2)) * 0xbf58476d1ce4e5b9ull;
    std::size_t slot = (hash ^ hash >> 32) % slots;
    while (table[slot] != empty && points[table[slot]] != points[i]) slot = slot + 1 == slots ? 0 : slot + 1;
    if (table[slot] == empty) table[slot] = i;
    first[i] = table[slot];
  }
  return first;
}

std::size_t drop_unusable(RawCloud& raw) {
  const bool search = !raw.tags.prepared;  // save_scene writes no duplicates
  if (!search && raw.unused() == 0) return 0;
  std::vector<std::uint32_t> first;
  if (search) first = first_at_same_position(raw.point);
  first.resize(raw.point.size());
  if (!search) std::iota(first.begin(), first.end(), 0u);
  std::size_t duplicates = 0, kept = 0;
  for (std::uint32_t i = 0; i < first.size(); ++i) {
    if (!raw.point[i].allFinite()) continue;
    if (first[i] == i)
      first[kept++] = i;
    else
      ++duplicates;
  }
  first.resize(kept);
  keep_points(raw, first);
  return duplicates;
}

void keep_points(RawCloud& raw, const std::vector<std::uint32_t>& keep) {
  if (keep.size() == raw.point.size()) return;
  keep_only(raw.point, keep);
  keep_only(raw.normal, keep);
  keep_only(raw.area, keep);
  keep_only(raw.noise, keep);
  keep_only(raw.label, keep);
  keep_only(raw.id, keep);
  keep_only(raw.station, keep);
  for (SceneColumn& column : raw.columns) keep_rows(column, keep);
  if (!raw.raster.empty()) raw.raster = raster_triangles(raw.point);
  raw.surface.clear();
}

LoadedScene complete_scene(RawCloud raw, const LoadOptions& options) {
  LoadedScene result;
  result.report = begin_report(raw);
  SceneCloud& scene = result.scene;
  scene.origin = raw.origin;
  if (raw.triangle.empty()) {
    if (raw.bad_triangles > 0)
      fail(ErrorKind::content, raw.path, ": no usable triangle (", raw.bad_triangles,
           " polygons, all with corners that do not exist); export the mesh again");
    complete_ids(raw, result.report);
    find_viewpoint(raw, options, result.report.notes);
    result.report.dropped_duplicates = drop_unusable(raw);
    complete_normals(raw, options, result);
    complete_areas(raw, options, result.report);
    scene.point = std::move(raw.point);
    scene.normal = std::move(raw.normal);
    scene.area = std::move(raw.area);
    scene.material = std::move(raw.label);
    scene.id = std::move(raw.id);
    scene.noise = std::move(raw.noise);
    complete_noise(raw, options, result);
    complete_materials(raw, options, result);
    add_surface(raw, options, result);
  } else {
    if (raw.meaning.axes().mirrors())
      for (auto& triangle : raw.triangle) std::swap(triangle[1], triangle[2]);
    // The corners have the materials; surfels take those of their corners.
    scene.point = raw.point;
    scene.material = std::move(raw.label);
    complete_materials(raw, options, result);
    sample_mesh(raw, options, result);
  }
  if (options.keep_columns) take_columns(raw, options, result.columns);
  result.columns.system = result.corner_columns.system = raw.meaning.system.value;
  note_no_area(std::accumulate(scene.area.begin(), scene.area.end(), 0.0), result.report.notes);
  if (!raw.tags.prepared) {
    for (std::string& doubt : doubts_about(raw, typical_spacing(raw, scene.area))) {
      result.report.notes.push_back(std::move(doubt));
    }
  }
  require_valid(scene, "load_scene");
  return result;
}

}  // namespace insonify
