// SPDX-License-Identifier: BSD-3-Clause
// Visibility of surfels on scenes whose shadows are known in closed form.
#include <algorithm>
#include <random>

#include <gtest/gtest.h>

#include "sampling/hit_rule_internal.hpp"
#include "sampling_scenes.hpp"

using namespace insonify;
using Eigen::Vector3d;

namespace {

std::vector<bool> seen(const SceneCloud& scene, const Pose& pose, const BeamFan& fan = wide_fan(),
                       SamplingOptions options = unsplit()) {
  std::vector<bool> visible(scene.size(), false);
  for (const std::uint32_t s : find_scatterers(scene, pose, fan, long_gate(), options).scatterers.surfel)
    visible[s] = true;
  return visible;
}

}  // namespace

TEST(Visibility, a_plane_at_grazing_incidence_does_not_hide_itself) {
  SceneCloud scene;
  add_rectangle(scene, {1, -5, 0}, {30, 0, 0}, {0, 10, 0}, {0, 0, 1}, 0.1, 0.5);
  for (const double height : {2.0, 0.3, 0.05}) {
    const SamplingReport report = find_scatterers(scene, at(0, 0, height), wide_fan(), long_gate(), unsplit()).report;
    EXPECT_GT(report.in_gate, 10000u);
    EXPECT_EQ(report.visible, report.in_gate) << height;
  }
}

TEST(Visibility, a_rough_plane_hides_little_of_its_own_area) {
  SceneCloud scene;
  add_rectangle(scene, {1, -5, 0}, {20, 0, 0}, {0, 10, 0}, {0, 0, 1}, 0.1, 0.4);
  std::mt19937 random(3);
  std::normal_distribution<float> noise(0, 0.01f);  // a tenth of the spacing
  for (auto& p : scene.point) p.z() += noise(random);
  const SamplingReport report = find_scatterers(scene, at(0, 0, 2), wide_fan(), long_gate(), unsplit()).report;
  EXPECT_GT(static_cast<double>(report.visible), 0.999 * static_cast<double>(report.in_gate));
}

TEST(Visibility, through_a_hole_in_a_wall_is_limited_by_its_outline) {
  constexpr double spacing = 0.05, near = 4, far = 8, hole = 0.5;
  SceneCloud scene;
  add_wall(scene, near, 3, 2, spacing, 0.4);
  std::vector<std::uint32_t> keep;
  for (std::uint32_t i = 0; i < scene.size(); ++i)
    if (std::max(std::abs(scene.point[i].y()), std::abs(scene.point[i].z())) > hole) keep.push_back(i);
  scene = subset(scene, keep);
  const std::size_t front = scene.size();
  add_wall(scene, far, 5.5, 3.5, spacing, 0.4);
  const auto visible = seen(scene, at(0, 0, 0));
  for (std::size_t i = 0; i < front; ++i) ASSERT_TRUE(visible[i]);
  for (std::size_t i = front; i < scene.size(); ++i) {
    // Distance from the edge of the hole at which the line of sight to this surfel crosses the near wall.
    const double inside = hole - std::max(std::abs(scene.point[i].y()), std::abs(scene.point[i].z())) * near / far;
    if (inside > 1.5 * spacing) {
      ASSERT_TRUE(visible[i]) << scene.point[i].transpose();
    }
    if (inside < -1.5 * spacing) {
      ASSERT_FALSE(visible[i]) << scene.point[i].transpose();
    }
  }
}

TEST(Visibility, a_pole_before_a_wall_casts_a_shadow_of_its_own_width) {
  constexpr double spacing = 0.03, radius = 0.1, pole_x = 4, wall_x = 7;
  SceneCloud scene;
  for (int ring = 0; ring < 100; ++ring)
    for (int k = 0; k < 21; ++k) {
      const double turn = 2 * pi * (k + 0.5 * (ring % 2)) / 21;
      const Vector3d d(std::cos(turn), std::sin(turn), 0);
      add_surfel(scene, Vector3d(pole_x, 0, -1.5 + spacing * ring) + radius * d, d, 2 * pi * radius / 21 * spacing);
    }
  const std::size_t pole = scene.size();
  add_wall(scene, wall_x, 1, 1, spacing, 0.4);
  const auto visible = seen(scene, at(0, 0, 0));
  // The line of sight to (7, y) passes the axis at distance 4 |y| / hypot(7, y).
  for (std::size_t i = pole; i < scene.size(); ++i) {
    const double y = scene.point[i].y(), distance = pole_x * std::abs(y) / std::hypot(wall_x, y);
    if (distance < radius) {
      ASSERT_FALSE(visible[i]) << y;
    }
    if (distance > radius + 1.5 * spacing) {
      ASSERT_TRUE(visible[i]) << y;
    }
  }
  for (std::size_t i = 0; i < pole; ++i) {
    // The limb of a pole only 7 spacings thick is nearly edge-on and may hide itself.
    const float cosine = -scene.normal[i].dot(scene.point[i].normalized());
    ASSERT_TRUE(visible[i] || cosine < 0.1f) << scene.point[i].transpose();
    ASSERT_TRUE(!visible[i] || cosine > 0) << scene.point[i].transpose();
  }
}

