// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <vector>

#include <Eigen/Core>

#include "acoustics/mirror.hpp"
#include "scene/scene_cloud.hpp"

namespace insonify {

/// A body that reflects as a whole: a plate, a sphere or a cylinder. World frame [m].
struct SmoothTarget {
  Mirror surface{};            ///< reflection and roughness; for a plate its corners too
  std::uint16_t material = 0;  ///< material of its surfels
  double radius = 0;           ///< radius [m]; 0: a plate
  double length = 0;           ///< length of a cylinder about surface.place, along `axis` [m]; 0: a sphere
  Eigen::Vector3d axis = Eigen::Vector3d::Zero();
};

/// Bodies of a scene that reflect as a whole.
struct SmoothShapes {
  std::vector<Mirror> mirrors;
  std::vector<SmoothTarget> targets;

  /// Returns true if there are none.
  bool empty() const { return mirrors.empty() && targets.empty(); }
};

/// Returns the shapes of the surfels within `radius` [m] of `centre` (world) whose materials have is_smooth: mirrors
/// for flat parts of materials with `mirror`; for each connected part of a material with `coherent` the simplest shape
/// that noise, rounding and facets explain (E161): one plane, a cylinder with its ends as plates or a sphere, planes.
/// Least squares, weighted by area.
///
/// A plane ends where the area of its surfels puts the edges of their convex outline (E162). Surfels are connected if
/// they are within three spacings of the largest surfel of each other. Planes of fewer than twelve surfels are left
/// out. Throws Error(content) for a coherent part of which no shape holds 95 % of the area, and for a plane that fills
/// less than half of its outline.
SmoothShapes fit_shapes(const SceneCloud& scene, const Eigen::Vector3d& centre, double radius);

}  // namespace insonify
