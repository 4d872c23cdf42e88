// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

#include "core/units.hpp"
#include "sampling/hit_rule_internal.hpp"

namespace insonify {
namespace {

constexpr float max_step = 8;             // largest range step within a cluster, in spacings
constexpr float reach_of_square = 0.71f;  // half diagonal of a square, in widths

// Returns the end of the cluster that begins with candidate `begin`; candidates are sorted by range.
std::size_t end_of_cluster(const GatedSurfels& surfels, const std::vector<std::uint32_t>& candidates,
                           std::size_t begin) {
  for (std::size_t k = begin + 1; k < candidates.size(); ++k) {
    const GatedSurfel &a = surfels[candidates[k - 1]], &b = surfels[candidates[k]];
    if (b.range - a.range > max_step * std::max(a.spacing, b.spacing)) return k;
  }
  return candidates.size();
}

// Returns true if the ray crosses the tangent plane of s within the circumcircle of a square of its area.
bool crosses(const GatedSurfel& s, const Eigen::Vector3f& direction) {
  const float slope = s.away.dot(direction), reach = reach_of_square * s.spacing * slope;
  return (direction * s.plane_distance - s.position * slope).squaredNorm() <= reach * reach;
}

// Range at which the ray intersects the tangent plane of s, limited to the extent of a cluster.
float range_on_tangent_plane(const GatedSurfel& s, const Eigen::Vector3f& direction) {
  const float reach = max_step * s.spacing, slope = s.away.dot(direction);
  const float low = std::max(0.0f, s.range - reach), high = s.range + reach;
  return slope * high <= s.plane_distance ? high : std::max(low, s.plane_distance / slope);  // (E16)
}

// Returns the angularly nearest member of the cluster, optionally among those that face the head; the cluster's size if
// there is none.
std::size_t nearest_member(const GatedSurfels& surfels, std::span<const std::uint32_t> cluster,
                           const Eigen::Vector3f& direction, bool facing_only) {
  std::size_t best = cluster.size();
  float best_chord = std::numeric_limits<float>::max();
  for (std::size_t k = 0; k < cluster.size(); ++k) {
    const GatedSurfel& s = surfels[cluster[k]];
    const float chord = squared_chord(direction, s);
    if ((s.facing || !facing_only) && chord < best_chord) {
      best = k;
      best_chord = chord;
    }
  }
  return best;
}

// Returns true if the ray misses a surface at its edge: it crosses none of the surfels, and seen from its intersection
// with the nearest tangent plane all their centres lie within 90 degrees of each other.
bool passes_beside(const GatedSurfels& surfels, std::span<const std::uint32_t> cluster,
                   const Eigen::Vector3f& direction) {
  for (const std::uint32_t c : cluster)
    if (crosses(surfels[c], direction)) return false;
  const GatedSurfel& nearest = surfels[cluster[nearest_member(surfels, cluster, direction, false)]];
  const float slope = nearest.away.dot(direction);
  const auto offset = [&](std::uint32_t c) -> Eigen::Vector3f {
    return surfels[c].position * slope - direction * nearest.plane_distance;
  };
  for (const std::uint32_t a : cluster)
    for (const std::uint32_t b : cluster)
      if (offset(a).dot(offset(b)) < 0) return false;
  return true;
}

// Returns which of 32 equal sectors holds a direction, by its angle.
int sector_by_angle(float x, float y) {
  const float turn = std::atan2(y, x);
  return std::clamp(static_cast<int>((turn / static_cast<float>(pi) + 1) * 16), 0, 31);
}

// Returns the same from the slopes of the edges, and by the angle only next to an edge.
int sector_of(float x, float y) {
  constexpr float slopes[] = {0, 0.19891237F, 0.41421356F, 0.66817864F, 1}, next_to = 1e-4F;
  const float across = std::abs(x), along = std::abs(y), high = std::max(across, along), low = std::min(across, along);
  int eighth = -1, clear = high > 0;
  for (const float slope : slopes) {
    const float beyond = low - slope * high;
    eighth += beyond > 0;
    clear &= std::abs(beyond) > next_to * high;
  }
  if (clear == 0) return sector_by_angle(x, y);
  const int of_quarter = along > across ? 7 - eighth : eighth, of_half = x < 0 ? 15 - of_quarter : of_quarter;
  return y < 0 ? 15 - of_half : 16 + of_half;
}

// True if the direction passes through the triangle; depth: its component along the normal, above 0. The corners are
// taken from where it crosses the plane, so that nothing is the difference of large numbers.
bool passes(const GatedFacet& f, const Eigen::Vector3f& direction, float depth) {
  const Eigen::Vector3f crossing = direction * (f.plane_distance / depth);
  const Eigen::Vector3f a = f.corner[0] - crossing, b = f.corner[1] - crossing, c = f.corner[2] - crossing;
  const float ab = a.cross(b).dot(f.away), bc = b.cross(c).dot(f.away), ca = c.cross(a).dot(f.away);
  return (ab >= 0 && bc >= 0 && ca >= 0) || (ab <= 0 && bc <= 0 && ca <= 0);
}

// The first facet that the ray passes through, of those that face the head unless all are asked for.
RayOutcome hit_facet(const GatedSurfels& surfels, const Eigen::Vector3f& direction, bool facing_only,
                     std::span<const std::uint32_t> candidates, RayHit& hit) {
  hit.range = std::numeric_limits<float>::infinity();
  for (const std::uint32_t c : candidates) {
    const GatedFacet& f = surfels.facet[c];
    const float slope = f.away.dot(direction);
    if (!(slope > 0) || (facing_only && !surfels[c].facing) || !passes(f, direction, slope)) continue;
    const float range = f.plane_distance / slope;
    if (range < hit.range || (range == hit.range && c < hit.surfel)) hit = {c, range};
  }
  if (!std::isfinite(hit.range)) return RayOutcome::missed;
  return surfels[hit.surfel].facing ? RayOutcome::hit : RayOutcome::blocked;
}

}  // namespace

Cover cover(const GatedFacet& front, const LineOfSight& line) {
  constexpr float rounding = 2e-6f;  // of a direction and a plane, in ranges
  const float depth = front.away.dot(line.end->position);
  if (!(depth - front.plane_distance > front.tolerance + rounding * line.end->range)) return 0;
  return passes(front, line.end->position, depth) ? whole_cover : 0;
}

Cover cover(const GatedSurfel& front, const LineOfSight& line) {
  const GatedSurfel& behind = *line.end;
  const float depth = front.away.dot(behind.position);  // of `behind`, along the normal of `front`
  if (!(depth - front.plane_distance > hiding_depth(front, behind))) return 0;
  // The line meets the plane at position x plane_distance / depth; multiplied by depth > 0, nothing is divided.
  const Eigen::Vector3f miss = front.position * depth - behind.position * front.plane_distance;
  const float reach = hiding_reach * front.radius * depth, core = front.core * depth;
  const float off = miss.squaredNorm();
  if (off > reach * reach) return 0;
  if (off <= core * core) return whole_cover;

  // Across the line, with the foreshortening of the tangent plane undone.
  const float cosine = depth / behind.range;
  Eigen::Vector3f across = miss - line.along * miss.dot(line.along);
  const Eigen::Vector3f slope = front.away - line.along * cosine;
  const float steepness = slope.squaredNorm();
  if (steepness > 1e-8f) across += slope * ((1 / cosine - 1) * across.dot(slope) / steepness);
  return Cover{1} << sector_of(line.right.dot(across), line.up.dot(across));
}

float squared_chord_of(float sine) { return sine < 1 ? 2 - 2 * std::sqrt(1 - sine * sine) : 4.0f; }

void keep_covering(const Eigen::Vector3f& direction, const GatedSurfels& surfels,
                   std::vector<std::uint32_t>& candidates) {
  std::erase_if(candidates, [&](std::uint32_t c) {
    return !(squared_chord(direction, surfels[c]) <= squared_chord_of(surfels[c].radius / surfels[c].range));
  });
}

bool is_surrounded(const Eigen::Vector3f& direction, const GatedSurfels& surfels,
                   std::span<const std::uint32_t> centres) {
  const Eigen::Vector3f right = direction.unitOrthogonal(), up = direction.cross(right);
  std::vector<float> angles;
  for (const std::uint32_t c : centres)
    angles.push_back(std::atan2(up.dot(surfels[c].position), right.dot(surfels[c].position)));
  if (angles.size() < 3) return false;
  std::sort(angles.begin(), angles.end());
  constexpr auto half_turn = static_cast<float>(pi);
  if (angles.front() + 2 * half_turn - angles.back() >= half_turn) return false;
  return std::adjacent_find(angles.begin(), angles.end(), [](float a, float b) { return b - a >= half_turn; }) ==
         angles.end();
}

RayOutcome hit_surface(const GatedSurfels& surfels, const Eigen::Vector3f& direction, bool front_only,
                       std::vector<std::uint32_t>& candidates, RayHit& hit) {
  if (!surfels.facet.empty()) return hit_facet(surfels, direction, !front_only, candidates, hit);
  keep_covering(direction, surfels, candidates);
  if (candidates.empty()) return RayOutcome::missed;
  std::sort(candidates.begin(), candidates.end(), [&](std::uint32_t a, std::uint32_t b) {
    return surfels[a].range != surfels[b].range ? surfels[a].range < surfels[b].range : a < b;
  });
  // Select the front cluster; advance to the next one while the ray passes beside it and another is behind.
  std::size_t begin = 0, end = front_only ? end_of_cluster(surfels, candidates, 0) : candidates.size();
  const auto members_of = [&] { return std::span<const std::uint32_t>(candidates).subspan(begin, end - begin); };
  while (end < candidates.size() && passes_beside(surfels, members_of(), direction)) {
    begin = end;
    end = end_of_cluster(surfels, candidates, begin);
  }
  const auto cluster = members_of();

  // A thin body has both faces in one cluster: the one that the ray intersects first counts.
  const std::size_t facing = nearest_member(surfels, cluster, direction, true);
  if (facing == cluster.size()) return RayOutcome::blocked;
  hit = {cluster[facing], range_on_tangent_plane(surfels[cluster[facing]], direction)};
  const std::size_t nearest = nearest_member(surfels, cluster, direction, false);
  if (nearest == facing) return RayOutcome::hit;
  return hit.range <= range_on_tangent_plane(surfels[cluster[nearest]], direction) ? RayOutcome::hit
                                                                                   : RayOutcome::blocked;
}

}  // namespace insonify
