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

/// Where a ray first meets a surface.
struct SurfaceRayEnd {
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
  std::uint32_t surfel = none;  ///< of the surfels met there, the one whose centre is nearest; none: the ray meets none
  float distance = 0;           ///< from the start of the ray [m]
  /// Area of surface per area: kernels of radius 0.6 sqrt(area) about the surfels, each of which holds the area of its
  /// surfel. Its mean over a surface is 1, and its integral over all places where rays can meet a piece of surface is the
  /// area of that piece, at free edges too. Where two surfaces meet in a corner, some 0.13 sqrt(area) of each is lost
  /// behind the other.
  float density = 0;
};

/// Rays from surface to surface of a scene (Embree, oriented discs). Copies share the tree. Queries are const, may run
/// concurrently, and do not depend on the number of threads.
class SurfaceRays {
 public:
  /// Whether this build of insonify has Embree. Without it the constructor throws.
  static bool available();

  /// Builds the tree over the surfels of a scene, which must outlive it, in some 0.5 us per surfel. A surfel is a
  /// disc of radius `footprint` sqrt(area). Throws Error(runtime) without Embree, or if memory is short.
  SurfaceRays(const SceneCloud& scene, double footprint);

  /// Returns where a ray first meets the front of a surface. It meets none if a back side is in the way. Surfels that
  /// belong to the surface it leaves are passed: those whose planes hold its start within three standard deviations of
  /// noise, and those nearer than three radii whose back it would meet.
  SurfaceRayEnd first_hit(const SurfaceRay& ray) const;

 private:
  struct Tree;
  std::shared_ptr<const Tree> tree_;
};

}  // namespace insonify
