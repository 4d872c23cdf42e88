// SPDX-License-Identifier: BSD-3-Clause
// A sea bed of facets, spheres, and boxes of six faces, with the true hits of rays in closed form, and surfels scanned
// from it.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <random>
#include <vector>

#include <Eigen/Geometry>

#include "core/units.hpp"
#include "scene/scene_cloud.hpp"

namespace insonify {

using Eigen::Vector3d;

struct Triangle {
  Vector3d a, u, v;  // a corner and two sides
};
inline constexpr double none = 1e9;

// Returns the range at which a ray meets a triangle (Moeller and Trumbore 1997).
inline double meet(const Triangle& t, const Vector3d& from, const Vector3d& along) {
  const Vector3d p = along.cross(t.v), s = from - t.a, q = s.cross(t.u);
  const double determinant = t.u.dot(p);
  if (std::abs(determinant) < 1e-15) return none;
  const double b = s.dot(p) / determinant, c = along.dot(q) / determinant, r = t.v.dot(q) / determinant;
  return b >= 0 && c >= 0 && b + c <= 1 && r > 0 ? r : none;
}

struct Ball {
  Vector3d centre;
  double radius;
};

// A rough sea bed of facets on a grid of 0.1 m: hills of decimetres, ripples of centimetres, stones of a centimetre.
class SeaBed {
 public:
  static constexpr double cell = 0.1, length = 44, half_width = 22;

  SeaBed() {
    std::mt19937_64 random(3);
    std::uniform_real_distribution<double> stones(-0.01, 0.01);
    for (int j = 0; j <= rows; ++j)
      for (int i = 0; i <= columns; ++i) {
        const double x = i * cell, y = j * cell - half_width;
        heights_.push_back(-8 + 0.25 * std::sin(0.9 * x + 0.3 * y) + 0.2 * std::sin(0.7 * y - 0.2 * x) +
                           0.02 * std::sin(9 * x + 2 * y) + stones(random));
      }
  }

  // Returns the two facets of cell (i, j).
  std::array<Triangle, 2> facets(int i, int j) const {
    const auto at = [&](int di, int dj) {
      return Vector3d((i + di) * cell, (j + dj) * cell - half_width,
                      heights_[static_cast<std::size_t>((j + dj) * (columns + 1) + i + di)]);
    };
    const Vector3d a = at(0, 0), d = at(1, 1) - a;
    return {Triangle{a, at(1, 0) - a, d}, Triangle{a, d, at(0, 1) - a}};
  }

  // Returns the range of the nearest facet that a ray meets, cell by cell along its track.
  double range(const Vector3d& from, const Vector3d& along) const {
    const double steepest = std::hypot(along.x(), along.y());
    double nearest = none;
    const double step = 0.2 * cell / std::max(steepest, 1e-9);
    int last_i = -1, last_j = -1;
    for (double r = std::max(0.0, range_at(highest, from, along)); r < 60; r += std::min(step, 60.0)) {
      const int i = static_cast<int>(std::floor((from.x() + r * along.x()) / cell));
      const int j = static_cast<int>(std::floor((from.y() + r * along.y() + half_width) / cell));
      if (i == last_i && j == last_j) continue;
      last_i = i;
      last_j = j;
      // With its neighbours, for the corners that the steps jump over.
      for (int b = std::max(0, j - 1); b <= std::min(rows - 1, j + 1); ++b)
        for (int a = std::max(0, i - 1); a <= std::min(columns - 1, i + 1); ++a)
          for (const Triangle& t : facets(a, b)) nearest = std::min(nearest, meet(t, from, along));
      if (nearest < r) break;
    }
    return nearest;
  }

  void scan(double spacing, std::mt19937_64& random, SceneCloud& scene) const {
    std::uniform_real_distribution<double> jitter(0.1, 0.9);
    for (double x = 0; x < length - spacing; x += spacing)
      for (double y = -half_width; y < half_width - spacing; y += spacing) {
        const double px = x + jitter(random) * spacing, py = y + jitter(random) * spacing;
        const int i = static_cast<int>(px / cell), j = static_cast<int>((py + half_width) / cell);
        for (const Triangle& t : facets(i, j)) {
          const double r = meet(t, {px, py, 0}, {0, 0, -1});
          if (r == none) continue;
          const Vector3d normal = t.u.cross(t.v).normalized();
          add_surfel(scene, {px, py, -r}, normal, spacing * spacing / normal.z());
          break;
        }
      }
  }

