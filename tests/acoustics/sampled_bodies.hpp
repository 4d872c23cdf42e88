// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cmath>
#include <functional>
#include <random>
#include <vector>

#include <Eigen/Geometry>

#include "core/units.hpp"
#include "scene/estimate/surfel_area.hpp"
#include "scene/scene_cloud.hpp"

// Random scans of bodies: surfaces over the unit square, sampled on a lattice or at random, turned and moved, with
// noise across the surface.
namespace insonify::sampled {

using Eigen::Vector3d;

/// A piece of a surface: its position over u and v within 0 and 1. du x dv looks outwards.
using Patch = std::function<Vector3d(double u, double v)>;

inline Vector3d normal_by_area(const Patch& patch, double u, double v) {
  constexpr double step = 1e-5;
  return (patch(u + step, v) - patch(u - step, v)).cross(patch(u, v + step) - patch(u, v - step)) / (4 * step * step);
}
inline double area_of(const Patch& patch) {
  constexpr int n = 64;
  double sum = 0;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) sum += normal_by_area(patch, (i + 0.5) / n, (j + 0.5) / n).norm();
  return sum / (n * n);
}

inline Patch rectangle(double width, double height) {
  return [=](double u, double v) { return Vector3d(width * (u - 0.5), height * (v - 0.5), 0); };
}
inline Patch disc(double radius, double z) {
  return [=](double u, double v) {
    const double r = radius * std::sqrt(u), turn = (z < 0 ? -2 : 2) * pi * v;
    return Vector3d(r * std::cos(turn), r * std::sin(turn), z);
  };
}
/// Returns a surface of revolution: radius and height over v within 0 and 1, turned by `angle` [rad].
inline Patch revolved(std::function<double(double)> radius, std::function<double(double)> height,
                      double angle = 2 * pi) {
  return [=](double u, double v) {
    return Vector3d(radius(v) * std::cos(angle * u), radius(v) * std::sin(angle * u), height(v));
  };
}
inline std::vector<Patch> cylinder(double radius, double length, double angle = 2 * pi) {
  return {revolved([=](double) { return radius; }, [=](double v) { return length * (v - 0.5); }, angle),
          disc(radius, 0.5 * length), disc(radius, -0.5 * length)};
}
/// Returns a sphere down to `least` of its height, from -1.
inline Patch sphere(double radius, double least = -1) {
  const auto z = [=](double v) { return least + (1 - least) * v; };
  return revolved([=](double v) { return radius * std::sqrt(std::max(0.0, 1 - z(v) * z(v))); },
                  [=](double v) { return radius * z(v); });
}

/// Returns a surface with the `count` flat facets of a mesh over u.
inline Patch faceted(const Patch& patch, int count) {
  return [=](double u, double v) -> Vector3d {
    const double k = std::clamp(std::floor(u * count), 0.0, count - 1.0), part = u * count - k;
    return (1 - part) * patch(k / count, v) + part * patch((k + 1) / count, v);
  };
}

/// Parameters of a scan.
struct Scan {
  int points = 3000;
  double jitter = 0;       ///< jitter on the lattice, in cells to either side; 0.5: at random within their cells
  bool lattice = true;     ///< false: at random
  double noise = 0;        ///< standard deviation across the surface [m]
  double range = 10;       ///< range of its middle from the origin [m]
  bool estimated = false;  ///< true: normals and areas are estimated, as for a file without them
  bool rounded = true;     ///< true: coordinates are float32 of the world; false: of a local origin
};

/// The scan, with the rotation and the position of the body by `seed`.
struct Scanned {
  SceneCloud cloud;
  Eigen::Isometry3d world_from_body;
};

inline Scanned scanned(const std::vector<Patch>& body, const Scan& scan, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform;
  const Eigen::Quaterniond turn =
      Eigen::Quaterniond(normal(random), normal(random), normal(random), normal(random)).normalized();
  Scanned made{
      {},
      Eigen::Translation3d(scan.range * Vector3d(normal(random), normal(random), normal(random)).normalized()) * turn};
  SceneCloud& cloud = made.cloud;
  cloud.materials = {Material{"body"}};
  cloud.materials[0].coherent = 1;
  if (!scan.rounded) cloud.origin = made.world_from_body.translation();
  const auto moved = [&] { return scan.jitter * (2 * uniform(random) - 1); };
  double total = 0;
  for (const Patch& patch : body) total += area_of(patch);
  for (const Patch& patch : body) {
    const double area = area_of(patch), n = scan.points * area / total;
    // Columns and rows of about square cells.
    double wide = 0;
    for (int k = 0; k < 16; ++k) wide += (patch((k + 1) / 16.0, 0.5) - patch(k / 16.0, 0.5)).norm();
    const int columns = std::max(1, static_cast<int>(std::lround(std::sqrt(n * wide * wide / area)))),
              rows = std::max(1, static_cast<int>(std::lround(n / columns)));
    for (int i = 0; i < columns; ++i)
      for (int j = 0; j < rows; ++j) {
        const double u = scan.lattice ? (i + 0.5 + moved()) / columns : uniform(random),
                     v = scan.lattice ? (j + 0.5 + moved()) / rows : uniform(random);
        const Vector3d across = normal_by_area(patch, u, v), n_body = across.normalized();
        const Vector3d position = made.world_from_body * (patch(u, v) + scan.noise * normal(random) * n_body);
        cloud.point.push_back((position - cloud.origin).cast<float>());
        cloud.normal.push_back((made.world_from_body.linear() * n_body).cast<float>());
        cloud.area.push_back(static_cast<float>(across.norm() / (columns * rows)));
        cloud.id.push_back(static_cast<std::uint32_t>(cloud.id.size()));
        cloud.material.push_back(0);
      }
  }
  if (scan.estimated) {
    SurfelShapes shapes = estimate_surfel_shapes(cloud.point, cloud.normal);
    cloud.area = shapes.area, cloud.normal = shapes.normal;
  }
  return made;
}

}  // namespace insonify::sampled
