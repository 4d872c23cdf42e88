// SPDX-License-Identifier: BSD-3-Clause
#include "support/bounced_ray.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>
#include <Eigen/LU>

namespace insonify::traced {
namespace {

using Eigen::Vector3d;

constexpr double longest_step = 0.01, longest_way = 400;

struct Shot {
  Vector3d at = Vector3d::Zero(), along;
  double time = 0;
};

/// Sound speed in one layer; beyond it the gradient continues.
struct LayerSpeed {
  double speed, gradient, at;
};

/// Takes one stride of Runge and Kutta over the length of the ray, in one layer.
Shot moved_on(const LayerSpeed& layer, double depth, const Shot& s, double stride) {
  struct Rate {
    Vector3d at, along;
    double time;
  };
  const auto rate = [&](const Vector3d& at, const Vector3d& along) -> Rate {
    const double c = layer.speed + layer.gradient * (depth - at.z() - layer.at);
    const Vector3d rise(0, 0, -layer.gradient);  // gradient of sound speed
    return {along, -(rise - along * along.dot(rise)) / c, 1 / c};
  };
  const Rate a = rate(s.at, s.along), b = rate(s.at + stride / 2 * a.at, s.along + stride / 2 * a.along),
             c = rate(s.at + stride / 2 * b.at, s.along + stride / 2 * b.along),
             d = rate(s.at + stride * c.at, s.along + stride * c.along);
  return {s.at + stride / 6 * (a.at + 2 * b.at + 2 * c.at + d.at),
          (s.along + stride / 6 * (a.along + 2 * b.along + 2 * c.along + d.along)).normalized(),
          s.time + stride / 6 * (a.time + 2 * b.time + 2 * c.time + d.time)};
}

/// Continues until `before` is false, and to the point where that happens. Steps end where the gradient changes.
template <typename Before>
std::optional<Shot> shot_while(const Water& water, double depth, Shot s, const Before& before) {
  const auto layers_above = [&](double z) {
    return std::lower_bound(water.depth.begin(), water.depth.end(), z) - water.depth.begin();
  };
  for (double way = 0; way < longest_way;) {
    const double inside = depth - s.at.z() - 1e-9 * s.along.z();
    const LayerSpeed layer{water.speed_at(inside), water.gradient_at(inside), inside};
    const auto goes_on = [&](const Shot& next) {
      return before(next) && layers_above(depth - next.at.z()) == layers_above(inside);
    };
    double low = 0, high = longest_step;
    if (goes_on(moved_on(layer, depth, s, high))) {
      s = moved_on(layer, depth, s, high), way += high;
      continue;
    }
    for (int k = 0; k < 60; ++k) {
      const double middle = 0.5 * (low + high);
      (goes_on(moved_on(layer, depth, s, middle)) ? low : high) = middle;
    }
    s = moved_on(layer, depth, s, high), way += high;
    if (!before(s)) return s;
  }
  return std::nullopt;
}

std::optional<Shot> shot(const Water& water, double depth, std::span<const Plane> planes, const Vector3d& position,
                         const Vector3d& launch) {
  std::optional<Shot> s = Shot{Vector3d::Zero(), launch, 0};
  for (const Plane& plane : planes) {
    s = shot_while(water, depth, *s, [&](const Shot& at) { return plane.normal.dot(at.at) > plane.offset; });
    if (!s) return s;
    s->along -= 2 * plane.normal.dot(s->along) * plane.normal;
  }
  return shot_while(water, depth, *s, [&](const Shot& at) { return (position - at.at).dot(at.along) > 0; });
}

}  // namespace

std::optional<BouncedArrival> arrival_by_planes(const Water& water, double depth, std::span<const Plane> planes,
                                                const Vector3d& position) {
  Vector3d image = position;
  for (std::size_t k = planes.size(); k > 0; --k)
    image -= 2 * (planes[k - 1].normal.dot(image) - planes[k - 1].offset) * planes[k - 1].normal;
  Vector3d launch = image.normalized();
  for (int stride = 0; stride < 60; ++stride) {
    const auto s = shot(water, depth, planes, position, launch);
    if (!s) return std::nullopt;
    const Vector3d across = launch.unitOrthogonal(), other = launch.cross(across);
    const Vector3d e1 = s->along.unitOrthogonal(), e2 = s->along.cross(e1);
    const auto miss = [&](const Vector3d& at) { return Eigen::Vector2d(e1.dot(at - position), e2.dot(at - position)); };
    constexpr double turn = 1e-5;
    Eigen::Matrix2d by_angle;
    for (int k = 0; k < 2; ++k) {
      const Vector3d& sideways = k == 0 ? across : other;
      const auto ahead = shot(water, depth, planes, position, (launch + turn * sideways).normalized());
      const auto behind = shot(water, depth, planes, position, (launch - turn * sideways).normalized());
      if (!ahead || !behind) return std::nullopt;
      by_angle.col(k) = (miss(ahead->at) - miss(behind->at)) / (2 * turn);
    }
    const double ratio = water.speed_at(depth - position.z()) / water.speed_at(depth);
    if (miss(s->at).norm() < 1e-6)
      return BouncedArrival{s->time, launch, s->along, ratio / std::abs(by_angle.determinant())};
    constexpr double farthest_turn = 0.03;  // [rad]
    Eigen::Vector2d turned = -by_angle.inverse() * miss(s->at);
    if (turned.norm() > farthest_turn) turned *= farthest_turn / turned.norm();
    launch = (launch + turned.x() * across + turned.y() * other).normalized();
  }
  return std::nullopt;
}

}  // namespace insonify::traced
