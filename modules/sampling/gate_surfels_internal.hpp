// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "core/pose.hpp"
#include "core/uninitialized_vector.hpp"
#include "scene/prepared_scene.hpp"
#include "scene/scene_cloud.hpp"
#include "sonar/beam_fan.hpp"
#include "sonar/range_gate.hpp"

namespace insonify {

/// A surfel in head axes, with the disc that represents it as an occluder. Single precision suffices: these values
/// decide visibility, not position.
struct GatedSurfel {
  Eigen::Vector3f position;  ///< [m]
  float range;               ///< [m]
  Eigen::Vector3f away;      ///< unit normal, oriented away from the head
  float plane_distance;      ///< distance of the tangent plane from the head [m], >= 0; 0: seen edge-on
  float radius;              ///< disc radius, of a node at most 0.8 spacings; or the farthest corner of the facet [m]
  float core;                ///< within it the disc hides by itself: 0.65 spacings, 0.5 of a node (E137) [m]
  float spacing;             ///< sqrt(area) [m]
  float unevenness;          ///< how far below its plane its own surface may lie [m]
  float noise;               ///< noise of the surface [m]
  std::uint32_t surfel;      ///< index in the scene
  bool in_gate;              ///< inside sector and gate; else it can only occlude
  bool facing;               ///< front side towards the head (either side if normals are not oriented)
};

/// The triangle of a surfel as an occluder, in head axes.
struct GatedFacet {
  std::array<Eigen::Vector3f, 3> corner;  ///< [m]
  Eigen::Vector3f away;                   ///< unit normal, away from the head; 0 if the triangle has no area
  float plane_distance;                   ///< distance of its plane from the head [m], >= 0
  float tolerance;  ///< how deep below the plane something lies that is on it but for rounding [m]
};

/// Surfels in head axes, and their facets if the scene has them.
struct GatedSurfels : UninitializedVector<GatedSurfel> {
  using UninitializedVector<GatedSurfel>::UninitializedVector;
  UninitializedVector<GatedFacet> facet;  ///< empty: surfels hide as discs
};

/// Distance from a surfel's centre within which it helps to occlude others, in radii of its disc.
inline constexpr float hiding_reach = 1.5f;

/// Returns whether a surfel of a cut is a node: it has an unevenness of its own, a surfel its spacing (E137).
bool is_node(const SceneCloud& scene, std::size_t surfel);

/// Transforms places of a scene to head axes in double: subtracts the large world coordinates first. Surfels of a part
/// with axes of its own are transformed from there, so that what moves together with the head stays as it is. Refers to
/// the scene.
class HeadFrame {
 public:
  HeadFrame(const SceneCloud& scene, const Pose& world_from_head);

  /// A position relative to the origin of the scene, and a vector in the axes of the world.
  Eigen::Vector3d position(const Eigen::Vector3f& point) const {
    return world_.to_head * (world_.shift + point.cast<double>());
  }
  Eigen::Vector3d direction(const Eigen::Vector3d& scene_vector) const { return world_.to_head * scene_vector; }
  const Eigen::Matrix3d& to_head() const { return world_.to_head; }

  /// The axes that surfels are given in: to_head (shift + point) is in head axes.
  struct Axes {
    Eigen::Matrix3d to_head;
    Eigen::Vector3d shift;
    const SceneCloud* cloud;
    bool own;  ///< surfel `id` of the scene is number `id` in the cloud
  };
  const Axes& axes_of(std::size_t surfel) const { return parts_.empty() ? world_ : parts_[scene_.part[surfel]]; }
  /// Place and normal of a surfel in such axes.
  const Eigen::Vector3f& point_in(const Axes& axes, std::size_t surfel) const {
    return axes.cloud->point[axes.own ? scene_.id[surfel] : surfel];
  }
  const Eigen::Vector3f& normal_in(const Axes& axes, std::size_t surfel) const {
    return axes.cloud->normal[axes.own ? scene_.id[surfel] : surfel];
  }
  /// Place and normal of a surfel in head axes.
  Eigen::Vector3d position_of(std::size_t surfel) const {
    const Axes& axes = axes_of(surfel);
    return axes.to_head * (axes.shift + point_in(axes, surfel).cast<double>());
  }
  Eigen::Vector3d normal_of(std::size_t surfel) const {
    const Axes& axes = axes_of(surfel);
    return axes.to_head * normal_in(axes, surfel).cast<double>();
  }

 private:
  const SceneCloud& scene_;
  Axes world_;
  std::vector<Axes> parts_{};  // of a scene that is made of parts
};

/// Returns the surfels whose disc overlaps `sector` and whose centre is within the far end of `gate`, in scene order.
///
/// footprint   disc radius in units of the surfel's spacing
GatedSurfels gate_surfels(const SceneCloud& scene, const HeadFrame& head, const Sector& sector, const RangeGate& gate,
                          double footprint, int threads);
/// Returns the same surfels in the same order, visiting only the blocks that overlap sector and gate.
GatedSurfels gate_surfels(const PreparedScene& prepared, const HeadFrame& head, const Sector& sector,
                          const RangeGate& gate, double footprint, int threads);

}  // namespace insonify
