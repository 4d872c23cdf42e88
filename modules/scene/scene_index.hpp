// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <Eigen/Core>

namespace insonify {

/// Result of a query: index of the point and squared distance [m^2 for positions, squared chord for unit directions].
struct Neighbour {
  std::uint32_t index = 0;
  float squared_distance = 0;
};

/// KD-tree (FLANN, exact, single tree) over 3-D points: positions of a scene, or unit vectors of directions. Copies the
/// points. Queries are const, may run concurrently, and do not depend on the number of threads.
class SceneIndex {
 public:
  /// Builds the tree over a copy of `points`.
  explicit SceneIndex(std::span<const Eigen::Vector3f> points);
  ~SceneIndex();
  SceneIndex(SceneIndex&&) noexcept;
  SceneIndex& operator=(SceneIndex&&) noexcept;

  /// Returns the number of points.
  std::size_t size() const;

  /// Finds the k points nearest to `query`, sorted by distance; fewer if the index is smaller. A query point that is in
  /// the index is among the results. `result` is overwritten.
  void find_nearest(const Eigen::Vector3f& query, std::size_t k, std::vector<Neighbour>& result) const;

  /// Finds all points closer than `radius`, in unspecified order. `result` is overwritten.
  void find_within(const Eigen::Vector3f& query, float radius, std::vector<Neighbour>& result) const;

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

}  // namespace insonify
