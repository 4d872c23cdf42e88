// SPDX-License-Identifier: BSD-3-Clause
#include "support/scenes.hpp"

#include <cmath>
#include <numeric>
#include <random>

#include <gtest/gtest.h>

#include "core/units.hpp"
#include "scene/built_in_scenes.hpp"

namespace insonify {

void add_sphere(SceneCloud& scene, const Eigen::Vector3d& centre, double radius, int count, double side) {
  for (int k = 0; k < count; ++k) {
    const double z = 1 - (2 * k + 1.0) / count, turn = k * pi * (3 - std::sqrt(5.0)), s = std::sqrt(1 - z * z);
    const Eigen::Vector3d d(s * std::cos(turn), s * std::sin(turn), z);
    add_surfel(scene, centre + radius * d, side * d, 4 * pi * radius * radius / count);
  }
}

void add_rectangle(SceneCloud& scene, const Eigen::Vector3d& corner, const Eigen::Vector3d& u, const Eigen::Vector3d& v,
                   const Eigen::Vector3d& normal, double spacing, double jitter) {
  std::mt19937 random(static_cast<unsigned>(scene.size()) + 7);
  std::uniform_real_distribution<double> shift(-jitter, jitter);
  const double nu = std::round(u.norm() / spacing), nv = std::round(v.norm() / spacing);
  for (double i = 0; i < nu; ++i)
    for (double j = 0; j < nv; ++j) {
      const double a = (i + 0.5 + shift(random)) / nu, b = (j + 0.5 + shift(random)) / nv;
      add_surfel(scene, corner + a * u + b * v, normal, u.norm() * v.norm() / (nu * nv));
    }
}

void add_floor(SceneCloud& scene, const Eigen::Vector3d& corner, int side, double spacing) {
  const double size = side * spacing;
  add_rectangle(scene, corner, {size, 0, 0}, {0, size, 0}, {0, 0, 1}, spacing);
}

SceneCloud plate(double x, double size, int n, const Eigen::Vector3d& normal) {
  SceneCloud scene;
  add_rectangle(scene, {x, -size / 2, -size / 2}, {0, size, 0}, {0, 0, size}, normal, size / n);
  return scene;
}

SceneCloud harbour(std::size_t points) { return make_built_in_scene("harbour", {.points = points}); }

double total_area(const SceneCloud& scene) { return std::accumulate(scene.area.begin(), scene.area.end(), 0.0); }

Eigen::Vector3d world(const SceneCloud& scene, std::size_t i) { return scene.origin + scene.point[i].cast<double>(); }

void expect_same_attributes(const SceneCloud& a, const SceneCloud& b) {
  const auto fields = [](const auto& x) {
    return std::tie(x.origin, x.normal, x.area, x.material, x.id, x.normals_oriented, x.materials);
  };
  EXPECT_EQ(fields(a), fields(b));
}

void expect_same_surfels(const SceneCloud& a, const SceneCloud& b) {
  EXPECT_EQ(a.point, b.point);
  expect_same_attributes(a, b);
}

}  // namespace insonify
