#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "sampling/gate_surfels_internal.hpp"

namespace insonify {

/// True if `front` stands between the head and `behind` (E16): the way to `behind` passes through its disc,
/// or within half a spacing of its centre (the normal of a rough surface may show the disc edge-on, and sound
/// must not leak through), and `behind` lies deeper under its tangent plane than the roughness of one
/// surface, the larger of the two spacings. So a grazing or rough surface does not hide itself.
inline bool hides(const GatedSurfel& front, const GatedSurfel& behind) {
  const float depth = front.away.dot(behind.position);  // of `behind`, along the normal of `front`
  const float roughness = std::max(front.spacing, behind.spacing);
  if (!(depth - front.plane_distance > roughness)) return false;
  // The way meets the plane at position x plane_distance / depth; multiplied by depth > 0, nothing is
  // divided.
  const Eigen::Vector3f miss = behind.position * front.plane_distance - front.position * depth;
  if (miss.squaredNorm() <= front.radius * front.radius * depth * depth) return true;
  const float along = front.position.dot(behind.position) / (behind.range * behind.range);  // 1: at `behind`
  const float core = std::min(front.radius, 0.5f * front.spacing);
  return along > 0 && along < 1 && (front.position - behind.position * along).squaredNorm() <= core * core;
}

/// Squared chord between a unit direction and the one towards a surfel.
inline float squared_chord(const Eigen::Vector3f& direction, const GatedSurfel& s) {
  return (direction - s.position / s.range).squaredNorm();
}

/// Squared chord of the cone that a surfel's disc may fill, seen from the head.
float squared_footprint_chord(const GatedSurfel& s);

/// Keeps the candidates whose cone holds the direction.
void keep_footprints_of(const Eigen::Vector3f& direction, const std::vector<GatedSurfel>& surfels,
                        std::vector<std::uint32_t>& candidates);

/// Where a ray meets the scene.
struct RayHit {
  std::uint32_t surfel = 0;  ///< index among the gated surfels
  float range = 0;           ///< [m]
};

enum class RayFate { missed, blocked, echoes };  ///< blocked: by a surface that shows its back

/// True if the centres stand on all sides of the direction: no half-plane through it is free of them.
bool is_surrounded(const Eigen::Vector3f& direction, const std::vector<GatedSurfel>& surfels,
                   std::span<const std::uint32_t> centres);

/// The hit rule (E16): of the surfels whose cone holds the ray, the front cluster counts; the ray meets the
/// tangent plane of its angularly nearest member. A cluster gives way to the next one behind it if the ray passes beside
/// it: crosses the tangent plane of none of its members within 0.71 spacings of the centre, and has all their centres
/// within a quarter turn to one side. So cones close the gaps inside a surface but do not make it grow at its edge.
/// `candidates` must hold all those surfels and may hold more; it is used as scratch space. front_only = false takes all
/// surfels for the cluster.
RayFate hit_surface(const std::vector<GatedSurfel>& surfels, const Eigen::Vector3f& direction, bool front_only,
                    std::vector<std::uint32_t>& candidates, RayHit& hit);

}  // namespace insonify
