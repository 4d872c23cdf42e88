#pragma once
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include <Eigen/Core>

#include "scene/scene_cloud.hpp"

namespace insonify {

/// A smooth piece of surface over the unit square: position [m] at (u, v). `at` must stay smooth a hair
/// beyond [0, 1]. The normal is d/du x d/dv, turned round by `flip`.
struct Patch {
  std::function<Eigen::Vector3d(double u, double v)> at;
  std::uint16_t material = 0;
  double density = 1;  ///< points per area, relative to the other patches
  bool flip = false;
};

/// The same patch with its normal pointing away from `inside` (at the middle of the patch).
Patch facing_away_from(const Eigen::Vector3d& inside, Patch patch);

Patch rectangle(const Eigen::Vector3d& corner, const Eigen::Vector3d& edge_u, const Eigen::Vector3d& edge_v);
/// The side of a cylinder, without its ends; normal outward.
Patch cylinder(const Eigen::Vector3d& base, const Eigen::Vector3d& axis, double radius);
/// An ellipsoid with axes along x, y, z; normal outward.
Patch ellipsoid(const Eigen::Vector3d& centre, const Eigen::Vector3d& radii);
/// A torus around the vertical axis through `centre`; normal outward.
Patch torus(const Eigen::Vector3d& centre, double radius, double tube_radius);

/// Appends about `points` surfels, spread over the patches by area times density: rows of constant u, in each
/// row one jittered surfel per equal interval of v. Areas are those of the surface, and add up to it patch by
/// patch.
void sample_patches(SceneCloud& scene, const std::vector<Patch>& patches, std::size_t points, std::uint64_t seed);

/// The same surfels, handed over in scenes of about `batch` surfels with the origin and materials of `like`, ids ascending
/// from 0. Every surfel is computed twice: the areas of a patch are scaled by their sum.
void sample_patches_in_batches(const SceneCloud& like, const std::vector<Patch>& patches, std::size_t points,
                               std::uint64_t seed, std::size_t batch,
                               const std::function<void(const SceneCloud&)>& take);

}  // namespace insonify
