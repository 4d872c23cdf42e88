// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "core/text.hpp"
#include "sampling/trust_lines_of_sight.hpp"
#include "scene/estimate/height_triangles.hpp"
#include "scene/estimate/smoothed_heights.hpp"
#include "scene/estimate/surfel_area.hpp"
#include "scene/estimate/surfel_noise.hpp"
#include "scene_io/complete_scene_internal.hpp"

namespace insonify {
namespace {

constexpr double nearly_all = 0.98;  // share of the points

/// Returns true for an organised cloud with a viewpoint: it is one view, and all its lines of sight are known.
bool seen_at_once(const RawCloud& raw) { return raw.height > 1 && raw.viewpoint; }

/// Moves heights that show noise onto the surface among their neighbours (E160). The noise is that of the file, else of
/// the options, else the estimate. Returns false if no height shows noise.
bool smooth_heights(std::vector<float> noise, const LoadOptions& options, RawCloud& raw, LoadReport& report) {
  float largest = 0, farthest = 0;
  std::size_t noisy = 0;
  for (std::size_t i = 0; i < noise.size(); ++i) {
    if (noise[i] > 0 && !raw.noise.empty())
      noise[i] = std::isfinite(raw.noise[i]) ? raw.noise[i] : 0;
    else if (noise[i] > 0 && options.scan_noise)
      noise[i] = static_cast<float>(*options.scan_noise);
    largest = std::max(largest, noise[i]), noisy += noise[i] > 0;
  }
  if (noisy == 0) return false;
  raw.surface_height = smoothed_heights(raw.point, noise, options.threads);
  for (std::size_t i = 0; i < noise.size(); ++i)
    farthest = std::max(farthest, std::abs(raw.surface_height[i] - raw.point[i].z()));
  report.notes.push_back(printed(
      "%zu of %zu heights show noise, of %.3g m standard deviation: smoothed, by at most %.3g m; a scan noise of "
      "0 leaves them as they are",
      noisy, noise.size(), static_cast<double>(largest), static_cast<double>(farthest)));
  return true;
}

/// Sets the surface between the points of a height field. For a raster in which most points show their relief or all
/// are noisy, it has the triangles of the cells; else those of the plan, if nearly all points are of one height field.
void join_heights(const SurfelShapes& shapes, std::vector<std::array<std::uint32_t, 3>> raster,
                  const LoadOptions& options, RawCloud& raw, LoadReport& report) {
  const bool one_sheet = static_cast<double>(shapes.heights) >= nearly_all * static_cast<double>(raw.point.size());
  const bool relief = 2 * shapes.height_field >= raw.point.size();
  const bool is_raster = !raster.empty();
  if (!one_sheet && !(relief && is_raster)) return;
  if (relief || !smooth_heights(shapes.height_noise, options, raw, report))
    return set_surface(raw.point, std::move(raster), options.threads, raw);
  std::vector<Eigen::Vector3f> smooth = raw.point;
  for (std::size_t i = 0; i < smooth.size(); ++i) smooth[i].z() = raw.surface_height[i];
  set_surface(smooth, is_raster ? raster_triangles(smooth) : std::move(raster), options.threads, raw);
}

SurfelShapes shapes_of(const RawCloud& raw, const LoadOptions& options) {
  ShapeOptions shaping{.threads = options.threads, .keep_strays = options.keep_strays};
  if (raw.viewpoint) shaping.viewpoint = *raw.viewpoint - raw.origin;
  if (!seen_at_once(raw)) shaping.evenness_of_view = 4;
  return estimate_surfel_shapes(raw.point, raw.normal, shaping);
}

void take_areas(SurfelShapes& shapes, const LoadOptions& options, RawCloud& raw, LoadReport& report) {
  raw.area = std::move(shapes.area);
  report.areas_estimated = true;
  report.strays = shapes.strays;
  if (shapes.strays > 0)
    report.notes.push_back(share(shapes.strays, raw.point.size(), "points") + " stand far from all others: " +
                           (options.keep_strays ? "kept with areas as large as their cells"
                                                : "their areas are those of their neighbours"));
}

/// Sets the normals. One that would turn from the viewpoint stays as it is.
void take_normals(const SurfelShapes& shapes, RawCloud& raw) {
  for (std::size_t i = 0; i < raw.point.size(); ++i) {
    const auto viewpoint = raw.seen_from(i);
    const bool seen =
        !viewpoint || shapes.normal[i].cast<double>().dot(*viewpoint - raw.origin - raw.point[i].cast<double>()) > 0;
    if (seen) raw.normal[i] = shapes.normal[i];
  }
}

/// Sets the areas and, on rough surfaces, finer normals.
void complete_shapes(RawCloud& raw, const LoadOptions& options, LoadReport& report) {
  SurfelShapes shapes = shapes_of(raw, options);
  take_normals(shapes, raw);
  if (raw.heights && !raw.viewpoint) turn_up(raw.normal);
  if (!raw.only_surfels) join_heights(shapes, std::exchange(raw.raster, {}), options, raw, report);
  take_areas(shapes, options, raw, report);
}

/// Returns true if nearly all normals look up, or nearly all down: to one side of a height field.
bool look_one_way(const std::vector<Eigen::Vector3f>& normals) {
  std::size_t up = 0, down = 0;
  for (const Eigen::Vector3f& normal : normals) up += normal.z() > 0, down += normal.z() < 0;
  return static_cast<double>(std::max(up, down)) >= nearly_all * static_cast<double>(normals.size());
}

/// Sets the surface and the areas of a height field with normals of its own, which become those of the surface. Returns
/// false for other clouds.
bool complete_heights(RawCloud& raw, const LoadOptions& options, LoadReport& report) {
  if (!raw.area.empty() || raw.tags.prepared || !look_one_way(raw.normal)) return false;
  raw.raster = raster_triangles(raw.point);
  SurfelShapes shapes = shapes_of(raw, options);
  join_heights(shapes, std::exchange(raw.raster, {}), options, raw, report);
  if (raw.surface.empty()) return false;
  raw.surface_normals = true;
  take_areas(shapes, options, raw, report);
  return true;
}

}  // namespace

void set_surface(std::span<const Eigen::Vector3f> points, std::vector<std::array<std::uint32_t, 3>> raster, int threads,
                 RawCloud& raw) {
  raw.surface_name = raster.empty() ? "surface of heights" : "raster of heights";
  raw.surface = raster.empty() ? height_triangles(points, threads) : std::move(raster);
}

double largest_area(const RawCloud& raw) {
  if (raw.tags.prepared || raw.points_in_file < 4) return farthest_coordinate * farthest_coordinate;
  return 2 * (raw.box.max - raw.box.min).squaredNorm();
}

void complete_areas(RawCloud& raw, const LoadOptions& options, LoadReport& report) {
  if (raw.area.empty() && report.normals_estimated) return complete_shapes(raw, options, report);
  if (complete_heights(raw, options, report)) return;
  raw.raster.clear();  // points with areas of their own get no surface
  const double limit = largest_area(raw);
  const auto bad = [&](float area) { return !(area >= 0 && area <= limit); };
  const std::size_t wrong = static_cast<std::size_t>(std::count_if(raw.area.begin(), raw.area.end(), bad));
  if (!raw.area.empty() && wrong == 0) return;
  std::vector<float> estimates = estimate_surfel_areas(raw.point, raw.normal, {.threads = options.threads});
  report.areas_estimated = true;
  if (raw.area.empty()) {
    raw.area = std::move(estimates);
    return;
  }
  report.notes.push_back(share(wrong, raw.area.size(), "areas") +
                         " were negative, NaN or larger than the cloud: estimated");
  for (std::size_t i = 0; i < raw.area.size(); ++i) {
    if (bad(raw.area[i])) raw.area[i] = estimates[i];
  }
}

std::string bad_noise_note(std::size_t bad, std::size_t points) {
  return share(bad, points, "noise values") + " were negative or NaN: taken as 0";
}

void complete_group(const GroupCompletion& how, SceneCloud& group) {
  RawCloud raw;
  raw.origin = group.origin;
  raw.viewpoint = how.viewpoint;
  raw.point = std::move(group.point);
  const Eigen::Vector3f middle = (how.origin - group.origin).cast<float>();
  ShapeOptions shaping{.threads = how.options.threads, .keep_strays = how.options.keep_strays, .noise = how.noise};
  shaping.base = [&](const std::vector<std::uint32_t>& wanted) {
    std::vector<Eigen::Vector3f> found =
        estimate_normals(raw.point, wanted, how.options.normal_neighbours, how.options.threads, middle);
    for (Eigen::Vector3f& normal : found)
      if (!usable_normal(normal)) normal = Eigen::Vector3f::UnitZ();
    return found;
  };
  if (!how.areas || raw.viewpoint) {
    std::vector<std::uint32_t> all(raw.point.size());
    std::iota(all.begin(), all.end(), 0u);
    raw.normal = std::exchange(shaping.base, nullptr)(all);
    if (raw.viewpoint) face_viewpoints(raw);
  }
  if (how.areas) {
    SurfelShapes shapes = estimate_surfel_shapes(raw.point, raw.normal, shaping);
    raw.normal.resize(raw.point.size());
    take_normals(shapes, raw);
    group.area = std::move(shapes.area);
    if (how.noise) group.noise = std::move(shapes.noise);
  } else if (how.noise) {
    group.noise = estimate_surfel_noise(raw.point, {.threads = how.options.threads});
  }
  group.point = std::move(raw.point);
  group.normal = std::move(raw.normal);
}

void complete_noise(const RawCloud& raw, const LoadOptions& options, LoadedScene& result) {
  SceneCloud& scene = result.scene;
  const auto bad = [](float noise) { return !(std::isfinite(noise) && noise >= 0); };
  const auto wrong = static_cast<std::size_t>(std::count_if(scene.noise.begin(), scene.noise.end(), bad));
  if (wrong > 0) {
    result.report.notes.push_back(bad_noise_note(wrong, scene.size()));
    std::replace_if(scene.noise.begin(), scene.noise.end(), bad, 0.0f);
  }
  if (!scene.noise.empty()) return;
  if (options.scan_noise) scene.noise.assign(scene.size(), static_cast<float>(*options.scan_noise));
  if (options.scan_noise || raw.tags.prepared) return;
  scene.noise = estimate_surfel_noise(scene.point, {.threads = options.threads});
  result.report.noise_estimated = true;
  if (seen_at_once(raw)) trust_lines_of_sight(*raw.viewpoint, options.threads, scene);
  for (std::size_t k = 0; k < raw.stations.size(); ++k)
    trust_lines_of_sight(raw.stations[k], options.threads, scene, raw.station, static_cast<std::uint16_t>(k));
}

}  // namespace insonify
