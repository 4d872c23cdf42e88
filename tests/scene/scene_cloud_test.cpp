// SPDX-License-Identifier: BSD-3-Clause
#include "scene/scene_cloud.hpp"

#include "support/test.hpp"

using Eigen::Vector3d;

namespace {

SceneCloud two_surfels() {
  SceneCloud scene;
  scene.origin = {1e6, 2e6, -10};
  add_surfel(scene, {1e6 + 1.25, 2e6, -10}, {0, 0, 1}, 0.5);
  add_surfel(scene, {1e6, 2e6 - 3.5, -8}, {1, 0, 0}, 0.25);
  return scene;
}

}  // namespace

TEST(SceneCloud, stores_positions_relative_to_its_origin) {
  const SceneCloud scene = two_surfels();
  EXPECT_EQ(scene.point[0], Eigen::Vector3f(1.25f, 0, 0));
  EXPECT_EQ(scene.point[1], Eigen::Vector3f(0, -3.5f, 2));
  EXPECT_EQ(scene.id, (std::vector<std::uint32_t>{0, 1}));
  EXPECT_EQ(bounds(scene).min, Vector3d(1e6, 2e6 - 3.5, -10));
  EXPECT_EQ(bounds(scene).max, Vector3d(1e6 + 1.25, 2e6, -8));
}

TEST(SceneCloud, without_points_has_inverted_bounds) {
  const Bounds box = bounds(SceneCloud{});
  EXPECT_GT(box.min.x(), box.max.x());
}

TEST(SceneCloud, subset_keeps_order_ids_and_materials) {
  SceneCloud scene = two_surfels();
  scene.normals_oriented = false;
  const SceneCloud part = subset(scene, {1});
  ASSERT_EQ(part.size(), 1u);
  EXPECT_EQ(part.id[0], 1u);
  EXPECT_EQ(part.origin, scene.origin);
  EXPECT_FALSE(part.normals_oriented);
  EXPECT_FLOAT_EQ(part.area[0], 0.25f);
  EXPECT_THAT(error_of([&] { subset(scene, {2}); }), HasSubstr("keep holds 2"));
}

TEST(SceneCloud, refuses_an_unknown_material) {
  SceneCloud scene;
  EXPECT_THAT(error_of([&] { add_surfel(scene, {0, 0, 0}, {0, 0, 1}, 1, 3); }), HasSubstr("material = 3"));
}

TEST(RequireValid, names_what_is_wrong) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const auto message = [](const std::function<void(SceneCloud&)>& damage) {
    SceneCloud scene = two_surfels();
    damage(scene);
    return error_with_kind([&] { require_valid(scene, "someone"); });
  };
  EXPECT_EQ(message([](SceneCloud&) {}), "no error");
  EXPECT_THAT(message([](SceneCloud& s) { s.area.pop_back(); }),
              HasSubstr("argument: someone: scene.area has 1 entries"));
  EXPECT_THAT(message([](SceneCloud& s) { s.id.push_back(9); }), HasSubstr("scene.id has 3 entries"));
  EXPECT_THAT(message([&](SceneCloud& s) { s.point[1].y() = nan; }), HasSubstr("content: someone: scene.point[1]"));
  EXPECT_THAT(message([](SceneCloud& s) { s.point[0].y() = -std::numeric_limits<float>::infinity(); }),
              HasSubstr("scene.point[0]"));
  EXPECT_THAT(message([](SceneCloud& s) { s.normal[0].setZero(); }), HasSubstr("scene.normal[0] = (0, 0, 0)"));
  EXPECT_THAT(message([](SceneCloud& s) { s.normal[0] *= 1.01f; }), HasSubstr("unit vector"));
  EXPECT_THAT(message([&](SceneCloud& s) { s.normal[1].x() = nan; }), HasSubstr("scene.normal[1]"));
  EXPECT_THAT(message([](SceneCloud& s) { s.area[1] = -1; }), HasSubstr("scene.area[1] = -1 m^2"));
  EXPECT_THAT(message([&](SceneCloud& s) { s.area[0] = nan; }), HasSubstr("scene.area[0] = nan m^2"));
  EXPECT_THAT(message([](SceneCloud& s) { s.material[1] = 1; }), HasSubstr("scene.material[1] = 1"));
  EXPECT_THAT(message([](SceneCloud& s) { s.materials[0].lambert_mu = -0.1; }), HasSubstr("lambert_mu"));
}
