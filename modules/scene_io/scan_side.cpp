// SPDX-License-Identifier: BSD-3-Clause
// Finds the side from which a cloud was seen, if neither its file nor the options state it. Neighbours of an organised
// scan lie at even steps of direction from the scanner, at any distance. From any other position relief and noise make
// these steps uneven, as they make the points uneven themselves.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <vector>

#include "core/text.hpp"
#include "scene_io/complete_scene_internal.hpp"

namespace insonify {
namespace {

using Eigen::Vector3d;

constexpr std::size_t most_triples = 20000, fewest_triples = 64;    // along rows, and along columns
constexpr double typical_unevenness = 0.1, most_unevenness = 0.25;  // of directions: median, and quantile 0.95
constexpr double least_relief = 0.1, contrast = 4;  // unevenness of points, quantile 0.99; ratio to that of directions
constexpr double widest_step = 8;  // ratio to the narrowest; pictures and turning scanners have wider steps midway

/// The second differences over half the first ones, for neighbours in threes.
struct Unevenness {
  std::vector<double> directions;  ///< seen from the origin of the coordinates, across the line of sight
  std::vector<double> points;
  std::vector<double> step;  ///< angle between directions [rad]
};

double quantile(std::vector<double> values, double part) {
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(part * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

/// Returns the unevenness of neighbours along the rows or the columns of an organised cloud.
Unevenness unevenness_along(const RawCloud& raw, bool rows) {
  const std::size_t step = rows ? 1 : raw.width, size = raw.point.size();
  const std::size_t stride = size / most_triples + 1;
  Unevenness found;
  for (std::size_t i = step; i + step < size; i += stride) {
    const std::size_t column = i % raw.width;
    if (rows && (column == 0 || column + 1 == raw.width)) continue;
    const auto position = [&](std::size_t at) -> Vector3d { return raw.origin + raw.point[at].cast<double>(); };
    const Vector3d before = position(i - step), here = position(i), behind = position(i + step);
    const Vector3d a = before.normalized(), b = here.normalized(), c = behind.normalized();
    const double first = (c - a).norm(), first_of_points = (behind - before).norm();
    if (!(first > 0 && first_of_points > 0 && here.allFinite()))
      continue;  // skip holes, and points at the same position
    const Vector3d second = a - 2 * b + c;
    found.directions.push_back(2 * (second - second.dot(b) * b).norm() / first);
    found.points.push_back(2 * (before - 2 * here + behind).norm() / first_of_points);
    found.step.push_back(0.5 * first);
  }
  return found;
}

bool is_even(const Unevenness& u) {
  return u.step.size() >= fewest_triples && quantile(u.directions, 0.5) <= typical_unevenness &&
         quantile(u.directions, 0.95) <= most_unevenness &&
         quantile(u.step, 0.95) <= widest_step * quantile(u.step, 0.05);
}

/// Returns true if the points are much less even than their directions, not by accident as those of a plane.
bool shows_relief(const Unevenness& u) {
  return quantile(u.points, 0.99) >= std::max(least_relief, contrast * quantile(u.directions, 0.99));
}

bool is_raster(const RawCloud& raw) {
  std::vector<Eigen::Vector3f> finite;
  std::copy_if(raw.point.begin(), raw.point.end(), std::back_inserter(finite), [](auto& p) { return p.allFinite(); });
  return !raster_triangles(finite).empty();
}

}  // namespace

std::optional<Eigen::Vector3d> viewpoint_by_rows(const RawCloud& raw) {
  const bool known = raw.viewpoint || !raw.stations.empty() || raw.tags.prepared || !raw.triangle.empty();
  if (known || !fans_out_from_origin(raw)) return std::nullopt;
  return Eigen::Vector3d::Zero();
}

void find_viewpoint(RawCloud& raw, const LoadOptions& options, std::vector<std::string>& notes) {
  if (options.viewpoint) {
    raw.viewpoint = options.viewpoint;
    raw.stations.clear(), raw.station.clear();
  }
  if (!raw.stations.empty())
    notes.push_back(printed("%zu scans: each point was seen from the scanner of its own", raw.stations.size()));
  const auto seen_from = viewpoint_by_rows(raw);
  if (!seen_from) return;
  raw.viewpoint = seen_from;
  notes.push_back(fans_out_note);
}

bool looks_up(const RawCloud& raw) {
  if (raw.heights || raw.raster.empty()) return raw.heights;
  const auto [lowest, highest] =
      std::minmax_element(raw.point.begin(), raw.point.end(), [](auto& a, auto& b) { return a.z() < b.z(); });
  return raw.height == 1 || lowest->z() < highest->z();
}

bool fans_out_from_origin(const RawCloud& raw) {
  if (raw.width < 3 || raw.height < 3 || raw.width * raw.height != raw.point.size()) return false;
  const Unevenness rows = unevenness_along(raw, true), columns = unevenness_along(raw, false);
  return is_even(rows) && is_even(columns) && (shows_relief(rows) || shows_relief(columns)) && !is_raster(raw);
}

}  // namespace insonify
