// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "scene/ground.hpp"
#include "scene/scene_index.hpp"

// Private to scene: the ground of one part.
namespace insonify {

/// Calls use(i, world position) for each surfel of a part that is in the scene.
template <typename Use>
void for_each_surfel(const PlacedPart& part, const Use& use) {
  const SceneCloud& cloud = *part.cloud;
  const auto position = [&](std::size_t i) {
    return Eigen::Vector3d(part.world_from_part * (cloud.origin + cloud.point[i].cast<double>()));
  };
  if (part.surfels.empty())
    for (std::size_t i = 0; i < cloud.size(); ++i) use(i, position(i));
  else
    for (const std::uint32_t i : part.surfels) use(i, position(i));
}

/// Height of the ground at a query position by the tangent plane of one surfel.
struct HeightHint {
  double height, distance, noise;
  Eigen::Vector3d normal;
  bool reaches;  ///< true: the query lies on the surfel's own patch
};

/// The surfels of one part with an index over x and y.
struct Ground::Sheet {
  static constexpr double hole_spacings = 3, reach_spacings = 1.25, weight_of_reach = 0.6;
  static constexpr double most_of_mean = 4;  // a surfel's spacing counts as within a factor of the mean one
  // Surfels more than a spacing and four deviations below the top of a sheet belong to another sheet.
  static constexpr double sheet_noises = 4;
  // Smallest z of a normal: steeper surfels than 80 degrees give no height beside themselves.
  static constexpr double least_rise = 0.17;

  explicit Sheet(const PlacedPart& part) {
    std::vector<Eigen::Vector3f> flat;
    const SceneCloud& cloud = *part.cloud;
    double area = 0;
    for_each_surfel(part, [&](std::size_t i, const Eigen::Vector3d& world) {
      if (position.empty()) origin = world.array().round();
      const Eigen::Vector3f p = (world - origin).cast<float>();
      position.push_back(p);
      flat.emplace_back(p.x(), p.y(), 0.0f);
      low = low.cwiseMin(world.head<2>()), high = high.cwiseMax(world.head<2>());
      highest = std::max(highest, world.z());
      const Eigen::Vector3f n = part.world_from_part.linear().cast<float>() * cloud.normal[i];
      normal.push_back(n.z() < 0 ? Eigen::Vector3f(-n) : n);
      spacing.push_back(std::sqrt(cloud.area[i]));
      if (!cloud.noise.empty()) noise.push_back(cloud.noise[i]);
      area += cloud.area[i];
    });
    mean_spacing = std::sqrt(area / static_cast<double>(position.size()));
    index = SceneIndex(flat);
    // A search from far away would visit most of the tree.
    const double beyond = 1.1 * hole_spacings * spacing_that_counts(std::ranges::max(spacing));
    low.array() -= beyond, high.array() += beyond;
    // Heights rise from those of surfels by no more than the distance from them, which at() limits.
    const double off = noise.empty() ? 0 : static_cast<double>(std::ranges::max(noise));
    highest += 1.02 * beyond + 2 * off;
  }

  std::optional<GroundPoint> at(const Eigen::Vector2d& world) const {
    if ((world.array() < low.array()).any() || (world.array() > high.array()).any()) return std::nullopt;
    thread_local std::vector<Neighbour> found;
    const Eigen::Vector3f query(static_cast<float>(world.x() - origin.x()), static_cast<float>(world.y() - origin.y()),
                                0.0f);
    index.find_nearest(query, 1, found);
    const double nearest = std::sqrt(static_cast<double>(found.front().squared_distance));
    const double spacing_here = spacing_that_counts(spacing[found.front().index]);
    if (!(nearest <= hole_spacings * spacing_here)) return std::nullopt;
    const double off = noise.empty() ? 0 : static_cast<double>(noise[found.front().index]);
    const double reach = std::max(reach_spacings * spacing_here + 2 * off, 1.01 * nearest);
    index.find_within(query, static_cast<float>(reach), found);
    return topmost(query, spacing_here, reach, found);
  }

