// SPDX-License-Identifier: BSD-3-Clause
#include "acoustics/aperture.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/units.hpp"

namespace insonify {
namespace {

using complex = std::complex<double>;
constexpr complex imaginary(0, 1);
constexpr double far_off = 1e5;  // what an edge there takes off is below 1 / (pi far_off)
constexpr double far_along = 5;  // from there on the series of the end of a side is good to 1e-5

/// Nodes and weights of Gauss and Legendre on [0, 1].
struct Quadrature {
  static constexpr int n = 32;
  std::array<double, n> node{}, weight{};
  Quadrature() {
    for (int k = 0; k < n; ++k) {
      double x = std::cos(pi * (k + 0.75) / (n + 0.5)), slope = 1;
      for (int step = 0; step < 100; ++step) {
        const double p = std::legendre(n, x);
        slope = n * (x * p - std::legendre(n - 1, x)) / (x * x - 1);
        const double change = p / slope;
        x -= change;
        if (std::abs(change) < 1e-15) break;
      }
      node[static_cast<std::size_t>(k)] = 0.5 * (x + 1);
      weight[static_cast<std::size_t>(k)] = 1 / ((1 - x * x) * slope * slope);
    }
  }
};

/// int_0^along of h (1 - exp(i pi (h^2 + t^2) / 2)) / (h^2 + t^2) dt for h > 0 and along >= 0: twice pi what a part of a
/// side adds that begins at the foot of the perpendicular from the line of sight, h away.
complex share_of_side(double h, double along) {
  const double angle = std::atan2(along, h);
  if (h > far_off) return angle;
  if (along < far_along) {
    static const Quadrature rule;
    complex sum = 0;
    for (std::size_t k = 0; k < rule.n; ++k) {
      const double t = along * rule.node[k], square = h * h + t * t, half = pi / 4 * square;
      // 1 - exp(2 j half) = -2 j sin(half) exp(j half), j the imaginary unit
      sum += rule.weight[k] * std::sin(half) / square * std::polar(1.0, half);
    }
    return -2.0 * imaginary * (along * h * sum);
  }
  const complex whole = pi / 2 * (1.0 - 2.0 / (1.0 + imaginary) * fresnel_integral(h));
  if (along > far_off) return angle - whole;
  // Two terms of the integration by parts from `along` to infinity.
  const double square = h * h + along * along;
  const complex per_phase = 1.0 / (imaginary * pi * along), first = h / square * per_phase,
                second = -h * (1 / (square * along * along) + 2 / (square * square)) / (imaginary * pi) * per_phase;
  return angle - whole - std::polar(1.0, std::remainder(pi / 2 * square, 2 * pi)) * (first - second);
}

complex signed_share(double h, double along) {
  const complex share = h == 0 ? 0 : share_of_side(std::abs(h), std::abs(along));
  return (h < 0) != (along < 0) ? -share : share;
}

}  // namespace

complex fresnel_integral(double x) {
  const double size = std::abs(x), square = pi * size * size;
  complex integral;
  if (size < 1.5) {
    complex term = size;
    for (int n = 0; n < 60 && std::abs(term) > 1e-17; ++n) {
      integral += term / (2.0 * n + 1);
      term *= imaginary * (square / 2) / (n + 1.0);
    }
  } else {
    complex b(1, -square), c = 1e300, d = 1.0 / b, fraction = d;
    for (int n = 1; n < 200; n += 2) {
      const double a = -n * (n + 1.0);
      b += 4;
      d = 1.0 / (a * d + b);
      c = b + a / c;
      const complex change = c * d;
      fraction *= change;
      if (std::abs(change - 1.0) < 1e-15) break;
    }
    const complex phase = std::polar(1.0, std::remainder(square / 2, 2 * pi));
    integral = complex(0.5, 0.5) * (1.0 - phase * fraction * complex(size, -size));
  }
  return x < 0 ? -integral : integral;  // (E149)
}

complex aperture_factor(std::span<const Eigen::Vector2d> corners) {
  complex sum = 0;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Eigen::Vector2d &a = corners[k], side = corners[(k + 1) % corners.size()] - a;
    const double length = side.norm();
    if (length == 0) continue;
    const double h = (a.x() * side.y() - a.y() * side.x()) / length, along = a.dot(side) / length;
    sum += signed_share(h, along + length) - signed_share(h, along);
  }
  return sum / (2 * pi);  // (E150)
}

ConvexPolygon counterclockwise(ConvexPolygon polygon) {
  double area = 0;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Eigen::Vector2d &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
    area += a.x() * b.y() - a.y() * b.x();
  }
  if (area < 0) std::reverse(polygon.begin(), polygon.end());
  return polygon;
}

ConvexPolygon clipped(const ConvexPolygon& polygon, const Eigen::Vector2d& inward, double offset) {
  ConvexPolygon rest;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Eigen::Vector2d &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
    const double in_a = inward.dot(a) - offset, in_b = inward.dot(b) - offset;
    if (in_a >= 0) rest.push_back(a);
    if ((in_a >= 0) != (in_b >= 0)) rest.push_back(a + in_a / (in_a - in_b) * (b - a));
  }
  return rest;
}

ConvexPolygon clipped(const ConvexPolygon& polygon, const ConvexPolygon& other) {
  ConvexPolygon rest = polygon;
  for (std::size_t k = 0; k < other.size() && !rest.empty(); ++k) {
    const Eigen::Vector2d &a = other[k], side = other[(k + 1) % other.size()] - a;
    const Eigen::Vector2d inward(-side.y(), side.x());
    rest = clipped(rest, inward, inward.dot(a));
  }
  return rest;
}

}  // namespace insonify