 private:
  static constexpr double highest = -7.5;  // no facet stands above [m]
  static double range_at(double height, const Vector3d& from, const Vector3d& along) {
    return along.z() < -1e-6 ? (height - from.z()) / along.z() : 0;
  }
  static constexpr int columns = static_cast<int>(length / cell), rows = static_cast<int>(2 * half_width / cell);
  std::vector<double> heights_;
};

class World {
 public:
  World() {
    balls_ = {{{9, 2, -6.8}, 0.8}, {{14, -4, -6.5}, 1.2}, {{20, 3, -7}, 0.5}};
    add_box({12, 4, -7}, {1.5, 0.5, 1.5});
    add_box({17, -1, -6.5}, {0.15, 0.15, 2});
    add_box({30, 0, -6}, {0.3, 12, 3});
    add_box({11, -3, -6.5}, {0.05, 0.05, 1.5});
  }

  // Returns the range along a unit direction; nothing if the ray meets no surface.
  std::optional<double> truth(const Vector3d& from, const Vector3d& along) const {
    double nearest = bed_.range(from, along);
    for (const Triangle& t : triangles_) nearest = std::min(nearest, meet(t, from, along));
    for (const Ball& ball : balls_) {
      const Vector3d s = from - ball.centre;
      const double b = s.dot(along), discriminant = b * b - s.squaredNorm() + ball.radius * ball.radius;
      if (discriminant >= 0 && -b - std::sqrt(discriminant) > 0)
        nearest = std::min(nearest, -b - std::sqrt(discriminant));
    }
    return nearest < none ? std::optional(nearest) : std::nullopt;
  }

  // Returns random surfels on all surfaces, thinned to about `spacing` like a scanner's.
  SceneCloud scan(double spacing) const {
    SceneCloud scene;
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> unit(0, 1);
    bed_.scan(spacing, random, scene);
    for (const Triangle& t : triangles_) {
      const Vector3d cross = t.u.cross(t.v);
      const int n = std::max(1, static_cast<int>(std::round(std::sqrt(cross.norm()) / spacing)));
      // n x n small triangles of each kind: a point in the middle of each, jittered.
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < n - i; ++j)
          for (int flip = 0; flip < (j < n - i - 1 ? 2 : 1); ++flip) {
            const double b = (i + (flip ? 2.0 : 1.0) / 3 + 0.3 * (unit(random) - 0.5)) / n;
            const double c = (j + (flip ? 2.0 : 1.0) / 3 + 0.3 * (unit(random) - 0.5)) / n;
            add_surfel(scene, t.a + b * t.u + c * t.v, cross.normalized(), cross.norm() / 2 / (n * n));
          }
    }
    for (const Ball& ball : balls_) {
      const int n = static_cast<int>(4 * pi * ball.radius * ball.radius / (spacing * spacing));
      for (int k = 0; k < n; ++k) {
        const double z = 1 - (2 * k + 1.0) / n, turn = k * pi * (3 - std::sqrt(5.0)), s = std::sqrt(1 - z * z);
        const Vector3d d(s * std::cos(turn), s * std::sin(turn), z);
        add_surfel(scene, ball.centre + ball.radius * d, d, 4 * pi * ball.radius * ball.radius / n);
      }
    }
    return scene;
  }

 private:
  void add_box(const Vector3d& centre, const Vector3d& half) {
    for (int axis = 0; axis < 3; ++axis)
      for (const double side : {-1.0, 1.0}) {
        Vector3d u = Vector3d::Zero(), v = Vector3d::Zero(), n = Vector3d::Zero();
        n[axis] = side * half[axis];
        u[(axis + 1) % 3] = 2 * half[(axis + 1) % 3];
        v[(axis + 2) % 3] = 2 * half[(axis + 2) % 3];
        if (side < 0) std::swap(u, v);  // u x v points outward
        const Vector3d corner = centre + n - u / 2 - v / 2;
        // Two triangles a metre or less on a side at a time, so that surfels stay square.
        const int nu = static_cast<int>(std::ceil(u.norm())), nv = static_cast<int>(std::ceil(v.norm()));
        for (int i = 0; i < nu; ++i)
          for (int j = 0; j < nv; ++j) {
            const Vector3d a = corner + u * i / nu + v * j / nv;
            triangles_.push_back({a, u / nu, u / nu + v / nv});
            triangles_.push_back({a, u / nu + v / nv, v / nv});
          }
      }
  }

  SeaBed bed_;
  std::vector<Triangle> triangles_;
  std::vector<Ball> balls_;
};

}  // namespace insonify
