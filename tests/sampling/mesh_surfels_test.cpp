// SPDX-License-Identifier: BSD-3-Clause
// Tests the surfels that a ping takes from a mesh (E70): areas, positions, ids and spacing.
#include "sampling/mesh_surfels.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

#include <gtest/gtest.h>

#include "core/units.hpp"
#include "support/errors.hpp"
#include "support/scenes.hpp"

using namespace insonify;

namespace {

/// Returns a level square of two triangles, `side` long, normals up, and a sliver 8 m x 1 mm 1 m above its middle.
SceneMesh square(double side, bool sliver = false) {
  const auto half = static_cast<float>(side / 2);
  SceneMesh mesh;
  mesh.point = {{-half, -half, 0}, {half, -half, 0}, {half, half, 0}, {-half, half, 0},
                {-4, 0, 1},        {4, 0, 1},        {-4, 0.001F, 1}};
  mesh.triangle = {{0, 1, 2}, {0, 2, 3}};
  if (sliver) mesh.triangle.push_back({4, 5, 6});
  mesh.material = {0, 0, 0, 0, 1, 1, 1};
  mesh.materials = {Material{}, Material{}};
  mesh.whole = {200000, 0.5, 0};
  return mesh;
}

/// A head with 20 degrees each way, looking down from `height` metres above (x, 0).
struct Look {
  BeamFan fan = make_fan(40, radians(40), radians(1), radians(20));
  InsonifiedRegion region;
  SamplingOptions options;

  explicit Look(double x = 0, double height = 10) {
    region.world_from_head = pose_from_yaw_pitch_roll({x, 0, height}, 0, radians(90), 0);
    region.sector = insonified_sector(fan, options);
    region.gate = {1, 40, 0.02};
  }
  MeshSurfels surfels(const SceneMesh& mesh, std::size_t most = default_mesh_surfels) const {
    return mesh_surfels(mesh, region, fan, options, most);
  }
};

/// Returns position and area by id.
std::map<std::uint32_t, std::pair<Eigen::Vector3d, float>> by_id(const SceneCloud& scene) {
  std::map<std::uint32_t, std::pair<Eigen::Vector3d, float>> all;
  for (std::size_t i = 0; i < scene.size(); ++i) all[scene.id[i]] = {world(scene, i), scene.area[i]};
  return all;
}

}  // namespace

TEST(MeshSurfels, have_the_area_of_their_triangles) {
  SceneMesh mesh = square(6, true);
  Look look;
  look.region = region_around({0, 0, 10}, 30);  // all of it
  look.region.gate.bin_size = 0.02;
  const SceneCloud scene = look.surfels(mesh).scene;
  EXPECT_GT(scene.size(), 1000U);
  double floor = 0, sliver = 0;
  for (std::size_t i = 0; i < scene.size(); ++i) {
    (scene.material[i] == 0 ? floor : sliver) += static_cast<double>(scene.area[i]);
    EXPECT_LE(world(scene, i).head<2>().lpNorm<Eigen::Infinity>(), 4);
    EXPECT_NEAR(world(scene, i).z(), scene.material[i], 1e-6);
    EXPECT_NEAR(scene.normal[i].z(), 1, 1e-6);
  }
  EXPECT_NEAR(floor, 36, 36e-6);
  EXPECT_NEAR(sliver, 0.004, 4e-9);
  EXPECT_GT(std::count(scene.material.begin(), scene.material.end(), 1), 30);  // none is longer than 25 cm
  EXPECT_EQ(whole_of(scene).surfels, mesh.whole.surfels);
}

TEST(MeshSurfels, are_no_larger_than_half_a_lobe_and_a_cell) {
  const SceneMesh mesh = square(400);
  for (const double height : {4.0, 20.0}) {
    Look look(30, height);
    look.fan = make_fan(60, radians(120), radians(1), radians(2));
    look.region.sector = insonified_sector(look.fan, look.options);
    const SceneCloud scene = look.surfels(mesh).scene;
    ASSERT_GT(scene.size(), 300U);
    EXPECT_LT(scene.size(), 200000U);
    for (std::size_t i = 0; i < scene.size(); ++i) {
      const double range = (world(scene, i) - look.region.world_from_head.translation()).norm();
      ASSERT_LE(scene.area[i], std::pow(1.01 * range * radians(0.5), 2));
    }
  }
}

// One beam of 1 degree: beside its lobe surfels are a quarter as wide as they are off it (E17).
TEST(MeshSurfels, grow_with_the_distance_from_the_nearest_main_lobe) {
  const SceneMesh mesh = square(60);
  Look look(0, 8);
  look.fan = make_fan(1, 0, radians(1), radians(60));
  look.options.azimuth_margin = pi;
  look.region.sector = insonified_sector(look.fan, look.options);
  const SceneCloud scene = look.surfels(mesh).scene;
  double total = 0;
  for (std::size_t i = 0; i < scene.size(); ++i) {
    const Eigen::Vector3d p = look.region.world_from_head.inverse() * world(scene, i);
    const double off = std::max(0.0, std::abs(p.y()) / p.norm() - radians(1.5));
    ASSERT_LE(scene.area[i], std::pow(1.05 * p.norm() * std::max(radians(0.5), off / 4), 2));
    total += static_cast<double>(scene.area[i]);
  }
  look.options.lobe_margin = 2;
  const SceneCloud even = look.surfels(mesh).scene;
  EXPECT_LT(4 * scene.size(), even.size());
  double even_total = 0;
  for (const float area : even.area) even_total += static_cast<double>(area);
  EXPECT_NEAR(total / even_total, 1, 0.05);  // but for the edges of the sector
}

