// SPDX-License-Identifier: BSD-3-Clause
#include "scene/prepared_scene.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <mutex>

#include "core/error.hpp"
#include "core/morton.hpp"
#include "core/parallel.hpp"
#include "core/radix_sort.hpp"
#include "scene/detail_levels.hpp"
#include "scene/placed_block_internal.hpp"
#include "scene/surface_rays.hpp"

namespace insonify {
namespace {

constexpr std::size_t block_surfels = 128;
constexpr std::uint32_t steps_per_axis = 1 << 10;  // cells of the Morton curve
constexpr int code_bits = 30;
constexpr float rounding = 1 + 1e-5f;

// Quantises coordinates over the bulk of the points; the few points beyond the 0.5 % quantiles share the outermost
// cells.
class Quantiser {
 public:
  explicit Quantiser(const std::vector<Eigen::Vector3f>& points) {
    constexpr std::size_t samples = 4096;
    const std::size_t stride = points.size() / samples + 1;
    for (int axis = 0; axis < 3; ++axis) {
      std::vector<float> values;
      for (std::size_t i = 0; i < points.size(); i += stride) values.push_back(points[i][axis]);
      std::sort(values.begin(), values.end());
      const std::size_t tail = values.size() / 200;
      const double low = values[tail], high = values[values.size() - 1 - tail], margin = 0.1 * (high - low);
      low_[axis] = static_cast<float>(low - margin);
      extent_ = std::max(extent_, high - low + 2 * margin);
    }
  }
  std::uint32_t code(const Eigen::Vector3f& p) const {
    const float per_metre = extent_ > 0 ? static_cast<float>(steps_per_axis / extent_) : 0;
    std::array<std::uint32_t, 3> cell{};
    for (int axis = 0; axis < 3; ++axis) {
      const float step = std::clamp((p[axis] - low_[axis]) * per_metre, 0.0f, float{steps_per_axis - 1});
      cell[static_cast<std::size_t>(axis)] = static_cast<std::uint32_t>(step);
    }
    return static_cast<std::uint32_t>(morton_code(cell));
  }

 private:
  Eigen::Vector3f low_;
  double extent_ = 0;  // length of the longest axis; all axes use it, so that cells are cubes
};

std::vector<std::uint32_t> morton_order(const std::vector<Eigen::Vector3f>& points, int threads) {
  const Quantiser quantiser(points);
  std::vector<std::uint64_t> keys(points.size());
  parallel_blocks(points.size(), 1 << 15, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) keys[i] = std::uint64_t{quantiser.code(points[i])} << 32 | i;
  });
  radix_sort(keys, 32, 32 + code_bits, [](std::uint64_t key) { return key; });
  std::vector<std::uint32_t> order(keys.size());
  for (std::size_t i = 0; i < keys.size(); ++i) order[i] = static_cast<std::uint32_t>(keys[i]);
  return order;
}

void enclose(const SceneCloud& scene, std::span<const std::uint32_t> members, SurfelBlock& block) {
  Eigen::Vector3f low = scene.point[members[0]], high = low;
  for (const std::uint32_t i : members) {
    low = low.cwiseMin(scene.point[i]);
    high = high.cwiseMax(scene.point[i]);
    block.largest_area = std::max(block.largest_area, scene.area[i]);
  }
  block.centre = low + (high - low) / 2;
  double squared = 0;
  for (const std::uint32_t i : members)
    squared = std::max(squared, (scene.point[i] - block.centre).cast<double>().squaredNorm());
  block.radius = static_cast<float>(std::sqrt(squared)) * rounding + (high - low).norm() * (rounding - 1);
}

}  // namespace

struct PreparedScene::MadeLater {
  std::once_flag levels_once, rays_once;
  DetailLevels levels;
  std::unique_ptr<const SurfaceRays> rays;
};