  double spacing_that_counts(float own) const {
    return std::clamp(static_cast<double>(own), mean_spacing / most_of_mean, mean_spacing * most_of_mean);
  }

  /// Returns the height by the tangent plane of a surfel. A steep surfel reaches less far to the side.
  HeightHint hint_of(const Eigen::Vector3f& query, const Neighbour& neighbour) const {
    const std::uint32_t i = neighbour.index;
    const Eigen::Vector3d d = (query - position[i]).cast<double>(), n = normal[i].cast<double>();
    const double distance = std::sqrt(static_cast<double>(neighbour.squared_distance));
    const double off = noise.empty() ? 0 : static_cast<double>(noise[i]);
    const double size = std::min(static_cast<double>(spacing[i]), most_of_mean * mean_spacing);
    const double fall = (n.x() * d.x() + n.y() * d.y()) / std::max(n.z(), least_rise);
    const bool reaches = std::hypot(distance, fall) <= reach_spacings * size + 2 * off;
    return {static_cast<double>(position[i].z()) - fall, distance, off, n, reaches};
  }

  std::optional<GroundPoint> topmost(const Eigen::Vector3f& query, double spacing_here, double reach,
                                     const std::vector<Neighbour>& found) const {
    thread_local std::vector<HeightHint> hints;
    hints.clear();
    for (const Neighbour& neighbour : found)
      if (const HeightHint hint = hint_of(query, neighbour); hint.reaches) hints.push_back(hint);
    // Between the surfels of a cliff and at the edge of a hole, use the heights of neighbours, which rise by 45 degrees
    // at most.
    if (hints.empty())
      for (const Neighbour& neighbour : found) {
        HeightHint hint = hint_of(query, neighbour);
        const double z = static_cast<double>(position[neighbour.index].z());
        hint.height = std::clamp(hint.height, z - hint.distance, z + hint.distance);
        hints.push_back(hint);
      }
    std::sort(hints.begin(), hints.end(), [](const HeightHint& a, const HeightHint& b) { return a.height > b.height; });
    // A single surfel above all others is a stray: the sheet below it counts.
    const std::size_t least = std::min<std::size_t>(3, (hints.size() + 2) / 3);
    std::size_t begin = 0, end = 0;
    for (; begin < hints.size(); ++begin) {
      const double lowest = hints[begin].height - spacing_here - sheet_noises * hints[begin].noise;
      for (end = begin; end < hints.size() && hints[end].height >= lowest;) ++end;
      if (end - begin >= least) break;
    }
    double sum = 0, height = 0;
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    for (std::size_t h = begin; h < end; ++h) {
      const double far = hints[h].distance / (weight_of_reach * reach), weight = std::exp(-far * far);
      sum += weight, height += weight * hints[h].height, mean += weight * hints[h].normal;
    }
    if (!(sum > 0)) return std::nullopt;
    return GroundPoint{origin.z() + height / sum,
                       mean.norm() > 0 ? Eigen::Vector3d(mean.normalized()) : Eigen::Vector3d::UnitZ()};
  }

  /// Returns true if both sheets give the same ground everywhere because their surfels coincide.
  bool coincides(const Sheet& other) const {
    return origin == other.origin && position == other.position && normal == other.normal && spacing == other.spacing &&
           noise == other.noise;
  }
  /// Returns a hash that is equal for sheets that coincide.
  std::size_t hash() const {
    const auto of = [](const auto& list) {
      return std::hash<std::string_view>{}(
          {reinterpret_cast<const char*>(list.data()), list.size() * sizeof(list.front())});
    };
    return of(position) ^ (3 * of(normal));
  }

  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  Eigen::Vector2d low = Eigen::Vector2d::Constant(1e300), high = -low;  // box of positions with ground
  std::vector<Eigen::Vector3f> position, normal;
  std::vector<float> spacing, noise;
  double mean_spacing = 0, highest = -std::numeric_limits<double>::infinity();  // upper bound of all heights
  SceneIndex index{std::span<const Eigen::Vector3f>{}};
};

}  // namespace insonify
