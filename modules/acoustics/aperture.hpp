// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <complex>
#include <span>
#include <vector>

#include <Eigen/Core>

namespace insonify {

/// Returns the Fresnel integrals C(x) + i S(x) = int_0^x exp(i pi t^2 / 2) dt (E149), to 1e-13: power series, beyond
/// 1.5 a continued fraction (Press et al., Numerical Recipes, section 6.8).
std::complex<double> fresnel_integral(double x);

/// Corners of a convex polygon, counterclockwise.
using ConvexPolygon = std::vector<Eigen::Vector2d>;

/// Returns the pressure factor with which an aperture transmits a spherical wave (E150): 1 for an aperture without
/// edges, 1/2 with a straight edge through the line of sight. Corners are Fresnel parameters, v = x sqrt(2 (r1 + r2) /
/// (wavelength r1 r2)) with x across the line of sight. The factor is the integral of exp(i pi v^2 / 2) / 2i over the
/// polygon, computed along its sides; for a rectangle with sides along the axes, it is the product of (E(v2) - E(v1)) /
/// (1 + i), E of E149. Accurate to 1e-5; corners farther than 1e5 are taken to be at infinity.
std::complex<double> aperture_factor(std::span<const Eigen::Vector2d> corners);

/// Returns the same polygon with its corners in that order.
ConvexPolygon counterclockwise(ConvexPolygon polygon);
/// Returns the part of a polygon where `inward` . v >= `offset`.
ConvexPolygon clipped(const ConvexPolygon& polygon, const Eigen::Vector2d& inward, double offset);
/// Returns the part of a polygon inside another.
ConvexPolygon clipped(const ConvexPolygon& polygon, const ConvexPolygon& other);

}  // namespace insonify
