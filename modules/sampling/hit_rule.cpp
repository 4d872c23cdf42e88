#include "sampling/hit_rule.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

namespace insonify {
namespace {

constexpr float link = 8;  // a cluster goes on while the next range is within so many spacings

// Number of leading candidates, sorted by range, that belong to one surface.
std::size_t front_cluster(const std::vector<GatedSurfel>& surfels, const std::vector<std::uint32_t>& candidates) {
  for (std::size_t k = 1; k < candidates.size(); ++k) {
    const GatedSurfel &a = surfels[candidates[k - 1]], &b = surfels[candidates[k]];
    if (b.range - a.range > link * std::max(a.spacing, b.spacing)) return k;
  }
  return candidates.size();
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

}  // namespace

float squared_footprint_chord(const GatedSurfel& s) {
  const float sine = s.radius / s.range;
  return sine < 1 ? 2 - 2 * std::sqrt(1 - sine * sine) : 4.0f;
}

RayFate hit_surface(const std::vector<GatedSurfel>& surfels, const Eigen::Vector3f& direction, bool front_only,
                    std::vector<std::uint32_t>& candidates, RayHit& hit) {
  std::erase_if(candidates, [&](std::uint32_t c) {
    return !(squared_chord(direction, surfels[c]) <= squared_footprint_chord(surfels[c]));
  });
  if (candidates.empty()) return RayFate::missed;
  std::sort(candidates.begin(), candidates.end(), [&](std::uint32_t a, std::uint32_t b) {
    return surfels[a].range != surfels[b].range ? surfels[a].range < surfels[b].range : a < b;
  });
  const std::size_t members = front_only ? front_cluster(surfels, candidates) : candidates.size();
  const std::span cluster(candidates.data(), members);

  // A thin body has front and back in one cluster: the side that the ray meets first counts.
  const std::size_t facing = nearest_member(surfels, cluster, direction, true);
  if (facing == members) return RayFate::blocked;
  hit = {cluster[facing], range_on_tangent_plane(surfels[cluster[facing]], direction)};
  const std::size_t nearest = nearest_member(surfels, cluster, direction, false);
  if (nearest == facing) return RayFate::echoes;
  return hit.range <= range_on_tangent_plane(surfels[cluster[nearest]], direction) ? RayFate::echoes : RayFate::blocked;
}

}  // namespace insonify