TEST(Visibility, a_sphere_over_a_plane_casts_its_geometric_shadow) {
  constexpr double spacing = 0.05, radius = 0.6;
  const Vector3d head(0, 0, 2), centre(5, 0, 1);
  SceneCloud scene;
  add_sphere(scene, centre, radius, static_cast<int>(4 * pi * radius * radius / (spacing * spacing)));
  const std::size_t sphere = scene.size();
  add_rectangle(scene, {5, -4, 0}, {14, 0, 0}, {0, 8, 0}, {0, 0, 1}, spacing, 0.4);
  const auto visible = seen(scene, at(head.x(), head.y(), head.z()));
  for (std::size_t i = sphere; i < scene.size(); ++i) {
    const Vector3d way = scene.point[i].cast<double>() - head;
    const double along = way.normalized().dot(centre - head);
    const double distance = (centre - head - along * way.normalized()).norm();
    if (way.norm() < along) continue;
    if (distance < radius - 2 * spacing) {
      ASSERT_FALSE(visible[i]) << scene.point[i].transpose();
    }
    if (distance > radius + 2 * spacing) {
      ASSERT_TRUE(visible[i]) << scene.point[i].transpose();
    }
  }
  for (std::size_t i = 0; i < sphere; ++i)
    if (scene.normal[i].cast<double>().dot(head - scene.point[i].cast<double>()) < 0) {
      ASSERT_FALSE(visible[i]);
    }
}

TEST(Visibility, a_sparse_wall_does_not_leak) {
  for (const double jitter : {0.0, 0.5}) {
    SceneCloud scene;
    add_wall(scene, 4, 4, 3, 0.2, jitter);
    const std::size_t front = scene.size();
    add_wall(scene, 6, 4, 3, 0.02);  // a far finer one behind it
    const auto visible = seen(scene, at(0, 0, 0));
    EXPECT_EQ(std::count(visible.begin() + static_cast<std::ptrdiff_t>(front), visible.end(), true), 0) << jitter;
    const auto beside = seen(scene, at(0, 2, 0, -40));
    EXPECT_EQ(std::count(beside.begin() + static_cast<std::ptrdiff_t>(front), beside.end(), true), 0) << jitter;
  }
}

TEST(Visibility, a_closed_body_shows_neither_its_inside_nor_what_is_outside) {
  SceneCloud scene;
  add_sphere(scene, {0, 0, 0}, 1, 2000);
  const std::size_t body = scene.size();
  add_wall(scene, 5, 3, 3, 0.1);
  const SamplingReport report = find_scatterers(scene, at(0.2, 0, 0), wide_fan(), long_gate(), unsplit()).report;
  EXPECT_EQ(report.visible, 0u);
  EXPECT_GT(report.back_facing, 100u);
  EXPECT_GT(report.hidden, 100u);
  scene.normals_oriented = false;  // now the inside reflects
  const auto inside = seen(scene, at(0.2, 0, 0));
  EXPECT_GT(std::count(inside.begin(), inside.begin() + static_cast<std::ptrdiff_t>(body), true), 100);
  EXPECT_EQ(std::count(inside.begin() + static_cast<std::ptrdiff_t>(body), inside.end(), true), 0);
}

TEST(Visibility, flipped_normals_of_an_unoriented_cloud_change_nothing) {
  SceneCloud scene;
  add_sphere(scene, {5, 0, 0}, 1, 3000);
  add_wall(scene, 8, 3, 3, 0.1);
  scene.normals_oriented = false;
  const auto straight = seen(scene, at(0, 0, 0));
  for (std::size_t i = 0; i < scene.size(); i += 3) scene.normal[i] *= -1;
  EXPECT_EQ(seen(scene, at(0, 0, 0)), straight);
}

