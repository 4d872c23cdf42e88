// SPDX-License-Identifier: BSD-3-Clause
#include "scene/estimate/surfel_noise.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "scene/estimate/surfel_noise_internal.hpp"
#include "scene/scene_index.hpp"

namespace insonify {

using Eigen::Matrix3d, Eigen::Vector3d, Eigen::Vector3f;

double spread_about_plane(std::span<const Vector3f> points, std::span<const Neighbour> nearest,
                          std::vector<double>& distance) {
  Vector3d mean = Vector3d::Zero();
  for (const Neighbour& n : nearest) mean += points[n.index].cast<double>();
  mean /= static_cast<double>(nearest.size());
  Matrix3d moments = Matrix3d::Zero();
  for (const Neighbour& n : nearest) {
    const Vector3d offset = points[n.index].cast<double>() - mean;
    moments += offset * offset.transpose();
  }
  Eigen::SelfAdjointEigenSolver<Matrix3d> solver;
  const Vector3d normal = solver.computeDirect(moments).eigenvectors().col(0);
  distance.clear();
  for (const Neighbour& n : nearest) distance.push_back(std::abs(normal.dot(points[n.index].cast<double>() - mean)));
  const auto middle = distance.begin() + static_cast<std::ptrdiff_t>(distance.size() * 2 / 3);
  std::nth_element(distance.begin(), middle, distance.end());
  const auto count = static_cast<double>(distance.size());
  return *middle * std::sqrt(count / (count - 3));  // (E67): the plane takes three degrees of freedom
}

std::vector<float> estimate_surfel_noise(std::span<const Vector3f> points, const SurfelNoiseOptions& options) {
  if (options.neighbours < 6)
    fail(ErrorKind::argument, "estimate_surfel_noise: neighbours = ", options.neighbours, ", must be at least 6");
  const auto neighbours = static_cast<std::size_t>(options.neighbours);
  std::vector<float> noise(points.size(), 0.0f);
  if (points.size() < neighbours) return noise;
  const SceneIndex index(points);
  parallel_blocks(points.size(), 1024, options.threads, [&](std::size_t begin, std::size_t end) {
    std::vector<Neighbour> nearest;
    std::vector<double> distance;
    for (std::size_t i = begin; i < end; ++i) {
      index.find_nearest(points[i], neighbours, nearest);
      noise[i] = static_cast<float>(spread_about_plane(points, nearest, distance));
    }
  });
  return noise;
}

}  // namespace insonify
