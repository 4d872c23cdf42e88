// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <numeric>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/text.hpp"
#include "scene/scene_cloud.hpp"

namespace insonify {

using Members = std::vector<std::uint32_t>;  // indices of surfels, ascending

/// Surfels of a scene; places in the world [m].
struct SurfelGroup {
  const SceneCloud& scene;
  Members members;

  Eigen::Vector3d point(std::uint32_t s) const { return scene.origin + scene.point[s].cast<double>(); }
  Eigen::Vector3d normal(std::uint32_t s) const { return scene.normal[s].cast<double>(); }
  double area() const {
    return std::accumulate(members.begin(), members.end(), 0.0,
                           [&](double sum, auto s) { return sum + scene.area[s]; });
  }
  double spacing() const { return std::sqrt(area() / static_cast<double>(members.size())); }
  Eigen::Vector3d middle() const {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const std::uint32_t s : members) sum += scene.area[s] * point(s);
    return sum / area();
  }
  /// sum of area x x^T over what `of` makes of a surfel.
  template <typename Of>
  Eigen::Matrix3d moments(const Of& of) const {
    Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
    for (const std::uint32_t s : members) {
      const Eigen::Vector3d x = of(s);
      sum += scene.area[s] * x * x.transpose();
    }
    return sum / area();
  }
  template <typename Keep>
  SurfelGroup where(const Keep& keep) const {
    SurfelGroup group{scene, {}};
    std::copy_if(members.begin(), members.end(), std::back_inserter(group.members), keep);
    return group;
  }
  std::string position_text() const {
    const Eigen::Vector3d p = middle();
    return printed("%zu surfels about (%.4g, %.4g, %.4g) m", members.size(), p.x(), p.y(), p.z());
  }
};

/// Returns the members of `all` that are not in `taken`.
inline Members without(const Members& all, const Members& taken) {
  Members rest;
  std::set_difference(all.begin(), all.end(), taken.begin(), taken.end(), std::back_inserter(rest));
  return rest;
}

/// Parts whose surfels lie within `link` [m] of each other: cells of that size that touch.
std::vector<SurfelGroup> connected_groups(const SurfelGroup& all, double link);

}  // namespace insonify
