#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

#include "core/units.hpp"
#include "sampling/hit_rule_internal.hpp"

namespace insonify {
namespace {

constexpr float link = 8;        // a cluster goes on while the next range is within so many spacings
constexpr float corner = 0.71f;  // from the middle of a square to its corner, in widths

// The end of the cluster that begins with candidate `begin`: the first of the next surface. Sorted by range.
std::size_t end_of_cluster(const std::vector<GatedSurfel>& surfels, const std::vector<std::uint32_t>& candidates,
                           std::size_t begin) {
  for (std::size_t k = begin + 1; k < candidates.size(); ++k) {
    const GatedSurfel &a = surfels[candidates[k - 1]], &b = surfels[candidates[k]];
    if (b.range - a.range > link * std::max(a.spacing, b.spacing)) return k;
  }
  return candidates.size();
}

// True if the ray crosses the tangent plane of s within the corners of a square of its area.
bool crosses(const GatedSurfel& s, const Eigen::Vector3f& direction) {
  const float slope = s.away.dot(direction), reach = corner * s.spacing * slope;
  return (direction * s.plane_distance - s.position * slope).squaredNorm() <= reach * reach;
}

// Range at which a ray meets the tangent plane of s, trusted as far as one surface reaches.
float range_on_tangent_plane(const GatedSurfel& s, const Eigen::Vector3f& direction) {
  const float reach = link * s.spacing, slope = s.away.dot(direction);
  const float low = std::max(0.0f, s.range - reach), high = s.range + reach;
  return slope * high <= s.plane_distance ? high : std::max(low, s.plane_distance / slope);  // (E16)
}

// Angularly nearest member of the cluster, facing ones only if so asked; the cluster's size if there is none.
std::size_t nearest_member(const std::vector<GatedSurfel>& surfels, std::span<const std::uint32_t> cluster,
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

// True if the ray passes beside a surface: it crosses none of its surfels, and from where it meets the tangent plane of the
// nearest one, their centres lie to one side, all within a quarter turn.
bool passes_beside(const std::vector<GatedSurfel>& surfels, std::span<const std::uint32_t> cluster,
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

}  // namespace

float squared_footprint_chord(const GatedSurfel& s) {
  const float sine = s.radius / s.range;
  return sine < 1 ? 2 - 2 * std::sqrt(1 - sine * sine) : 4.0f;
}

void keep_footprints_of(const Eigen::Vector3f& direction, const std::vector<GatedSurfel>& surfels,
                        std::vector<std::uint32_t>& candidates) {
  std::erase_if(candidates, [&](std::uint32_t c) {
    return !(squared_chord(direction, surfels[c]) <= squared_footprint_chord(surfels[c]));
  });
}

bool is_surrounded(const Eigen::Vector3f& direction, const std::vector<GatedSurfel>& surfels,
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

RayFate hit_surface(const std::vector<GatedSurfel>& surfels, const Eigen::Vector3f& direction, bool front_only,
                    std::vector<std::uint32_t>& candidates, RayHit& hit) {
  keep_footprints_of(direction, surfels, candidates);
  if (candidates.empty()) return RayFate::missed;
  std::sort(candidates.begin(), candidates.end(), [&](std::uint32_t a, std::uint32_t b) {
    return surfels[a].range != surfels[b].range ? surfels[a].range < surfels[b].range : a < b;
  });
  // The front cluster, unless the ray passes beside it and there is another one behind.
  std::size_t begin = 0, end = front_only ? end_of_cluster(surfels, candidates, 0) : candidates.size();
  const auto members_of = [&] { return std::span<const std::uint32_t>(candidates).subspan(begin, end - begin); };
  while (end < candidates.size() && passes_beside(surfels, members_of(), direction)) {
    begin = end;
    end = end_of_cluster(surfels, candidates, begin);
  }
  const auto cluster = members_of();

  // A thin body has front and back in one cluster: the side that the ray meets first counts.
  const std::size_t facing = nearest_member(surfels, cluster, direction, true);
  if (facing == cluster.size()) return RayFate::blocked;
  hit = {cluster[facing], range_on_tangent_plane(surfels[cluster[facing]], direction)};
  const std::size_t nearest = nearest_member(surfels, cluster, direction, false);
  if (nearest == facing) return RayFate::echoes;
  return hit.range <= range_on_tangent_plane(surfels[cluster[nearest]], direction) ? RayFate::echoes : RayFate::blocked;
}

}  // namespace insonify
