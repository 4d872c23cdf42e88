// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include <Eigen/Core>

// Private to scene: the distinct positions of a cloud, for which shapes are estimated.
namespace insonify::cells {

using Eigen::Vector3f;

// Distinct points of a cloud and how often each occurs.
struct DistinctPoints {
  std::vector<std::uint32_t> first;     // one point of the cloud for each distinct position
  std::vector<std::uint32_t> position;  // index into `first` for each point of the cloud
  std::vector<std::uint32_t> copies;    // number of points at each distinct position
};

inline DistinctPoints find_distinct(std::span<const Vector3f> points) {
  std::vector<std::uint32_t> order(points.size());
  std::iota(order.begin(), order.end(), 0u);
  const auto key = [&](std::uint32_t i) { return std::array{points[i].x(), points[i].y(), points[i].z()}; };
  std::sort(order.begin(), order.end(),
            [&](std::uint32_t a, std::uint32_t b) { return key(a) != key(b) ? key(a) < key(b) : a < b; });
  DistinctPoints distinct;
  distinct.position.resize(points.size());
  for (std::size_t k = 0; k < order.size(); ++k) {
    if (k == 0 || points[order[k]] != points[order[k - 1]]) {
      distinct.first.push_back(order[k]);
      distinct.copies.push_back(0);
    }
    distinct.position[order[k]] = static_cast<std::uint32_t>(distinct.first.size() - 1);
    ++distinct.copies.back();
  }
  return distinct;
}

// Distinct positions with their estimates.
struct Estimate {
  DistinctPoints distinct;
  std::vector<Vector3f> position;
  std::vector<double> area;
  std::vector<std::uint32_t>
      visit;  // the positions in the order of the cloud, in which neighbours mostly follow another
};

// Merges coincident points. The cell of a position is divided among its points at the end.
inline Estimate distinct_points(std::span<const Vector3f> points) {
  Estimate e;
  e.distinct = find_distinct(points);
  for (const std::uint32_t first : e.distinct.first) e.position.push_back(points[first]);
  e.area.assign(e.position.size(), 0.0);
  for (std::size_t i = 0; i < points.size(); ++i)
    if (e.distinct.first[e.distinct.position[i]] == i) e.visit.push_back(e.distinct.position[i]);
  return e;
}

inline std::vector<float> shared_areas(const Estimate& e, std::size_t points) {
  std::vector<float> areas(points);
  for (std::size_t i = 0; i < points; ++i) {
    const std::uint32_t d = e.distinct.position[i];
    areas[i] = static_cast<float>(e.area[d] / e.distinct.copies[d]);
  }
  return areas;
}

// Returns the values of distinct positions for all points.
inline std::vector<float> at_points(const std::vector<float>& values, const Estimate& e) {
  std::vector<float> all;
  for (const std::uint32_t distinct : e.distinct.position) all.push_back(values[distinct]);
  return all;
}

}  // namespace insonify::cells
