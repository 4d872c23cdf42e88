// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "core/parallel.hpp"
#include "core/units.hpp"
#include "sampling/gate_surfels_internal.hpp"
#include "sampling/insonified_region.hpp"

namespace insonify {
namespace {

using Eigen::Vector3d;

constexpr double min_distance = 1e-6;  // [m]; nearer points belong to the head itself

// Sizes of discs, in spacings. Surfels of a scan stand at random. Nodes of levels of detail are cells that tile their
// surface; with the sizes for surfels, they would make shadows longer (Detail.leaves_edges_of_shadows*).
constexpr double surfel_core = 0.65;
constexpr double node_core = 0.5, node_footprint = 0.8;

struct Gate {
  const SceneCloud& scene;
  const HeadFrame& head;
  SectorBounds sector;
  RangeGate range;
  double footprint;

  void add_if_inside(std::size_t i, GatedSurfels& inside) const {
    const Vector3d p = head.position_of(i);
    const double r2 = p.squaredNorm();
    if (!(r2 <= range.max_range * range.max_range) || r2 < min_distance * min_distance) return;
    const double spacing = std::sqrt(static_cast<double>(scene.area[i]));
    const bool node = is_node(scene, i);
    const double disc = (node ? std::min(node_footprint, footprint) : footprint) * spacing;
    const double radius = scene.facet.empty() ? disc : reach_of(scene.facet[i], scene.point[i]);
    const bool in_sector = sector.holds(p);
    if (!in_sector && !sector.holds(p, hiding_reach * radius)) return;

    const double r = std::sqrt(r2);
    const Vector3d normal = head.normal_of(i);
    const double along = normal.dot(p);  // negative: the normal points towards the head
    GatedSurfel s{};
    s.position = p.cast<float>();
    s.range = static_cast<float>(r);
    s.away = (along < 0 ? Vector3d(-normal) : normal).cast<float>();
    s.plane_distance = static_cast<float>(std::abs(along));
    s.radius = static_cast<float>(radius);
    s.spacing = static_cast<float>(spacing);
    s.core = node ? static_cast<float>(node_core * spacing) : static_cast<float>(surfel_core) * s.spacing;
    s.core = std::min(s.core, s.radius);
    s.unevenness = scene.unevenness.empty() ? s.spacing : scene.unevenness[i];
    s.noise = scene.noise.empty() ? 0 : scene.noise[i];
    s.surfel = static_cast<std::uint32_t>(i);
    s.in_gate = r >= range.min_range && in_sector;
    s.facing = scene.oriented(i) ? along < 0 : along != 0;
    inside.push_back(s);
    if (!scene.facet.empty()) inside.facet.push_back(gated(scene.facet[i], spacing));
  }

  // Distance of the farthest corner, with room for rounding.
  static double reach_of(const Facet& facet, const Eigen::Vector3f& point) {
    float squared = 0;
    for (const Eigen::Vector3f& corner : facet) squared = std::max(squared, (corner - point).squaredNorm());
    return 1.0001 * std::sqrt(static_cast<double>(squared));
  }

