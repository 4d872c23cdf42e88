// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include <Eigen/Core>

#include "scene/scene_cloud.hpp"

namespace insonify {

/// A smooth surface patch over the unit square: position [m] at (u, v). `at` must remain smooth slightly beyond [0, 1],
/// where central differences evaluate it. The normal is d/du x d/dv, negated if `flip`.
struct Patch {
  std::function<Eigen::Vector3d(double u, double v)> at;
  std::uint16_t material = 0;
  double density = 1;  ///< points per area, relative to the other patches
  bool flip = false;
};

/// Returns the patch with its normal pointing away from `inside`, tested at the middle of the patch.
Patch facing_away_from(const Eigen::Vector3d& inside, Patch patch);

Patch rectangle(const Eigen::Vector3d& corner, const Eigen::Vector3d& edge_u, const Eigen::Vector3d& edge_v);
/// Returns the lateral surface of a cylinder; normal outward.
Patch cylinder(const Eigen::Vector3d& base, const Eigen::Vector3d& axis, double radius);
/// Returns an ellipsoid with axes along x, y, z; normal outward.
Patch ellipsoid(const Eigen::Vector3d& centre, const Eigen::Vector3d& radii);
/// Returns a torus around the vertical axis through `centre`; normal outward.
Patch torus(const Eigen::Vector3d& centre, double radius, double tube_radius);

/// Appends about `points` surfels, distributed over the patches by area times density, in rows of constant u with one
/// jittered surfel per equal interval of v. The areas of each patch add up to its exact area.
void sample_patches(SceneCloud& scene, const std::vector<Patch>& patches, std::size_t points, std::uint64_t seed);

/// Passes the same surfels to `consume` in scenes of about `batch` surfels with the origin and materials of `like`, ids
/// ascending from 0. Computes every surfel twice, since the areas of a patch are scaled by their sum.
void sample_patches_in_batches(const SceneCloud& like, const std::vector<Patch>& patches, std::size_t points,
                               std::uint64_t seed, std::size_t batch,
                               const std::function<void(const SceneCloud&)>& consume);

}  // namespace insonify
