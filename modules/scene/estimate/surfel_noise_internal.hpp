// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <span>
#include <vector>

#include <Eigen/Core>

#include "scene/scene_index.hpp"

// Private to scene: the noise of a surfel among its neighbours.
namespace insonify {

// Number of nearest points, the point itself among them, whose spread is the noise of a surfel by default.
inline constexpr int noise_neighbours = 16;

// Returns the distance from their plane within which two thirds of the points lie (E67). `distance` is for reuse.
double spread_about_plane(std::span<const Eigen::Vector3f> points, std::span<const Neighbour> nearest,
                          std::vector<double>& distance);

}  // namespace insonify