  GatedFacet gated(const Facet& facet, double spacing) const {
    constexpr double of_side = 1e-4, of_coordinate = 3e-7;  // of the side of a square; rounding of a float
    const std::array<Vector3d, 3> corner = {head.position(facet[0]), head.position(facet[1]), head.position(facet[2])};
    const Vector3d across = (corner[1] - corner[0]).cross(corner[2] - corner[0]);
    const double area = across.norm();
    Vector3d away = area > 0 ? Vector3d(across / area) : Vector3d(Vector3d::Zero());
    if (away.dot(corner[0]) < 0) away = -away;
    float largest = 0;
    for (const Eigen::Vector3f& c : facet) largest = std::max(largest, c.cwiseAbs().maxCoeff());
    return {{corner[0].cast<float>(), corner[1].cast<float>(), corner[2].cast<float>()},
            away.cast<float>(),
            static_cast<float>(away.dot(corner[0])),
            static_cast<float>(of_side * spacing + of_coordinate * largest)};
  }
};

bool reaches(const Vector3d& centre, double radius, double largest_area, const SectorBounds& sector, double max_range,
             double footprint) {
  constexpr double rounding = 1 + 1e-9;
  if (centre.norm() > (max_range + radius) * rounding) return false;
  return sector.holds(centre, (radius + hiding_reach * footprint * std::sqrt(largest_area)) * rounding + min_distance);
}

bool reaches(const SurfelBlock& block, const Gate& gate) {
  return reaches(gate.head.position(block.centre), block.radius, block.largest_area, gate.sector, gate.range.max_range,
                 gate.footprint);
}

GatedSurfels join(const std::vector<GatedSurfels>& parts, int threads) {
  std::vector<std::size_t> first(parts.size() + 1, 0);
  for (std::size_t k = 0; k < parts.size(); ++k) first[k + 1] = first[k] + parts[k].size();
  GatedSurfels all(first.back());
  if (std::any_of(parts.begin(), parts.end(), [](const GatedSurfels& part) { return !part.facet.empty(); }))
    all.facet.resize(first.back());
  parallel_for(parts.size(), threads, [&](std::size_t k) {
    const auto at = static_cast<std::ptrdiff_t>(first[k]);
    std::copy(parts[k].begin(), parts[k].end(), all.begin() + at);
    std::copy(parts[k].facet.begin(), parts[k].facet.end(), all.facet.begin() + at);
  });
  return all;
}

constexpr std::size_t gate_block = 1 << 15;

}  // namespace

bool is_node(const SceneCloud& scene, std::size_t surfel) {
  return !scene.unevenness.empty() && scene.unevenness[surfel] != std::sqrt(scene.area[surfel]);
}

HeadFrame::HeadFrame(const SceneCloud& scene, const Pose& world_from_head)
    : scene_(scene),
      world_{world_from_head.linear().transpose(), scene.origin - world_from_head.translation(), &scene, false} {
  for (const ScenePart& part : scene.parts) {
    parts_.push_back(world_);
    if (!part.own) continue;
    const Eigen::Matrix3d turn = part.world_from_part.linear();
    const Vector3d away = part.world_from_part.translation() - world_from_head.translation();
    parts_.back() = {world_.to_head * turn, part.own->origin + turn.transpose() * away, part.own.get(), true};
  }
}

InsonifiedRegion region_around(const Vector3d& centre, double radius) {
  InsonifiedRegion all;
  all.world_from_head.translation() = centre;
  all.sector = {-pi, pi, -pi / 2, pi / 2};
  all.gate.max_range = radius;
  return all;
}

bool may_intersect(const InsonifiedRegion& region, const Vector3d& ball_centre, double ball_radius,
                   double largest_area) {
  const Pose& pose = region.world_from_head;
  const Vector3d in_head_axes = pose.linear().transpose() * (ball_centre - pose.translation());
  return reaches(in_head_axes, ball_radius, largest_area, SectorBounds(region.sector), region.gate.max_range,
                 region.footprint);
}

GatedSurfels gate_surfels(const SceneCloud& scene, const HeadFrame& head, const Sector& sector, const RangeGate& range,
                          double footprint, int threads) {
  const Gate gate{scene, head, SectorBounds(sector), range, footprint};
  std::vector<GatedSurfels> parts((scene.size() + gate_block - 1) / gate_block);
  parallel_blocks(scene.size(), gate_block, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) gate.add_if_inside(i, parts[begin / gate_block]);
  });
  return join(parts, threads);
}

GatedSurfels gate_surfels(const PreparedScene& prepared, const HeadFrame& head, const Sector& sector,
                          const RangeGate& range, double footprint, int threads) {
  const Gate gate{prepared.scene(), head, SectorBounds(sector), range, footprint};
  const SurfelMarks marks = prepared.marks_of([&](const SurfelBlock& block) { return reaches(block, gate); }, threads);
  constexpr std::size_t words = gate_block / 64;
  std::vector<GatedSurfels> parts((marks.words.size() + words - 1) / words);
  parallel_blocks(marks.words.size(), words, threads, [&](std::size_t begin, std::size_t end) {
    GatedSurfels& part = parts[begin / words];
    part.reserve(marks.count(begin, end));
    marks.for_each(begin, end, [&](std::size_t i) { gate.add_if_inside(i, part); });
  });
  return join(parts, threads);
}

}  // namespace insonify
