#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "scene/scene_cloud.hpp"

namespace insonify {

/// Surfels that stand close together, and the ball that holds their centres.
struct SurfelBlock {
  Eigen::Vector3f centre;            ///< [m], relative to the scene's origin
  float radius = 0;                  ///< [m]
  float largest_area = 0;            ///< of one surfel [m^2]
  std::uint32_t begin = 0, end = 0;  ///< of PreparedScene::order()
};

/// A scene checked and put into blocks once, for many pings: a ping then looks only at blocks that the fan reaches.
/// Costs O(n) time and 4 bytes per surfel. Refers to `scene`, which must outlive it and not change.
class PreparedScene {
 public:
  /// Throws Error for an invalid scene. The blocks do not depend on `threads` (0: all cores).
  explicit PreparedScene(const SceneCloud& scene, int threads = 0);
  PreparedScene(SceneCloud&& temporary, int threads = 0) = delete;

  const SceneCloud& scene() const { return *scene_; }
  std::span<const SurfelBlock> blocks() const { return blocks_; }
  /// Indices of all surfels, block by block (along a Morton curve), ascending inside a block.
  std::span<const std::uint32_t> order() const { return order_; }
  /// Root of the mean area of the surfels [m]; 0 without surfels.
  double mean_spacing() const { return mean_spacing_; }
  /// Area of the largest surfel [m^2]; 0 without surfels.
  float largest_area() const { return largest_area_; }

 private:
  const SceneCloud* scene_;
  std::vector<SurfelBlock> blocks_;
  std::vector<std::uint32_t> order_;
  double mean_spacing_ = 0;
  float largest_area_ = 0;
};

}  // namespace insonify
