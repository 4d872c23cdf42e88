#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "sampling/gate_surfels_internal.hpp"

namespace insonify {

/// Returns true if `front` occludes `behind` (E16): the line of sight to `behind` crosses the disc of `front`, or
/// passes within half a spacing of its centre (so that sound does not leak through discs of rough surfaces seen
/// edge-on), and `behind` is deeper below the tangent plane of `front` than the roughness of one surface, the larger of
/// the two spacings. A grazing or rough surface therefore does not occlude itself.
inline bool hides(const GatedSurfel& front, const GatedSurfel& behind) {
  const float depth = front.away.dot(behind.position);  // of `behind`, along the normal of `front`
  const float roughness = std::max(front.spacing, behind.spacing);
  if (!(depth - front.plane_distance > roughness)) return false;
  // The line of sight meets the plane at position x plane_distance / depth; multiplying by depth > 0 avoids a division.
  const Eigen::Vector3f miss = behind.position * front.plane_distance - front.position * depth;
  if (miss.squaredNorm() <= front.radius * front.radius * depth * depth) return true;
  const float along = front.position.dot(behind.position) / (behind.range * behind.range);  // 1: at `behind`
  const float core = std::min(front.radius, 0.5f * front.spacing);
  return along > 0 && along < 1 && (front.position - behind.position * along).squaredNorm() <= core * core;
}

/// Returns the squared chord between a unit vector and the direction of a surfel.
inline float squared_chord(const Eigen::Vector3f& direction, const GatedSurfel& s) {
  return (direction - s.position / s.range).squaredNorm();
}

/// Returns the squared chord of the cone around the ball of a surfel's disc radius, as seen from the head.
float squared_footprint_chord(const GatedSurfel& s);

/// Removes the candidates whose footprint cone does not contain the direction.
void keep_covering(const Eigen::Vector3f& direction, const std::vector<GatedSurfel>& surfels,
                   std::vector<std::uint32_t>& candidates);

/// Where a ray hits the scene.
struct RayHit {
  std::uint32_t surfel = 0;  ///< index among the gated surfels
  float range = 0;           ///< [m]
};

enum class RayOutcome { missed, blocked, hit };  ///< blocked: by a surface that faces away

/// Returns true if the centres surround the direction: every half-plane through it contains one.
bool is_surrounded(const Eigen::Vector3f& direction, const std::vector<GatedSurfel>& surfels,
                   std::span<const std::uint32_t> centres);

/// Applies the hit rule (E16): of the surfels whose cone contains the ray, the front cluster counts, and the hit is on
/// the tangent plane of its angularly nearest member. A cluster is skipped for the next one behind it if the ray passes
/// beside it: the ray crosses no member's tangent plane within 0.71 spacing of the centre, and all centres lie within
/// 90 degrees on one side. Cones thus close the gaps inside a surface without extending it at its edges. `candidates`
/// must contain all these surfels and may contain more; it is used as scratch. front_only = false makes all surfels one
/// cluster.
RayOutcome hit_surface(const std::vector<GatedSurfel>& surfels, const Eigen::Vector3f& direction, bool front_only,
                       std::vector<std::uint32_t>& candidates, RayHit& hit);

}  // namespace insonify
