// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "sampling/gate_surfels_internal.hpp"

namespace insonify {

/// The line of sight to a surfel, and two axes across it.
struct LineOfSight {
  const GatedSurfel* end;
  Eigen::Vector3f along, right, up;  ///< unit vectors

  explicit LineOfSight(const GatedSurfel& s)
      : end(&s), along(s.position / s.range), right(along.unitOrthogonal()), up(along.cross(right)) {}
};

/// Directions around a line of sight in which surfaces cover it, one bit for each of 32 equal sectors.
using Cover = std::uint32_t;
inline constexpr Cover whole_cover = ~Cover{0};

/// Returns the least depth below the tangent plane of one surfel at which another surfel is behind it [m]: the larger
/// unevenness, plus three standard deviations of noise (E16).
inline float hiding_depth(const GatedSurfel& a, const GatedSurfel& b) {
  return std::max(a.unevenness, b.unevenness) + 3 * std::sqrt(a.noise * a.noise + b.noise * b.noise);
}

/// Returns the part that `front` covers of the line of sight to a surfel that lies deeper below its tangent plane than
/// the hiding depth (E16): all of it, if the line crosses the plane within the core of the disc; the sector in which
/// the centre lies, seen in the tangent plane, if within hiding_reach radii; else nothing.
Cover cover(const GatedSurfel& front, const LineOfSight& line);

/// Returns the part that a facet covers of the line of sight to a surfel behind its plane: all of it, if the line
/// passes through the triangle, else nothing.
Cover cover(const GatedFacet& front, const LineOfSight& line);

/// Returns the part that a surfel covers, by its facet if it has one.
inline Cover cover(const GatedSurfels& surfels, std::size_t front, const LineOfSight& line) {
  return surfels.facet.empty() ? cover(surfels[front], line) : cover(surfels.facet[front], line);
}

/// Returns true if covers stand on more than one side: spread over 120 degrees, as around the cell of a surface's last
/// surfel. Surfaces then have no gaps between surfels, and do not grow at their edges.
inline bool hides(Cover c) {
  const auto shorter = [](Cover gaps, int by) { return gaps & std::rotr(gaps, by); };
  // Keeps bits only of gaps that are at least 21 sectors wide: 21 = 1 + 1 + 2 + 4 + 8 + 5.
  return c != 0 && shorter(shorter(shorter(shorter(shorter(~c, 1), 2), 4), 8), 5) == 0;
}

/// Returns the squared chord between a unit vector and the direction of a surfel.
inline float squared_chord(const Eigen::Vector3f& direction, const GatedSurfel& s) {
  return (direction - s.position / s.range).squaredNorm();
}

/// Returns the squared chord of a cone whose half-angle has this sine; of the whole sphere from 1 on.
float squared_chord_of(float sine);

/// Removes the candidates whose footprint cone does not contain the direction.
void keep_covering(const Eigen::Vector3f& direction, const GatedSurfels& surfels,
                   std::vector<std::uint32_t>& candidates);

/// Where a ray hits the scene.
struct RayHit {
  std::uint32_t surfel = 0;  ///< index among the gated surfels
  float range = 0;           ///< [m]
};

enum class RayOutcome { missed, blocked, hit };  ///< blocked: by a surface that faces away

/// Returns true if the centres surround the direction: every half-plane through it contains one.
bool is_surrounded(const Eigen::Vector3f& direction, const GatedSurfels& surfels,
                   std::span<const std::uint32_t> centres);

/// Applies the hit rule (E16): of the surfels whose cone contains the ray, the front cluster counts, and the hit is on
/// the tangent plane of its angularly nearest member. A cluster is skipped for the next one behind it if the ray passes
/// beside it: the ray crosses no member's tangent plane within 0.71 spacing of the centre, and all centres lie within
/// 90 degrees on one side. Cones thus close the gaps inside a surface without extending it at its edges. `candidates`
/// must contain all these surfels and may contain more; it is used as scratch. front_only = false makes all surfels one
/// cluster. Where surfels have facets, the ray hits the first one that it passes through, in its plane; with front_only
/// = false, the first that faces the head.
RayOutcome hit_surface(const GatedSurfels& surfels, const Eigen::Vector3f& direction, bool front_only,
                       std::vector<std::uint32_t>& candidates, RayHit& hit);

}  // namespace insonify
