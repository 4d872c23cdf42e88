#pragma once
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "core/pose.hpp"
#include "sampling/beam_fan.hpp"
#include "sampling/range_gate.hpp"
#include "scene/prepared_scene.hpp"
#include "scene/scene_cloud.hpp"

namespace insonify {

/// A surfel in head axes, and the disc that stands for it when it blocks sound. Single precision is enough
/// here: this decides what is seen, not where it is.
struct GatedSurfel {
  Eigen::Vector3f position;  ///< [m]
  float range;               ///< [m]
  Eigen::Vector3f away;      ///< unit normal, turned so that it points away from the head
  float plane_distance;      ///< from the head to the tangent plane [m], >= 0; 0: seen edge-on
  float radius;              ///< of the disc [m]
  float spacing;             ///< sqrt(area) [m]
  std::uint32_t surfel;      ///< index in the scene
  bool in_gate;              ///< inside sector and gate; else it can only block
  bool facing;               ///< shows the head its front (or either side, when normals are not oriented)
};

/// Double-precision transform of scene points to head axes: the large coordinates cancel first.
class HeadFrame {
 public:
  HeadFrame(const SceneCloud& scene, const Pose& world_from_head)
      : to_head_(world_from_head.linear().transpose()), shift_(scene.origin - world_from_head.translation()) {}
  Eigen::Vector3d position(const Eigen::Vector3f& point) const { return to_head_ * (shift_ + point.cast<double>()); }
  Eigen::Vector3d direction(const Eigen::Vector3d& scene_vector) const { return to_head_ * scene_vector; }

 private:
  Eigen::Matrix3d to_head_;
  Eigen::Vector3d shift_;
};

/// Surfels whose disc reaches into `sector` and which stand nearer than the far end of `gate`, in scene
/// order. footprint   disc radius in units of the surfel's spacing
std::vector<GatedSurfel> gate_surfels(const SceneCloud& scene, const HeadFrame& head, const Sector& sector,
                                      const RangeGate& gate, double footprint, int threads);
/// The same surfels in the same order, found in the blocks that sector and gate reach.
std::vector<GatedSurfel> gate_surfels(const PreparedScene& prepared, const HeadFrame& head, const Sector& sector,
                                      const RangeGate& gate, double footprint, int threads);

}  // namespace insonify
