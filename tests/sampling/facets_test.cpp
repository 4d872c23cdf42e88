// SPDX-License-Identifier: BSD-3-Clause
// Tests surfels that stand for triangles: what they hide, and what rays meet.
#include <random>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "core/units.hpp"
#include "sampling/find_scatterers.hpp"
#include "sampling/mesh_surfels.hpp"
#include "sampling/seen_surfels.hpp"
#include "sampling_scenes.hpp"
#include "support/errors.hpp"

using namespace insonify;

namespace {

void add_triangle(SceneMesh& mesh, const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  const auto first = static_cast<std::uint32_t>(mesh.point.size());
  for (const Eigen::Vector3d& corner : {a, b, c}) {
    mesh.point.push_back(corner.cast<float>());
    mesh.material.push_back(0);
  }
  mesh.triangle.push_back({first, first + 1, first + 2});
}
// Adds a rectangle across x, seen from the head at the origin.
void add_plate(SceneMesh& mesh, double x, double y0, double y1, double z0, double z1) {
  add_triangle(mesh, {x, y0, z0}, {x, y0, z1}, {x, y1, z1});
  add_triangle(mesh, {x, y0, z0}, {x, y1, z1}, {x, y1, z0});
}

// Returns 0 for surfels whose line of sight passes through a triangle, otherwise 1.
std::vector<std::uint8_t> seen_by_definition(const SceneCloud& scene, const SceneMesh& mesh) {
  std::vector<std::uint8_t> seen(scene.size(), 1);
  for (std::size_t i = 0; i < scene.size(); ++i)
    for (std::size_t t = 0; t < mesh.triangle.size(); ++t) {
      const auto [a, b, c] = corners_of(mesh, t);
      const Eigen::Vector3d p = scene.point[i].cast<double>(), n = (b - a).cross(c - a);
      const double along = n.dot(a) / n.dot(p);
      if (!(along > 0 && along < 1 - 1e-4)) continue;
      const Eigen::Vector3d q = along * p;
      const double ab = (b - a).cross(q - a).dot(n), bc = (c - b).cross(q - b).dot(n), ca = (a - c).cross(q - c).dot(n);
      if (ab >= 0 && bc >= 0 && ca >= 0) seen[i] = 0;
    }
  return seen;
}

// Returns random plates of all sizes before a wall; an overhang; two sheets 2 cm apart.
SceneMesh plates() {
  SceneMesh mesh;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit;
  add_plate(mesh, 8, -4, 4, -3, 3);
  add_plate(mesh, 7.98, -1, 1, -1, 1);
  for (int i = 0; i < 120; ++i) {
    const double x = 2 + 5 * unit(random), y = x * (unit(random) - 0.5), z = 0.6 * x * (unit(random) - 0.5);
    const double size = x * 0.2 * std::pow(unit(random), 3) + 0.01;
    Eigen::Vector3d tilt(0.5 * unit(random), 0, 0);
    add_triangle(mesh, {x, y, z}, Eigen::Vector3d(x, y, z + size) + tilt, {x, y + size, z});
  }
  return mesh;
}

}  // namespace

// The back of a plate returns no echo, and rays do not reach the wall behind it.
TEST(Facets, that_turn_their_backs_block_rays) {
  SceneMesh mesh;
  add_plate(mesh, 4, 1, -1, -1, 1);
  add_plate(mesh, 6, -4, 4, -3, 3);
  mesh.normals_oriented = true;
  const SceneCloud scene = even_surfels(mesh, 0.1).scene;
  ASSERT_TRUE(scene.normals_oriented);
  const BeamFan fan = make_fan(32, radians(50), radians(2), radians(40));
  SamplingOptions options;
  options.kind = SamplingKind::rays;
  const Scatterers met = find_scatterers(scene, Pose::Identity(), fan, {0.5, 12, 0.05}, options).scatterers;
  EXPECT_GT(met.size(), 300U);
  for (std::size_t i = 0; i < met.size(); ++i) {
    const Eigen::Vector3d p = met.range[i] * unit_vector({met.azimuth[i], met.elevation[i]});
    EXPECT_NEAR(p.x(), 6, 1e-3);
    EXPECT_GT(std::max(std::abs(p.y()), std::abs(p.z())), 1.5 - 1e-3) << p.transpose();
  }
}

