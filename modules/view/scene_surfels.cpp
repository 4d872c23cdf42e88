// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "view/scene_surfels_internal.hpp"

namespace insonify {
namespace {

constexpr std::size_t surfels_at_once = 1 << 15;
constexpr float largest = 2.5F;      // longest side, in medians
constexpr double picking_reach = 2;  // [pixels]

// Hashes ids, which come in runs, evenly over all 32-bit numbers (the finalizer of MurmurHash3).
std::uint32_t scattered(std::uint32_t id) {
  id ^= id >> 16;
  id *= 0x85ebca6bU;
  id ^= id >> 13;
  id *= 0xc2b2ae35U;
  return id ^ (id >> 16);
}

// A candidate under the cursor: surfels that cover it precede those beside it, then the nearer precede.
struct Hit {
  bool beside = true;
  double distance = std::numeric_limits<double>::infinity();
  std::uint32_t surfel = 0;

  bool before(const Hit& other) const { return beside != other.beside ? other.beside : distance < other.distance; }
};

}  // namespace

std::vector<float> surfel_sides(const SceneCloud& scene) {
  std::vector<float> side(scene.size()), sample;
  for (std::size_t i = 0; i < side.size(); ++i) side[i] = std::sqrt(scene.area[i]);
  const std::size_t step = 1 + side.size() / 100000;
  for (std::size_t i = 0; i < side.size(); i += step)
    if (side[i] > 0) sample.push_back(side[i]);
  if (sample.empty()) return side;
  const auto middle = sample.begin() + static_cast<std::ptrdiff_t>(sample.size() / 2);
  std::nth_element(sample.begin(), middle, sample.end());
  for (float& s : side) s = s > 0 ? std::min(s, largest * *middle) : *middle;
  return side;
}

std::vector<std::uint32_t> drawn_surfels(const SceneCloud& scene, std::size_t most) {
  std::vector<std::uint32_t> drawn;
  if (scene.size() <= most) {
    drawn.resize(scene.size());
    std::iota(drawn.begin(), drawn.end(), 0U);
    return drawn;
  }
  const double share = static_cast<double>(most) / static_cast<double>(scene.size());
  const auto limit = static_cast<std::uint32_t>(share * 4294967295.0);
  drawn.reserve(most + most / 8);
  for (std::size_t i = 0; i < scene.size(); ++i)
    if (scattered(scene.id[i]) < limit) drawn.push_back(static_cast<std::uint32_t>(i));
  return drawn;
}

std::optional<std::uint32_t> front_surfel(const SceneCloud& scene, std::span<const std::uint32_t> drawn,
                                          std::span<const float> side, const PickingWindow& window) {
  const Eigen::Matrix4d& m = window.clip_from_scene;
  const auto look_at = [&](std::uint32_t surfel, Hit& best) {
    const Eigen::Vector4d clip = m * scene.point[surfel].cast<double>().homogeneous();
    if (!(clip.w() > 0) || std::abs(clip.z()) > clip.w()) return;
    const double x = (clip.x() / clip.w() + 1) / 2 * window.width - window.at.x;
    const double y = (clip.y() / clip.w() + 1) / 2 * window.height - window.at.y;
    const double half = window.focal_length * static_cast<double>(side[surfel]) / clip.w() * window.height / 4;
    const double off = std::max(std::abs(x), std::abs(y));
    const double covers = std::clamp(half, 1.0, 32.0);
    if (off > std::max(covers, picking_reach)) return;
    const Hit hit{off > covers, clip.w(), surfel};
    if (hit.before(best)) best = hit;
  };

  std::vector<Hit> best((drawn.size() + surfels_at_once - 1) / surfels_at_once);
  parallel_blocks(drawn.size(), surfels_at_once, 0, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) look_at(drawn[i], best[begin / surfels_at_once]);
  });
  Hit front;
  for (const Hit& hit : best)
    if (hit.before(front)) front = hit;
  if (!std::isfinite(front.distance)) return {};
  return front.surfel;
}

void require_drawable(const SceneCloud& scene, const SceneLook& look, const char* who) {
  if (scene.size() == 0)
    fail(ErrorKind::content, who, ": scene has no surfels, so there is nothing to draw; load or make one with points");
  if (scene.normal.size() != scene.size() || scene.area.size() != scene.size() || scene.id.size() != scene.size() ||
      scene.material.size() != scene.size())
    fail(ErrorKind::argument, who, ": scene has arrays of different lengths; each needs one entry per surfel");
  require_length(look.level_db.size(), scene, "level_db", who);
  require_length(look.visibility.size(), scene, "visibility", who);
  require_surfels(look.highlighted, scene, who);
  require_valid(look.soundings, who);
  require_point_size(look.point_size, who);
  if (look.head) require_valid(*look.head, who);
}

void require_valid(const SceneHead& head, const char* who) {
  require_valid(head.fan, who);
  require_valid(head.gate, who);
  if (!head.world_from_head.matrix().allFinite())
    fail(ErrorKind::argument, who, ": head.world_from_head has a number that is not finite");
}

void require_valid(const Soundings& soundings, const char* who) {
  if (soundings.level_db.size() != soundings.size())
    fail(ErrorKind::argument, who, ": soundings has ", soundings.size(), " positions but ", soundings.level_db.size(),
         " levels, must be as many");
}

void require_surfels(std::span<const std::uint32_t> surfels, const SceneCloud& scene, const char* who) {
  for (const std::uint32_t surfel : surfels)
    if (surfel >= scene.size())
      fail(ErrorKind::argument, who, ": highlighted surfel ", surfel, ", must be below ", scene.size(),
           ", the number of surfels");
}

void require_length(std::size_t length, const SceneCloud& scene, const char* name, const char* who) {
  if (length > 0 && length != scene.size())
    fail(ErrorKind::argument, who, ": look.", name, " has ", length, " entries, must have none or ", scene.size(),
         ", one per surfel");
}

void require_point_size(double point_size, const char* who) {
  if (!(point_size > 0) || !std::isfinite(point_size))
    fail(ErrorKind::argument, who, ": point_size = ", point_size, ", must be > 0 and finite");
}

}  // namespace insonify