PreparedScene::PreparedScene(const SceneCloud& scene, int threads)
    : PreparedScene(std::shared_ptr<const SceneCloud>(std::shared_ptr<void>(), &scene), threads) {}

const DetailLevels& PreparedScene::levels(int threads) const {
  std::call_once(later_->levels_once, [&] { later_->levels = detail_levels(*scene_, whole_.mean_spacing, threads); });
  return later_->levels;
}

const SurfaceRays& PreparedScene::rays(double footprint) const {
  std::call_once(later_->rays_once, [&] { later_->rays = std::make_unique<SurfaceRays>(*scene_, footprint); });
  return *later_->rays;
}

PreparedScene::PreparedScene(std::shared_ptr<const SceneCloud> shared, int threads)
    : scene_(std::move(shared)), later_(std::make_shared<MadeLater>()) {
  require_valid_scene();
  if (scene_->size() > 0) order_ = morton_order(scene_->point, threads);
  divide(threads);
}

PreparedScene::PreparedScene(SceneCloud&& scene, std::vector<std::uint32_t> order, int threads)
    : scene_(std::make_shared<const SceneCloud>(std::move(scene))),
      order_(std::move(order)),
      later_(std::make_shared<MadeLater>()) {
  require_valid_scene();
  if (order_.size() != scene_->size())
    fail(ErrorKind::argument, "PreparedScene: order holds ", order_.size(), " indices, must hold one of each of ",
         scene_->size(), " surfels");
  divide(threads);
}

void PreparedScene::require_valid_scene() {
  require_valid(*scene_, "PreparedScene");
  if (scene_->size() > std::numeric_limits<std::uint32_t>::max())
    fail(ErrorKind::argument, "PreparedScene: ", scene_->size(), " surfels, must be below 2^32; divide the scene");
}

/// Divides the order into blocks.
void PreparedScene::divide(int threads) {
  const SceneCloud& scene = *scene_;
  whole_ = whole_of(scene);
  blocks_.resize((scene.size() + block_surfels - 1) / block_surfels);
  parallel_for(blocks_.size(), threads, [&](std::size_t b) {
    SurfelBlock& block = blocks_[b];
    block.begin = static_cast<std::uint32_t>(b * block_surfels);
    block.end = static_cast<std::uint32_t>(std::min(scene.size(), (b + 1) * block_surfels));
    const std::span members(order_.data() + block.begin, order_.data() + block.end);
    std::sort(members.begin(), members.end());
    enclose(scene, members, block);
  });
}

void PreparedScene::replace_others(std::size_t surfels, std::size_t blocks, const WholeScene& resting,
                                   std::span<const PosedBlocks> others) {
  order_.resize(surfels);
  blocks_.resize(blocks);
  whole_ = resting;
  for (const auto& [part, scene_from_part] : others) {
    const auto first = static_cast<std::uint32_t>(order_.size());
    for (const std::uint32_t i : part->order_) order_.push_back(first + i);
    for (const SurfelBlock& block : part->blocks_) blocks_.push_back(placed_block(block, scene_from_part, first));
    whole_ = together(whole_, part->whole_);
  }
  later_ = std::make_shared<MadeLater>();
}

SurfelMarks PreparedScene::marks_of(const std::function<bool(const SurfelBlock&)>& wanted, int threads) const {
  std::vector<std::uint8_t> is_wanted(blocks_.size(), 0);
  parallel_blocks(blocks_.size(), 1024, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t b = begin; b < end; ++b) is_wanted[b] = wanted(blocks_[b]);
  });
  SurfelMarks marks{std::vector<std::uint64_t>((order_.size() + 63) / 64, 0)};
  for (std::size_t b = 0; b < blocks_.size(); ++b)
    if (is_wanted[b])
      for (std::size_t k = blocks_[b].begin; k < blocks_[b].end; ++k)
        marks.words[order_[k] / 64] |= std::uint64_t{1} << order_[k] % 64;
  return marks;
}

}  // namespace insonify
