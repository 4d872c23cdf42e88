#pragma once
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <Eigen/Core>

namespace insonify {

/// A neighbour: which point, and its squared distance [m^2 for positions, squared chord for unit directions].
struct Neighbour {
  std::uint32_t index = 0;
  float squared_distance = 0;
};

/// KD-tree (FLANN, exact, single tree) over 3-D points: positions of a scene, or unit vectors of directions.
/// The points are copied. Queries are const and may run from several threads at once; results do not depend on it.
class SceneIndex {
 public:
  explicit SceneIndex(std::span<const Eigen::Vector3f> points);
  ~SceneIndex();
  SceneIndex(SceneIndex&&) noexcept;
  SceneIndex& operator=(SceneIndex&&) noexcept;

  std::size_t size() const;

  /// The k points nearest to `query`, nearest first; fewer if the index is smaller. The query point itself counts
  /// if it is in the index. `result` is overwritten.
  void find_nearest(const Eigen::Vector3f& query, std::size_t k, std::vector<Neighbour>& result) const;

  /// All points closer than `radius`, in no particular order. `result` is overwritten.
  void find_within(const Eigen::Vector3f& query, float radius, std::vector<Neighbour>& result) const;

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

}  // namespace insonify
