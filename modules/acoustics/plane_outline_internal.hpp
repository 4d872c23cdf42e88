// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <vector>

#include <Eigen/Core>

#include "acoustics/mirror.hpp"
#include "acoustics/shape_fits_internal.hpp"
#include "scene/material.hpp"

// Private to acoustics: the edges of captured planes.
namespace insonify {

/// Returns how far a convex surface reaches beyond the outline of its surfels' centres [m], at most half of `spacing`, so
/// that it has the area of the surfels (E162). Half of the spacing if they fill less than 85 % of that outline: they are
/// not convex.
double edge_beyond_centres(const std::vector<Eigen::Vector2d>& positions, double area, double spacing);

/// Returns the plane of these surfels with its edges. Throws Error(content) if they fill less than half of them.
Mirror mirror_of(const SurfelGroup& group, const FittedPlane& plane, const Material& material);

}  // namespace insonify
