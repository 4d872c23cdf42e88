// SPDX-License-Identifier: BSD-3-Clause
#include "sampling/range_gaps.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <sstream>
#include <utility>

#include "core/error.hpp"

namespace insonify {
namespace {

using Cell = std::int64_t;

/// Counts the cells of [first, end) that are not in `occupied` (ascending).
RangeGaps gaps_within(Cell first, Cell end, const std::vector<Cell>& occupied, double cell) {
  RangeGaps gaps;
  gaps.cells = static_cast<std::size_t>(end - first);
  const auto close_gap = [&](Cell to) {
    if (to <= first) return;
    gaps.empty += static_cast<std::size_t>(to - first);
    gaps.widest = std::max(gaps.widest, static_cast<double>(to - first) * cell);
  };
  for (auto at = std::lower_bound(occupied.begin(), occupied.end(), first); at != occupied.end() && *at < end; ++at) {
    close_gap(*at);
    first = *at + 1;
  }
  close_gap(end);
  return gaps;
}

std::uint32_t ray_of(const SceneCloud& scene, const Scatterers& s, std::size_t i) {
  return scene.piece_of(s.surfel[i], s.id[i]);
}

/// Indices of the scatterers in the order of their rays.
std::vector<std::size_t> by_ray(const SceneCloud& scene, const Scatterers& scatterers) {
  std::vector<std::size_t> order(scatterers.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto ray = [&](std::size_t i) { return ray_of(scene, scatterers, i); };
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return ray(a) < ray(b); });
  return order;
}

SurfaceHit hit_of(const SceneCloud& scene, const Pose& world_from_head, const Scatterers& s, std::size_t i) {
  const Eigen::Vector3d along = unit_vector({s.azimuth[i], s.elevation[i]});
  Eigen::Vector3d normal = world_from_head.linear().transpose() * scene.normal[s.surfel[i]].cast<double>();
  if (normal.dot(along) < 0) normal = -normal;
  return {ray_of(scene, s, i), s.range[i], (s.range[i] * along).cast<float>(), normal.cast<float>(),
          std::sqrt(scene.area[s.surfel[i]])};
}

}  // namespace

void RangeGaps::add(const RangeGaps& other) {
  cells += other.cells;
  empty += other.empty;
  widest = std::max(widest, other.widest);
}

bool on_one_surface(const SurfaceHit& a, const SurfaceHit& b) {
  if (a.normal.dot(b.normal) < 0.70710678F) return false;
  const Eigen::Vector3f step = b.position - a.position, mean = (a.normal + b.normal).normalized();
  return std::abs(mean.dot(step)) <= std::max(a.spacing, b.spacing) + 0.05F * step.norm();
}

RangeGaps count_range_gaps(const std::vector<SurfaceHit>& hits, double cell) {
  // Cells occupied by a hit, and intervals of cells filled by a surface between neighbouring rays.
  std::vector<Cell> occupied;
  for (const SurfaceHit& hit : hits) occupied.push_back(static_cast<Cell>(std::floor(hit.range / cell)));
  std::vector<std::pair<Cell, Cell>> filled;
  for (std::size_t i = 1; i < hits.size(); ++i)
    if (hits[i].ray == hits[i - 1].ray + 1 && on_one_surface(hits[i - 1], hits[i]))
      filled.push_back(std::minmax(occupied[i - 1], occupied[i]));
  std::sort(occupied.begin(), occupied.end());
  std::sort(filled.begin(), filled.end());

  // Overlapping intervals count once.
  RangeGaps gaps;
  Cell done = filled.empty() ? 0 : filled.front().first;
  for (const auto& [first, last] : filled) {
    if (last < done) continue;
    gaps.add(gaps_within(std::max(first, done), last + 1, occupied, cell));
    done = last + 1;
  }
  return gaps;
}

RangeGaps count_range_gaps(const SceneCloud& scene, const Pose& world_from_head, const Scatterers& scatterers,
                           int rays_per_beam, double cell) {
  if (rays_per_beam < 1)
    fail(ErrorKind::argument, "count_range_gaps: rays_per_beam = ", rays_per_beam, ", must be at least 1");
  if (!(cell > 0 && std::isfinite(cell)))
    fail(ErrorKind::argument, "count_range_gaps: cell = ", cell, " m, must be finite and > 0");
  RangeGaps gaps;
  std::vector<SurfaceHit> beam;  // hits of the current beam
  const auto beam_of = [&](const SurfaceHit& hit) { return hit.ray / static_cast<std::uint32_t>(rays_per_beam); };
  for (const std::size_t i : by_ray(scene, scatterers)) {
    const SurfaceHit hit = hit_of(scene, world_from_head, scatterers, i);
    if (!beam.empty() && beam_of(hit) != beam_of(beam.back())) {
      gaps.add(count_range_gaps(beam, cell));
      beam.clear();
    }
    beam.push_back(hit);
  }
  gaps.add(count_range_gaps(beam, cell));
  return gaps;
}

std::vector<std::string> range_gap_notes(const RangeGaps& gaps, int rays_per_beam, double cell) {
  if (!(static_cast<double>(gaps.empty) > 0.01 * static_cast<double>(gaps.cells))) return {};
  std::ostringstream note;
  note.precision(3);
  note << "rays are too few: " << gaps.empty << " of " << gaps.cells
       << " range cells of surfaces between neighbouring rays are empty, up to " << gaps.widest
       << " m in a row; sample surfels, or about "
       << static_cast<std::int64_t>(std::ceil(rays_per_beam * gaps.widest / cell)) << " rays per beam";
  return {note.str()};
}

}  // namespace insonify
