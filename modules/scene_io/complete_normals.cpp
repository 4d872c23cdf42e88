// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "scene/scene_index.hpp"
#include "scene_io/complete_scene_internal.hpp"

namespace insonify {
namespace {

using Eigen::Vector3f;

/// Returns the normal with the sign that faces the viewpoint (point and viewpoint relative to the same origin).
Vector3f facing(const Vector3f& normal, const Vector3f& point, const Eigen::Vector3d& viewpoint) {
  return normal.cast<double>().dot(viewpoint - point.cast<double>()) < 0 ? Vector3f(-normal) : normal;
}

/// Estimates the normals listed in `bad`, with the sign of the valid normals around them.
void repair(RawCloud& raw, const std::vector<std::uint32_t>& bad, const LoadOptions& options) {
  const std::vector<Vector3f> estimates = estimate_normals(raw.point, bad, options.normal_neighbours, options.threads);
  const SceneIndex index(raw.point);
  std::vector<Vector3f> repaired = estimates;
  parallel_for(bad.size(), options.threads, [&](std::size_t b) {
    std::vector<Neighbour> around;
    index.find_nearest(raw.point[bad[b]], static_cast<std::size_t>(options.normal_neighbours), around);
    Vector3f sum = Vector3f::Zero();
    for (const Neighbour& n : around) {
      if (usable_normal(raw.normal[n.index])) sum += raw.normal[n.index].normalized();
    }
    if (sum.dot(estimates[b]) < 0) repaired[b] = -estimates[b];
    const auto viewpoint = raw.seen_from(bad[b]);
    if (sum.isZero() && viewpoint) repaired[b] = facing(estimates[b], raw.point[bad[b]], *viewpoint - raw.origin);
  });
  for (std::size_t b = 0; b < bad.size(); ++b) raw.normal[bad[b]] = repaired[b];
}

/// Returns true if the position is known from which each point was seen.
bool seen_from_somewhere(const RawCloud& raw) { return raw.viewpoint || !raw.stations.empty(); }

/// Orients all normals towards where their points were seen from.
void face_viewpoint(RawCloud& raw, LoadedScene& result) {
  face_viewpoints(raw);
  result.report.viewpoint = raw.viewpoint;
  result.scene.normals_oriented = true;
}

/// Estimates all normals. Orients them towards the viewpoint if there is one, else up for a raster of heights.
void estimate_all(RawCloud& raw, const LoadOptions& options, LoadedScene& result) {
  std::vector<std::uint32_t> all(raw.point.size());
  std::iota(all.begin(), all.end(), 0u);
  raw.normal = estimate_normals(raw.point, all, options.normal_neighbours, options.threads);
  result.report.normals_estimated = true;
  result.scene.normals_oriented = false;
  raw.raster = raster_triangles(raw.point);
  if (seen_from_somewhere(raw)) return face_viewpoint(raw, result);
  if (looks_up(raw)) {
    turn_up(raw.normal);
    raw.heights = true;
    result.scene.normals_oriented = true;
    result.report.notes.push_back(looks_up_note);
    return;
  }
  result.report.notes.push_back(
      two_sided_note + std::string(raw.height > 1 ? " (an organised cloud in camera axes was seen from 0,0,0)" : ""));
}

/// Adds a note if most normals of the file face away from the viewpoint: inward or unoriented normals are likely.
void compare_with_viewpoint(const RawCloud& raw, LoadedScene& result) {
  if (!seen_from_somewhere(raw)) return;
  std::size_t away = 0;
  for (std::size_t i = 0; i < raw.point.size(); ++i)
    away += facing(raw.normal[i], raw.point[i], *raw.seen_from(i) - raw.origin) != raw.normal[i];
  if (4 * away > raw.point.size()) {
    result.report.notes.push_back(share(away, raw.point.size(), "normals") +
                                  " of the file look away from the viewpoint: check that they point outwards");
  }
}

}  // namespace

void face_viewpoints(RawCloud& raw) {
  for (std::size_t i = 0; i < raw.point.size(); ++i)
    raw.normal[i] = facing(raw.normal[i], raw.point[i], *raw.seen_from(i) - raw.origin);
}

void turn_up(std::vector<Vector3f>& normals) {
  for (Vector3f& normal : normals)
    if (normal.z() < 0) normal = -normal;
}

bool usable_normal(const Vector3f& normal) { return normal.allFinite() && normal.norm() > 1e-12f; }

std::size_t renormalise(std::vector<Vector3f>& normals, bool prepared) {
  std::size_t off = 0;
  for (Vector3f& n : normals) {
    if (!usable_normal(n)) continue;
    const double length = n.cast<double>().norm();
    off += std::abs(length - 1) > 1e-3;
    if (std::abs(length - 1) > (prepared ? 1e-3 : 1e-6)) n = (n.cast<double>() / length).cast<float>();
  }
  return off;
}

void complete_normals(RawCloud& raw, const LoadOptions& options, LoadedScene& result) {
  std::vector<std::uint32_t> bad;
  for (std::size_t i = 0; i < raw.normal.size(); ++i) {
    if (!usable_normal(raw.normal[i])) bad.push_back(static_cast<std::uint32_t>(i));
  }
  if (bad.size() == raw.normal.size()) {
    if (!bad.empty()) result.report.notes.push_back("all normals of the file are zero or NaN: estimated anew");
    estimate_all(raw, options, result);
  } else {
    if (!bad.empty()) repair(raw, bad, options);
    result.report.repaired_normals = bad.size();
    const std::size_t off = renormalise(raw.normal, raw.tags.prepared);
    if (off > 0)
      result.report.notes.push_back(share(off, raw.normal.size(), "normals") + " were not unit vectors: scaled");
    result.scene.normals_oriented = raw.tags.oriented;
    if (!raw.tags.oriented && seen_from_somewhere(raw))
      face_viewpoint(raw, result);
    else if (!raw.tags.prepared)
      compare_with_viewpoint(raw, result);
  }

  // Drop points that still have no normal; they cannot reflect.
  std::vector<std::uint32_t> keep;
  keep.reserve(raw.point.size());
  for (std::size_t i = 0; i < raw.point.size(); ++i) {
    if (usable_normal(raw.normal[i])) keep.push_back(static_cast<std::uint32_t>(i));
  }
  result.report.dropped_without_normal = raw.point.size() - keep.size();
  result.report.repaired_normals -= std::min(result.report.repaired_normals, result.report.dropped_without_normal);
  if (keep.empty()) {
    fail(ErrorKind::content, raw.path, ": no usable point: the ", raw.point.size(),
         " finite points give no normal (at least 3 are needed); give a denser cloud");
  }
  keep_points(raw, keep);
}

}  // namespace insonify
