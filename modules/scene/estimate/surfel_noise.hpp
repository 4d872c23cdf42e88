// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <span>
#include <vector>

#include <Eigen/Core>

namespace insonify {

/// Options of estimate_surfel_noise.
struct SurfelNoiseOptions {
  int neighbours = 16;  ///< nearest points, the point itself among them; at least 6
  int threads = 0;      ///< 0: all cores
};

/// Returns the noise of the surface about each point [m]: the distance from their common plane within which two thirds
/// of the nearest points lie, one standard deviation of a normal law within 20 % (E67). Points of another surface, up
/// to a third, do not count. Relief as fine as the points themselves looks like noise. Fewer points than neighbours
/// give 0.
std::vector<float> estimate_surfel_noise(std::span<const Eigen::Vector3f> points,
                                         const SurfelNoiseOptions& options = {});

}  // namespace insonify
