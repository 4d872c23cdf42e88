// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <optional>

#include <Eigen/Core>

#include "acoustics/surfel_group_internal.hpp"

// Private to acoustics: planes and round bodies through surfels, and what their residuals may be (E161).
namespace insonify {

inline constexpr std::size_t fewest_surfels = 12;  // of a plane
inline constexpr double explained_share = 0.95;    // of the area of a part, at least, by a shape

/// The noise of the surfels of a part about its shape.
struct SurfelNoise {
  double deviation =
      0;  ///< standard deviation across the surface [m], from residuals of quadratics through 24 neighbours
  double rounding = 0;  ///< rounding of coordinates as float32, and 2e-5 of the part's size [m]

  /// Returns the largest distance of a surfel from its shape [m].
  double reach() const { return 3.5 * std::hypot(deviation, rounding); }
  /// Returns true if noise explains a mean square residual [m^2] of `count` effective surfels: up to 1.15 times its
  /// variance and two and a half standard errors more (E161).
  bool explains(double mean_square, double count) const {
    return mean_square <= deviation * deviation * (1.15 + 2.5 * std::sqrt(5 / count)) + rounding * rounding;
  }
};
/// Returns the noise of a part by at most 2000 of its neighbourhoods: the median of what their quadratics leave.
SurfelNoise noise_of(const SurfelGroup& group);

/// Returns the number of surfels of equal area that weigh as these do: (sum of areas)^2 / sum of their squares.
double effective_count(const SurfelGroup& group);

/// A plane by least squares: its normal on the side of those of the surfels.
struct FittedPlane {
  Eigen::Vector3d position, normal;
  double mean_square;  ///< mean square distance of the surfels, by area [m^2]
};
FittedPlane plane_through(const SurfelGroup& group);
/// Returns the plane of nearly all surfels of a part, and these; nothing if they are too few or noise does not explain
/// how they stray.
std::optional<std::pair<FittedPlane, SurfelGroup>> flat_group(const SurfelGroup& group, const SurfelNoise& noise);

/// A sphere, or a cylinder about `axis`.
struct RoundBody {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero(), axis = Eigen::Vector3d::Zero();  ///< axis: zero of a sphere
  double radius = 0;
  double mean_square = 0;  ///< mean square distance of its surfels, by area [m^2]

  /// Returns the vector from the centre or axis to a position, across the axis.
  Eigen::Vector3d away(const Eigen::Vector3d& position) const {
    const Eigen::Vector3d from = position - centre;
    return from - axis * axis.dot(from);
  }
};
/// Returns the sphere, or the cylinder about an axis near `axis`, of nearly all surfels of a part; nothing if they do not
/// lie on one that is convex. Gauss and Newton's method on the distances, from the linear fit of the squared ones.
std::optional<RoundBody> round_body(const SurfelGroup& group, const SurfelNoise& noise,
                                    const Eigen::Vector3d& axis = Eigen::Vector3d::Zero());

}  // namespace insonify
