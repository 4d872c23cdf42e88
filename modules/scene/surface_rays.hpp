// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <limits>
#include <memory>

#include <Eigen/Core>

#include "scene/scene_cloud.hpp"

namespace insonify {

/// A ray that leaves a surfel.
struct SurfaceRay {
  std::uint32_t surfel = 0;   ///< index in the scene; the ray does not meet it
  Eigen::Vector3f from;       ///< [m], relative to the scene's origin
  Eigen::Vector3f direction;  ///< unit vector
};

/// First hit of a ray on a surface.
struct SurfaceRayEnd {
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
  std::uint32_t surfel = none;  ///< met surfel with the nearest centre; none: the ray meets no surface
  float distance = 0;           ///< distance from the start of the ray [m]
  /// Area of surface per area: a sum of kernels of radius 0.6 sqrt(area) about the surfels, where each kernel holds the
  /// area of its surfel. The mean over a surface is 1. The integral over all positions where rays can meet a piece of
  /// surface is the area of that piece, also at free edges. Where two surfaces meet in a corner, each loses about 0.13
  /// sqrt(area) behind the other.
  float density = 0;
};

/// Rays from surface to surface of a scene (Embree, oriented discs). Copies share the tree. Queries are const, may run
/// concurrently, and do not depend on the number of threads.
class SurfaceRays {
 public:
  /// Returns true if this build has Embree. Without it the constructor throws.
  static bool available();

  /// Builds the tree over the surfels of a scene, which must outlive it. A surfel is a disc of radius `footprint`
  /// sqrt(area). Takes about 0.5 us per surfel. Throws Error(runtime) without Embree, or if memory is short.
  SurfaceRays(const SceneCloud& scene, double footprint);

  /// Returns the first front of a surface that a ray meets. A back side in the way stops the ray without a result. The
  /// ray passes surfels of the surface that it leaves: those whose planes hold its start within three standard
  /// deviations of noise, and those nearer than three radii that it would meet from the back.
  SurfaceRayEnd first_hit(const SurfaceRay& ray) const;

 private:
  struct Tree;
  std::shared_ptr<const Tree> tree_;
};

}  // namespace insonify