TEST(MeshSurfels, stand_where_they_stand_for_every_head_and_thread_count) {
  const SceneMesh mesh = square(400, true);
  Look here(0), there(1.5);
  here.options.threads = 1;
  const SceneCloud first = here.surfels(mesh).scene, other = there.surfels(mesh).scene;
  here.options.threads = 5;
  expect_same_surfels(first, here.surfels(mesh).scene);
  const auto a = by_id(first), b = by_id(other);
  EXPECT_EQ(a.size(), first.size());  // ids are unique
  std::size_t both = 0;
  for (const auto& [id, surfel] : a)
    if (const auto found = b.find(id); found != b.end()) {
      ++both;
      ASSERT_EQ(found->second.first, surfel.first);
    }
  EXPECT_GT(both, a.size() / 2);
}

// A finer sampling keeps every position of a coarser one, and adds others.
TEST(MeshSurfels, are_nested) {
  const SceneMesh mesh = square(8);
  Look near(0, 6), far(0, 12);
  for (Look* look : {&near, &far}) {
    look->region.sector = {-pi, pi, -pi / 2, pi / 2};
    look->options.seed = 3;
    look->options.lobe_margin = 2;  // else the farther one looks finer at what is off its beams
  }
  const auto fine = by_id(near.surfels(mesh).scene), coarse = by_id(far.surfels(mesh).scene);
  EXPECT_GT(fine.size(), 2 * coarse.size());
  for (const auto& [id, surfel] : coarse) {
    ASSERT_TRUE(fine.count(id));
    ASSERT_EQ(fine.at(id).first, surfel.first);
    ASSERT_LE(fine.at(id).second, surfel.second);
  }
}

TEST(MeshSurfels, move_with_the_world) {
  SceneMesh mesh = square(400);
  Look look;
  const SceneCloud here = look.surfels(mesh).scene;
  mesh.origin = {1e6, -2e6, 300};
  look.region.world_from_head.translation() += mesh.origin;
  const SceneCloud there = look.surfels(mesh).scene;
  EXPECT_EQ(here.point, there.point);
  EXPECT_EQ(here.id, there.id);
  EXPECT_EQ(here.area, there.area);
}

// Uniform: the mean position of many is the middle of the square, and its variance that of a uniform law.
TEST(MeshSurfels, are_uniform_over_a_triangle) {
  Look look;
  look.region = region_around({0, 0, 10}, 30);
  look.region.gate.bin_size = 0.02;
  double sum = 0, square_sum = 0, diagonal = 0, count = 0;
  for (look.options.seed = 1; look.options.seed <= 60; ++look.options.seed) {
    // Far away each triangle has one.
    SceneMesh mesh = square(0.2);
    const SceneCloud scene = look.surfels(mesh).scene;
    for (std::size_t i = 0; i < scene.size(); ++i) {
      const Eigen::Vector3d p = world(scene, i) * 5 + Eigen::Vector3d(0.5, 0.5, 0);
      sum += p.x(), square_sum += p.x() * p.x(), diagonal += p.x() * p.y(), ++count;
    }
  }
  const double error = 3 * std::sqrt(1 / count);
  EXPECT_NEAR(sum / count, 0.5, 0.29 * error);
  EXPECT_NEAR(square_sum / count, 1.0 / 3, 0.3 * error);
  EXPECT_NEAR(diagonal / count, 0.25, 0.22 * error);
}

TEST(MeshSurfels, keep_to_the_number_allowed) {
  const SceneMesh mesh = square(400, true);
  const Look look;
  const MeshSurfels all = look.surfels(mesh);
  EXPECT_EQ(all.coarsening, 1);
  const MeshSurfels some = look.surfels(mesh, all.scene.size() / 3);
  EXPECT_GE(some.coarsening, 4);
  EXPECT_LE(some.scene.size(), all.scene.size() / 3);
  EXPECT_GT(some.scene.size(), all.scene.size() / 20);
  const MeshSurfels none = look.surfels(mesh, 1);
  EXPECT_TRUE(std::isinf(none.coarsening));
  EXPECT_EQ(none.scene.size(), 0U);
  EXPECT_EQ(Look(1000).surfels(mesh, 1).scene.size(), 0U);  // out of reach
}

TEST(MeshSurfels, refuse_what_is_no_mesh) {
  const Look look;
  const auto refusal = [&](const std::function<void(SceneMesh&)>& spoil, ErrorKind kind = ErrorKind::content) {
    SceneMesh mesh = square(4);
    spoil(mesh);
    return error_of([&] { look.surfels(mesh); }, kind);
  };
  EXPECT_NE(refusal([](SceneMesh& m) { m.triangle[1][0] = 9; }).find("mesh.triangle[1] has corner 9"),
            std::string::npos);
  EXPECT_NE(refusal([](SceneMesh& m) { m.triangle[1][0] = 2; }).find("mesh.triangle[1] is flat"), std::string::npos);
  EXPECT_NE(refusal([](SceneMesh& m) { m.point[1].x() = NAN; }).find("mesh.triangle[0] is flat or not finite"),
            std::string::npos);
  EXPECT_NE(refusal([](SceneMesh& m) { m.material[2] = 2; }).find("mesh.material[2] = 2"), std::string::npos);
  EXPECT_NE(refusal([](SceneMesh& m) { m.normal.resize(2); }, ErrorKind::argument).find("mesh.normal has 2 entries"),
            std::string::npos);
  EXPECT_NE(error_of([&] { look.surfels(square(4), 0); }).find("most_surfels = 0"), std::string::npos);
}
