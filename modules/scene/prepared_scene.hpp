// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <bit>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "scene/scene_cloud.hpp"

namespace insonify {

struct DetailLevels;
class SurfaceRays;

/// A block of neighbouring surfels and a bounding ball of their centres.
struct SurfelBlock {
  Eigen::Vector3f centre;            ///< [m], relative to the scene's origin
  float radius = 0;                  ///< [m]
  float largest_area = 0;            ///< area of the largest surfel [m^2]
  std::uint32_t begin = 0, end = 0;  ///< range of indices into PreparedScene::order()
};

/// A set of surfels of a scene: surfel i is bit i % 64 of word i / 64. Surfels are visited in the order of the scene,
/// not in that of the blocks.
struct SurfelMarks {
  std::vector<std::uint64_t> words;

  /// Returns how many surfels the words [begin, end) mark.
  std::size_t count(std::size_t begin, std::size_t end) const {
    std::size_t sum = 0;
    for (std::size_t w = begin; w < end; ++w) sum += static_cast<std::size_t>(std::popcount(words[w]));
    return sum;
  }
  /// Calls use(i) for each surfel i that the words [begin, end) mark, in ascending order.
  template <typename Use>
  void for_each(std::size_t begin, std::size_t end, Use&& use) const {
    for (std::size_t w = begin; w < end; ++w)
      for (std::uint64_t left = words[w]; left != 0; left &= left - 1)
        use(w * 64 + static_cast<std::size_t>(std::countr_zero(left)));
  }
};

/// Blocks of a part in its own axes, and the pose of the part.
struct PosedBlocks {
  std::shared_ptr<const class PreparedScene> part;
  Eigen::Isometry3d scene_from_part;  ///< relative to the origins of scene and part
};

/// A scene that is validated and divided into blocks once, for many pings. Each ping then visits only the blocks within
/// its insonified region. Construction takes O(n) time and 4 bytes per surfel.
class PreparedScene {
 public:
  /// Prepares a scene. The blocks do not depend on `threads` (0: all cores). Throws Error for an invalid scene or one
  /// of 2^32 surfels or more.
  explicit PreparedScene(std::shared_ptr<const SceneCloud> scene, int threads = 0);
  /// Prepares a scene that must outlive the object unchanged. Throws as above.
  explicit PreparedScene(const SceneCloud& scene, int threads = 0);
  /// Prepares a scene that is moved into the object. Throws as above.
  explicit PreparedScene(SceneCloud&& scene, int threads = 0)
      : PreparedScene(std::make_shared<const SceneCloud>(std::move(scene)), threads) {}

  /// Prepares a scene with blocks along a given curve. `order` holds each index of a surfel once; neighbours in it
  /// should be neighbours in space. The results of pings do not depend on it. Throws as above, and Error(argument) if
  /// its size differs from the scene's.
  PreparedScene(SceneCloud&& scene, std::vector<std::uint32_t> order, int threads = 0);

  /// Returns the scene given to the constructor.
  const SceneCloud& scene() const { return *scene_; }
  /// Returns the blocks; together they hold every surfel once.
  std::span<const SurfelBlock> blocks() const { return blocks_; }
  /// Returns the indices of all surfels, block by block along a Morton curve or the given one, ascending inside each
  /// block.
  std::span<const std::uint32_t> order() const { return order_; }
  /// Returns the surfels of those blocks for which `wanted` is true. Up to `threads` threads (0: all cores) call
  /// `wanted` at once.
  SurfelMarks marks_of(const std::function<bool(const SurfelBlock&)>& wanted, int threads = 0) const;
  /// Returns the statistics of the scene, or those of the whole scene if it is a part; zeros for an empty scene.
  const WholeScene& whole() const { return whole_; }
  /// Returns the levels of detail of the scene for its mean spacing (detail_levels). The first call makes them; several
  /// threads may call at once. Copies of the object share them. Throws as detail_levels.
  const DetailLevels& levels(int threads = 0) const;
  /// Returns the rays between surfaces, with surfels as discs of this footprint. The first call makes the tree and
  /// fixes the footprint; several threads may call at once. Copies of the object share the tree. Throws as SurfaceRays.
  const SurfaceRays& rays(double footprint) const;

 private:
  friend class PosedScene;
  struct MadeLater;
  void require_valid_scene();
  void divide(int threads);
  /// Keeps the first `surfels` surfels and `blocks` blocks, whose statistics are `resting`, and appends the blocks of
  /// `others`. The scene holds the surfels of `others` in this order behind the first ones.
  void replace_others(std::size_t surfels, std::size_t blocks, const WholeScene& resting,
                      std::span<const PosedBlocks> others);
  std::shared_ptr<const SceneCloud> scene_;
  std::vector<SurfelBlock> blocks_;
  std::vector<std::uint32_t> order_;
  WholeScene whole_;
  std::shared_ptr<MadeLater> later_;
};

}  // namespace insonify
