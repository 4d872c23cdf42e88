#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "scene/material.hpp"

namespace insonify {

/// What depends on all surfels of a scene, for a cloud that holds only those near a head: a ping of the part then is the
/// ping of the whole.
struct WholeScene {
  std::size_t surfels = 0;
  double mean_spacing = 0;  ///< root of the mean area [m]
  float largest_area = 0;   ///< of one surfel [m^2]
};

/// The captured scene: surfels (small oriented patches) as structure of arrays, one entry per surfel in every
/// array. World frame; coordinates are stored relative to `origin`, which was subtracted in double.
struct SceneCloud {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< [m]; world position = origin + point
  std::vector<Eigen::Vector3f> point;                ///< [m], relative to origin
  std::vector<Eigen::Vector3f> normal;               ///< unit vectors
  std::vector<float> area;                           ///< true surface area [m^2]
  std::vector<std::uint16_t> material;               ///< index into `materials`
  std::vector<std::uint32_t> id;                     ///< unique; speckle is bound to it
  std::vector<Material> materials = {Material{}};
  bool normals_oriented = true;         ///< false: the sign of a normal means nothing and both sides reflect
  std::optional<WholeScene> part_of{};  ///< set if this is a part of a scene; empty: it is all there is

  std::size_t size() const { return point.size(); }
};

/// Adds one surfel whose id is one more than the last one's: free as long as ids ascend. Throws Error if `material` is
/// not in scene.materials.
void add_surfel(SceneCloud& scene, const Eigen::Vector3d& world_position, const Eigen::Vector3d& normal, double area,
                std::uint16_t material = 0);

/// Throws Error unless all arrays have one length, points are finite, normals are unit vectors within 1e-3, areas
/// are finite and >= 0, materials exist and are valid themselves. `who` names the caller.
void require_valid(const SceneCloud& scene, const char* who);

/// The surfels listed in `keep`, in that order, with their ids.
SceneCloud subset(const SceneCloud& scene, const std::vector<std::uint32_t>& keep);

/// Axis-aligned box of the points in world coordinates [m]; empty scene: min > max.
struct Bounds {
  Eigen::Vector3d min = Eigen::Vector3d::Constant(1e300);
  Eigen::Vector3d max = Eigen::Vector3d::Constant(-1e300);
};
Bounds bounds(const SceneCloud& scene);

}  // namespace insonify
