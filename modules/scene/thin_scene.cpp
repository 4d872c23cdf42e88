// SPDX-License-Identifier: BSD-3-Clause
#include "scene/thin_scene.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <unordered_map>
#include <utility>
#include <vector>

#include "core/error.hpp"

namespace insonify {
namespace {

// A saturated random packing of discs with minimum distance r has 0.70 / r^2 centres per unit area; selected from a
// cloud 4 to 16 times as dense, about 0.62 / r^2. This r gives a mean area of spacing^2.
constexpr double distance_per_spacing = 0.8;
constexpr std::uint32_t no_surfel = ~0u;
constexpr int axis_bits = 21;

// Returns a number in pseudo-random order, different for each v (finaliser of MurmurHash3).
std::uint32_t shuffled(std::uint32_t v) {
  v = (v ^ v >> 16) * 0x85ebca6b;
  v = (v ^ v >> 13) * 0xc2b2ae35;
  return v ^ v >> 16;
}

// Kept surfels in a hash grid of cubes as wide as their minimum distance: all candidates near a point are in 27 cubes.
class KeptSurfels {
 public:
  KeptSurfels(const SceneCloud& scene, double distance, double normal_angle)
      : scene_(scene), distance_(distance), least_cosine_(static_cast<float>(std::cos(normal_angle))) {
    Eigen::Vector3f low = Eigen::Vector3f::Constant(std::numeric_limits<float>::max()), high = -low;
    for (const Eigen::Vector3f& p : scene.point) {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
    corner_ = low.cast<double>();
    widest_ = scene.size() > 0 ? static_cast<double>((high - low).maxCoeff()) : 0;
    next_.assign(scene.size(), no_surfel);
  }
  double cubes_along_scene() const { return widest_ / distance_; }

  void add(std::uint32_t surfel) {
    const auto [cube, is_new] = first_.try_emplace(key(cube_of(surfel)), surfel);
    if (!is_new) next_[surfel] = std::exchange(cube->second, surfel);
  }

  // Returns the nearest kept surfel that can represent `surfel` (the lowest id among equally near ones), or no_surfel.
  std::uint32_t nearest(std::uint32_t surfel) const {
    const Eigen::Vector3i cube = cube_of(surfel);
    std::uint32_t best = no_surfel;
    auto best_squared = static_cast<float>(distance_ * distance_);
    for (int x = -1; x <= 1; ++x)
      for (int y = -1; y <= 1; ++y)
        for (int z = -1; z <= 1; ++z) {
          const auto first = first_.find(key(cube + Eigen::Vector3i(x, y, z)));
          if (first == first_.end()) continue;
          for (std::uint32_t k = first->second; k != no_surfel; k = next_[k]) {
            const float squared = (scene_.point[k] - scene_.point[surfel]).squaredNorm();
            const bool nearer = squared < best_squared ||
                                (squared == best_squared && best != no_surfel && scene_.id[k] < scene_.id[best]);
            if (!nearer || !can_represent(k, surfel)) continue;
            best = k;
            best_squared = squared;
          }
        }
    return best;
  }

 private:
  Eigen::Vector3i cube_of(std::uint32_t surfel) const {
    return ((scene_.point[surfel].cast<double>() - corner_) / distance_).array().floor().cast<int>();
  }
  static std::uint64_t key(const Eigen::Vector3i& cube) {  // cube indices start at -1
    std::uint64_t key = 0;
    for (int axis = 0; axis < 3; ++axis) key = key << axis_bits | static_cast<std::uint64_t>(cube[axis] + 1);
    return key;
  }
  bool can_represent(std::uint32_t kept, std::uint32_t other) const {
    if (scene_.material[kept] != scene_.material[other]) return false;
    const float cosine = scene_.normal[kept].dot(scene_.normal[other]);
    return (scene_.normals_oriented ? cosine : std::abs(cosine)) >= least_cosine_;
  }

  const SceneCloud& scene_;
  double distance_, widest_ = 0;
  float least_cosine_;
  Eigen::Vector3d corner_;
  std::unordered_map<std::uint64_t, std::uint32_t> first_;  // first kept surfel of each cube
  std::vector<std::uint32_t> next_;                         // next kept surfel in the same cube
};

void require_valid(const SceneCloud& scene, double spacing, const ThinningOptions& options) {
  require_valid(scene, "thin_scene");
  if (!(spacing > 0 && std::isfinite(spacing)))
    fail(ErrorKind::argument, "thin_scene: spacing = ", spacing, " m, must be > 0");
  if (!(options.normal_angle >= 0 && options.normal_angle <= pi / 2))
    fail(ErrorKind::argument, "thin_scene: options.normal_angle = ", options.normal_angle, " rad, must be 0 .. pi/2");
}

}  // namespace

SceneCloud thin_scene(const SceneCloud& scene, double spacing, const ThinningOptions& options) {
  require_valid(scene, spacing, options);
  KeptSurfels kept(scene, distance_per_spacing * spacing, options.normal_angle);
  if (kept.cubes_along_scene() > (1 << axis_bits) - 4)
    fail(ErrorKind::argument, "thin_scene: spacing = ", spacing, " m is too small for a scene of this extent, must be ",
         "above ", kept.cubes_along_scene() / (1 << axis_bits) * spacing, " m");

  // In pseudo-random order, keep each surfel that no kept surfel can represent.
  std::vector<std::uint32_t> order(scene.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(),
            [&](std::uint32_t a, std::uint32_t b) { return shuffled(scene.id[a]) < shuffled(scene.id[b]); });
  std::vector<std::uint32_t> kept_surfels;
  std::vector<std::uint8_t> is_kept(scene.size(), 0);
  for (const std::uint32_t surfel : order)
    if (kept.nearest(surfel) == no_surfel) {
      kept.add(surfel);
      is_kept[surfel] = 1;
    }

  // Add the area of each removed surfel to its nearest representative.
  std::vector<double> area(scene.area.begin(), scene.area.end());
  for (std::uint32_t i = 0; i < scene.size(); ++i)
    if (is_kept[i])
      kept_surfels.push_back(i);
    else
      area[kept.nearest(i)] += scene.area[i];
  SceneCloud thinned = subset(scene, kept_surfels);
  for (std::size_t k = 0; k < kept_surfels.size(); ++k) thinned.area[k] = static_cast<float>(area[kept_surfels[k]]);
  return thinned;
}

}  // namespace insonify