TEST(Facets, hide_exactly_what_is_behind_them) {
  const SceneMesh mesh = plates();
  const SceneCloud scene = even_surfels(mesh, 0.045).scene;
  ASSERT_EQ(scene.facet.size(), scene.size());
  const auto wanted = seen_by_definition(scene, mesh);
  std::vector<std::vector<Visibility>> found;
  for (const Projection by : {Projection::raster, Projection::kdtree, Projection::brute_force}) {
    SamplingOptions options = unsplit();
    options.projection = by;
    found.push_back(find_visibility(scene, Pose::Identity(), wide_fan(), long_gate(),
                                    std::vector<std::uint8_t>(scene.size(), 1), options));
  }
  EXPECT_EQ(found[1], found[0]);
  EXPECT_EQ(found[2], found[0]);
  std::size_t queried = 0, hidden = 0, wrong = 0;
  for (std::size_t i = 0; i < scene.size(); ++i) {
    if (found[0][i] != Visibility::seen && found[0][i] != Visibility::hidden) continue;
    ++queried;
    hidden += !wanted[i];
    wrong += (found[0][i] == Visibility::seen) != (wanted[i] == 1);
  }
  EXPECT_GT(hidden, queried / 10);
  EXPECT_LE(wrong, queried / 5000);  // on edges
}

TEST(Facets, are_met_by_rays_in_their_planes_and_at_no_other_place) {
  SceneMesh mesh;
  add_plate(mesh, 5, -4, 4, -4, 4);
  add_plate(mesh, 3, -0.5, 0.5, -0.5, 0.5);
  const SceneCloud scene = even_surfels(mesh, 0.2).scene;
  for (const Projection by : {Projection::raster, Projection::kdtree, Projection::brute_force}) {
    SamplingOptions options{.kind = SamplingKind::rays, .rays_per_beam = 256};
    options.projection = by;
    const Sampling sampling = find_scatterers(scene, Pose::Identity(),
                                              make_fan(8, radians(30), radians(2), radians(10)), long_gate(), options);
    EXPECT_EQ(sampling.report.rays_missed, 0u);
    const Scatterers& s = sampling.scatterers;
    ASSERT_EQ(s.size(), 8u * 256);
    for (std::size_t i = 0; i < s.size(); ++i) {
      const Eigen::Vector3d at = s.range[i] * unit_vector({s.azimuth[i], s.elevation[i]});
      const Eigen::Vector3d on_near = at * (3 / at.x());
      const double edge = std::max(std::abs(on_near.y()), std::abs(on_near.z()));
      if (std::abs(edge - 0.5) < 1e-5) continue;
      ASSERT_NEAR(at.x(), edge < 0.5 ? 3 : 5, 1e-5);
    }
  }
}

TEST(Facets, go_with_their_surfels) {
  SceneCloud scene = even_surfels(plates(), 0.1).scene;
  const SceneCloud part = subset(scene, {5, 2});
  EXPECT_EQ(part.facet, (std::vector<Facet>{scene.facet[5], scene.facet[2]}));
  add_surfel(scene, {1, 0, 0}, {-1, 0, 0}, 0.01);
  EXPECT_EQ(scene.facet.size(), scene.size());
  scene.facet.pop_back();
  EXPECT_THAT(error_of([&] { require_valid(scene, "test"); }), testing::HasSubstr("scene.facet has"));
}

TEST(EvenSurfels, cover_each_triangle_with_parts_of_one_size_and_its_area) {
  const SceneMesh mesh = plates();
  const SceneCloud scene = even_surfels(mesh, 0.05).scene;
  double whole = 0, sum = 0;
  for (std::size_t t = 0; t < mesh.triangle.size(); ++t) whole += area_of(corners_of(mesh, t));
  for (const float area : scene.area) {
    sum += area;
    ASSERT_LE(area, 1.4 * 0.05 * 0.05);
  }
  EXPECT_NEAR(sum / whole, 1, 1e-5);
  EXPECT_EQ(even_surfels(mesh, 0.05, 1, 1).scene.point, scene.point);
  EXPECT_THAT(error_of([&] { even_surfels(mesh, 0); }), testing::HasSubstr("spacing = 0"));
}

TEST(EvenSurfels, that_are_too_many_are_refused_before_they_are_made) {
  EXPECT_EQ(count_even_surfels(2, 0.1, {}), 200U);
  EXPECT_EQ(count_even_surfels(1e-9, 0.1, {}), 1U);
  for (const double spacing : {1e-5, 1e-9, 1e-200})
    expect_error(ErrorKind::content, {"a.obj: surfels", "at most 400000000", "give a wider spacing"},
                 [&] { count_even_surfels(1, spacing, {"a.obj"}); });
  expect_error(ErrorKind::content, {"even_surfels: surfels 1e-09 m apart"}, [] { even_surfels(plates(), 1e-9); });
  EXPECT_EQ(count_even_surfels(1e4, 0.01, {"a.obj", 100.0 * (1 << 30)}), 100000000U);
  expect_error(ErrorKind::memory, {"a.obj: 100000000 surfels 0.01 m apart need about", "GiB of memory, 2 GiB may"}, [] {
    count_even_surfels(1e4, 0.01, {"a.obj", 2.0 * (1 << 30)});
  });
}