// Before a surfel at x = 6 m stand others in the plane x = 3 m, which its line of sight crosses at y = 0.
TEST(Visibility, takes_cover_from_more_than_one_side) {
  const auto surfel = [](float x, float y, float z = 0, float noise = 0) {
    const Eigen::Vector3f position(x, y, z);
    return GatedSurfel{position, position.norm(), {1, 0, 0}, x, 0.12f, 0.065f, 0.1f, 0.1f, noise, 0, true, true};
  };
  const GatedSurfel far = surfel(6, 0);
  const LineOfSight line(far);
  EXPECT_EQ(cover(surfel(3, 0.06f), line), whole_cover);
  EXPECT_EQ(std::popcount(cover(surfel(3, 0.07f), line)), 1);
  EXPECT_EQ(std::popcount(cover(surfel(3, 0.175f), line)), 1);
  EXPECT_EQ(cover(surfel(3, 0.185f), line), 0u);
  EXPECT_EQ(cover(surfel(5.95f, 0), line), 0u);       // no deeper than a spacing
  EXPECT_EQ(cover(surfel(7, 0), line), 0u);           // farther away
  EXPECT_EQ(cover(surfel(5, 0, 0, 0.4f), line), 0u);  // within three standard deviations
  EXPECT_EQ(cover(surfel(5, 0, 0, 0.2f), line), whole_cover);

  const auto from = [&](double angle) {
    return cover(surfel(3, 0.1f * static_cast<float>(std::cos(angle)), 0.1f * static_cast<float>(std::sin(angle))),
                 line);
  };
  for (double a = 0; a < 6; a += 0.5) {
    EXPECT_FALSE(hides(from(a)));
    EXPECT_FALSE(hides(from(a) | from(a + radians(50)) | from(a + radians(100)))) << a;
    EXPECT_TRUE(hides(from(a) | from(a + radians(135)))) << a;
    EXPECT_TRUE(hides(from(a) | from(a + pi))) << a;
  }
  EXPECT_FALSE(hides(0));
  EXPECT_TRUE(hides(whole_cover));
}

TEST(Visibility, of_surfels_seen_edge_on_gives_no_echo_and_no_division_by_zero) {
  SceneCloud scene;
  add_rectangle(scene, {2, 0, -1}, {3, 0, 0}, {0, 0, 2}, {0, 1, 0}, 0.1);  // in the plane y = 0 of the head
  add_surfel(scene, {0, 0, 0}, {0, 0, 1}, 0.01);                           // at the head itself
  add_surfel(scene, {1e-9, 0, 0}, {1, 0, 0}, 0.01);
  for (const bool oriented : {true, false}) {
    scene.normals_oriented = oriented;
    EXPECT_EQ(find_scatterers(scene, at(0, 0, 0), wide_fan(), long_gate(), unsplit()).report.visible, 0u);
  }
}

TEST(Visibility, surfels_nearer_than_the_gate_cast_shadows) {
  SceneCloud scene;
  add_wall(scene, 0.5, 1, 1, 0.05);
  add_wall(scene, 5, 2, 2, 0.05);
  const RangeGate gate{2, 10, 0.05};
  EXPECT_EQ(find_scatterers(scene, at(0, 0, 0), wide_fan(), gate, unsplit()).report.visible, 0u);
}

TEST(Visibility, without_occlusion_shows_everything_that_faces_the_head) {
  SceneCloud scene;
  add_wall(scene, 4, 1, 1, 0.1);
  add_wall(scene, 6, 1, 1, 0.1);
  SamplingOptions options = unsplit();
  EXPECT_EQ(find_scatterers(scene, at(0, 0, 0), wide_fan(), long_gate(), options).report.visible, 400u);
  options.occlusion = false;
  EXPECT_EQ(find_scatterers(scene, at(0, 0, 0), wide_fan(), long_gate(), options).report.visible, 800u);
}

// 60 bodies that reach through one another: of the methods each drops other tests on its way.
TEST(Visibility, of_a_heap_of_bodies_is_the_same_by_all_methods) {
  SceneCloud scene;
  std::mt19937 random(11);
  std::uniform_real_distribution<double> any(-0.6, 0.6);
  for (int k = 0; k < 60; ++k)
    add_sphere(scene, {5 + any(random), any(random), any(random)}, 0.2 + 0.3 * std::abs(any(random)), 150);
  add_wall(scene, 9, 2, 2, 0.1);
  SamplingOptions options = unsplit();
  options.projection = Projection::brute_force;
  const auto expected = seen(scene, at(0, 0, 0), wide_fan(), options);
  EXPECT_GT(std::count(expected.begin(), expected.end(), true), 500);
  EXPECT_LT(std::count(expected.begin(), expected.end(), true), 6000);
  for (const Projection projection : {Projection::raster, Projection::kdtree}) {
    options.projection = projection;
    EXPECT_EQ(seen(scene, at(0, 0, 0), wide_fan(), options), expected);
  }
}

// 50 times the same two bodies, of which one stands in the shadow of the other: each copy is seen as the first one is.
TEST(Visibility, of_copies_in_one_place_is_that_of_one) {
  SceneCloud one, many;
  for (int k = -1; k < 50; ++k) {
    add_sphere(k < 0 ? one : many, {4, 0.1, 0}, 0.4, 200);
    add_sphere(k < 0 ? one : many, {6, 0, 0.2}, 0.9, 400);
  }
  for (const Projection projection : {Projection::raster, Projection::kdtree, Projection::brute_force}) {
    SamplingOptions options = unsplit();
    options.projection = projection;
    const auto expected = seen(one, at(0, 0, 0), wide_fan(), options);
    const auto of_many = seen(many, at(0, 0, 0), wide_fan(), options);
    EXPECT_GT(std::count(expected.begin(), expected.end(), true), 100);
    for (std::size_t i = 0; i < many.size(); ++i) ASSERT_EQ(of_many[i], expected[i % one.size()]) << i;
  }
}
