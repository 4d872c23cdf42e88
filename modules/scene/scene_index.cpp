// SPDX-License-Identifier: BSD-3-Clause
#include "scene/scene_index.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>

#include <flann/flann.hpp>

#include "core/error.hpp"

namespace insonify {
namespace {

using Index = flann::KDTreeSingleIndex<flann::L2_3D<float>>;

// Writes results directly into the caller's vector, so a query does not allocate a result set.
class WithinRadius final : public flann::ResultSet<float> {
 public:
  WithinRadius(float squared_radius, std::vector<Neighbour>& hits) : squared_radius_(squared_radius), hits_(hits) {}
  bool full() const override { return true; }
  float worstDist() const override { return squared_radius_; }
  void addPoint(float squared_distance, std::size_t index) override {
    if (squared_distance < squared_radius_) hits_.push_back({static_cast<std::uint32_t>(index), squared_distance});
  }

 private:
  float squared_radius_;
  std::vector<Neighbour>& hits_;
};

// Keeps the k nearest hits sorted, equal distances by index.
class Nearest final : public flann::ResultSet<float> {
 public:
  Nearest(std::size_t k, std::vector<Neighbour>& hits) : k_(k), hits_(hits) { hits_.resize(k); }
  bool full() const override { return found_ == k_; }
  float worstDist() const override { return worst_; }
  void addPoint(float squared_distance, std::size_t index) override {
    if (squared_distance >= worst_) return;
    const Neighbour hit{static_cast<std::uint32_t>(index), squared_distance};
    // The bits of positive floats ascend as they do.
    const auto rank = [](const Neighbour& n) {
      return std::uint64_t{std::bit_cast<std::uint32_t>(n.squared_distance)} << 32 | n.index;
    };
    std::size_t at = full() ? found_ - 1 : found_++;  // the farthest leaves
    for (const std::uint64_t own = rank(hit); at > 0 && own < rank(hits_[at - 1]); --at) hits_[at] = hits_[at - 1];
    hits_[at] = hit;
    if (full()) worst_ = hits_.back().squared_distance;
  }
  void finish() { hits_.resize(found_); }

 private:
  std::size_t k_;
  std::size_t found_ = 0;
  float worst_ = std::numeric_limits<float>::max();
  std::vector<Neighbour>& hits_;
};

// FLANN prunes by box distances summed in float; a slightly negative epsilon adds slack and keeps the search exact.
flann::SearchParams exact_search() { return {flann::FLANN_CHECKS_UNLIMITED, -1e-5f, false}; }

}  // namespace

struct SceneIndex::Tree {
  explicit Tree(std::span<const Eigen::Vector3f> points) : size(points.size()) {
    if (points.empty()) return;
    // FLANN takes a mutable pointer but only reads from it while building, and keeps its own reordered copy.
    const flann::Matrix<float> matrix(const_cast<float*>(points.front().data()), points.size(), 3);
    index = std::make_unique<Index>(matrix, flann::KDTreeSingleIndexParams(leaf_points, true));
    index->buildIndex();
  }

  static constexpr int leaf_points = 12;
  std::size_t size;
  std::unique_ptr<Index> index;
};

SceneIndex::SceneIndex(std::span<const Eigen::Vector3f> points) {
  if (points.size() > static_cast<std::size_t>(std::numeric_limits<int>::max()))
    fail(ErrorKind::argument, "SceneIndex: ", points.size(), " points, must be below 2^31; divide the scene");
  for (std::size_t i = 0; i < points.size(); ++i)
    if (!points[i].allFinite()) fail(ErrorKind::content, "SceneIndex: point ", i, " is not finite; remove such points");
  tree_ = std::make_unique<Tree>(points);
}

SceneIndex::~SceneIndex() = default;
SceneIndex::SceneIndex(SceneIndex&&) noexcept = default;
SceneIndex& SceneIndex::operator=(SceneIndex&&) noexcept = default;

std::size_t SceneIndex::size() const { return tree_->size; }

void SceneIndex::find_nearest(const Eigen::Vector3f& query, std::size_t k, std::vector<Neighbour>& result) const {
  result.clear();
  if (k == 0 || !tree_->index) return;
  Nearest nearest(std::min(k, tree_->size), result);
  tree_->index->findNeighbors(nearest, query.data(), exact_search());
  nearest.finish();
}

void SceneIndex::find_within(const Eigen::Vector3f& query, float radius, std::vector<Neighbour>& result) const {
  result.clear();
  if (!(radius > 0) || !tree_->index) return;
  WithinRadius within(radius * radius, result);
  tree_->index->findNeighbors(within, query.data(), exact_search());
}

}  // namespace insonify
