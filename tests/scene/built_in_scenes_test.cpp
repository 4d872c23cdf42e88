// SPDX-License-Identifier: BSD-3-Clause
#include "scene/built_in_scenes.hpp"

#include "support/test.hpp"

using Eigen::Vector3d, Eigen::Vector3f;

namespace {

double area_of(const SceneCloud& scene) { return std::accumulate(scene.area.begin(), scene.area.end(), 0.0); }

std::string message_of(const std::string& name, const BuiltInSceneOptions& options) {
  return error_of([&] { make_built_in_scene(name, options); });
}

}  // namespace

TEST(BuiltInScenes, are_valid_and_have_the_points_asked_for) {
  for (const std::string& name : built_in_scene_names())
    for (const std::size_t points : {1000u, 20000u}) {
      const SceneCloud scene = make_built_in_scene(name, {.points = points});
      EXPECT_NO_THROW(require_valid(scene, name.c_str()));
      EXPECT_NEAR(static_cast<double>(scene.size()), static_cast<double>(points), 0.02 * static_cast<double>(points))
          << name;
      EXPECT_EQ(std::set(scene.id.begin(), scene.id.end()).size(), scene.size()) << name;
    }
}

TEST(BuiltInScenes, have_the_areas_of_their_surfaces) {
  EXPECT_NEAR(area_of(make_built_in_scene("plane", {.points = 3000, .size = {20, 7}})), 140, 140 * 1e-3);
  EXPECT_NEAR(area_of(make_built_in_scene("sphere", {.points = 3000, .radius = 0.3})), 4 * pi * 0.09,
              4 * pi * 0.09 * 1e-3);
  EXPECT_NEAR(area_of(make_built_in_scene("wall", {.points = 3000, .size = {6, 4}})), 23, 23 * 1e-3);
  EXPECT_NEAR(area_of(make_built_in_scene("wall", {.points = 3000, .size = {2, 2}})), 4, 4e-3);
  EXPECT_NEAR(area_of(make_built_in_scene("poles", {.points = 3000})), 24 + 3 * 2 * pi * 0.1 * 4, 0.05);
}

TEST(BuiltInScenes, have_the_documented_extents) {
  const Bounds plane = bounds(make_built_in_scene("plane", {.points = 20000, .size = {40, 40}}));
  EXPECT_NEAR((plane.min - Vector3d(0, -20, 0)).norm(), 0, 0.3);
  EXPECT_NEAR((plane.max - Vector3d(40, 20, 0)).norm(), 0, 0.3);
  for (const Vector3f& p : make_built_in_scene("sphere", {.radius = 0.3}).point)
    ASSERT_NEAR((p - Vector3f(5, 0, 0)).norm(), 0.3, 1e-5);
  for (const Vector3f& p : make_built_in_scene("wall", {.size = {6, 4}}).point) {
    ASSERT_EQ(p.x(), 5);
    ASSERT_FALSE(std::abs(p.y()) < 0.5 && std::abs(p.z()) < 0.5);
  }
}

TEST(BuiltInScenes, have_outward_normals) {
  const SceneCloud sphere = make_built_in_scene("sphere", {.points = 5000, .radius = 0.3});
  for (std::size_t i = 0; i < sphere.size(); ++i)
    ASSERT_GT(sphere.normal[i].dot((sphere.point[i] - Vector3f(5, 0, 0)).normalized()), 0.9999);
  for (const Vector3f& n : make_built_in_scene("plane").normal) ASSERT_EQ(n, Vector3f(0, 0, 1));
  for (const Vector3f& n : make_built_in_scene("wall").normal) ASSERT_LT((n - Vector3f(-1, 0, 0)).norm(), 1e-6);
  const SceneCloud poles = make_built_in_scene("poles", {.points = 5000});
  for (std::size_t i = 0; i < poles.size(); ++i)
    if (poles.point[i].x() < 5) {
      const Vector3f axis(4, std::round(poles.point[i].y()), poles.point[i].z());
      ASSERT_GT(poles.normal[i].dot((poles.point[i] - axis).normalized()), 0.9999);
    }
}

TEST(BuiltInScenes, are_reproducible_and_follow_the_seed) {
  for (const std::string& name : built_in_scene_names()) {
    const SceneCloud a = make_built_in_scene(name, {.points = 3000}), b = make_built_in_scene(name, {.points = 3000});
    EXPECT_EQ(a.point, b.point) << name;
    EXPECT_EQ(a.area, b.area) << name;
    EXPECT_NE(a.point, make_built_in_scene(name, {.points = 3000, .seed = 2}).point) << name;
  }
}

TEST(Harbour, fills_its_box_under_water_and_faces_the_head) {
  const SceneCloud scene = make_built_in_scene("harbour", {.points = 50000});
  const Bounds box = bounds(scene);
  EXPECT_GT(box.min.x(), -1e-3);
  EXPECT_LT(box.max.x(), 60.001);
  EXPECT_NEAR(box.min.y(), -30, 0.5);
  EXPECT_NEAR(box.max.y(), 30, 0.5);
  EXPECT_LT(box.max.z(), 0);
  EXPECT_GT(box.min.z(), -9.5);  // the wreck's keel is below the bed
  std::vector<double> area(scene.materials.size(), 0.0), upward(scene.materials.size(), 0.0);
  for (std::size_t i = 0; i < scene.size(); ++i) {
    area[scene.material[i]] += scene.area[i];
    const std::string& name = scene.materials[scene.material[i]].name;
    ASSERT_TRUE(name != "sand" || scene.normal[i].z() > 0.5);
    ASSERT_TRUE(name != "concrete" || scene.normal[i].y() < 0);
  }
  EXPECT_GT(area[0], 3600);  // a rippled bed is larger than its projection
  EXPECT_LT(area[0], 3600 * 1.05);
  for (std::size_t m = 0; m < area.size(); ++m) EXPECT_GT(area[m], 0.5) << scene.materials[m].name;
  for (const Material& m : scene.materials) EXPECT_LT(m.lambert_mu, 1 / pi) << m.name;
}

TEST(Reef, is_rough_rock_with_corals_over_sand) {
  const SceneCloud scene = make_built_in_scene("reef", {.points = 100000});
  const Bounds box = bounds(scene);
  EXPECT_NEAR(box.min.x(), 0, 0.05);
  EXPECT_NEAR(box.max.x(), 12, 0.5);
  EXPECT_GT(box.min.z(), -6);
  EXPECT_LT(box.max.z(), -2);
  std::vector<double> area(scene.materials.size(), 0.0), plan(area);
  std::size_t downward = 0;
  for (std::size_t i = 0; i < scene.size(); ++i) {
    area[scene.material[i]] += scene.area[i];
    plan[scene.material[i]] += scene.area[i] * std::abs(scene.normal[i].z());
    downward += scene.normal[i].z() < -0.5f;
  }
  EXPECT_NEAR(plan[0], 24, 0.24);           // sand, 2 m of 12 x 12
  EXPECT_NEAR(plan[1], 120, 1.2);           // rock, the rest
  EXPECT_GT(area[1], 1.1 * plan[1]);        // which is rough
  EXPECT_LT(area[0], 1.1 * plan[0]);        // as the sand is not
  EXPECT_GT(area[2], 5);                    // corals
  EXPECT_GT(downward, scene.size() / 100);  // tables and branches overhang
  EXPECT_GT(box.max.z() - box.min.z(), 1.5);
}

TEST(River, has_dunes_pits_boulders_and_gaps_between_banks) {
  const SceneCloud scene = make_built_in_scene("river", {.points = 60000});
  const Bounds box = bounds(scene);
  EXPECT_NEAR(box.min.x(), 0, 0.05);
  EXPECT_NEAR(box.max.x(), 40, 0.05);
  EXPECT_NEAR(box.min.y(), -8, 0.05);
  EXPECT_NEAR(box.max.y(), 8, 0.05);
  EXPECT_GT(box.min.z(), -7);
  EXPECT_LT(box.max.z(), -4.2);
  ASSERT_EQ(scene.materials.size(), 2U);
  double plan = 0, stones = 0, low = 0, high = -100, pit = 0;
  for (std::size_t i = 0; i < scene.size(); ++i) {
    const Vector3f& p = scene.point[i];
    if (scene.material[i] == 1) {
      stones += scene.area[i];
      continue;
    }
    ASSERT_GT(scene.normal[i].z(), 0.3);
    plan += scene.area[i] * scene.normal[i].z();
    pit = std::min(pit, static_cast<double>(p.z()));
    if (std::abs(p.y()) < 0.5F) low = std::min(low, p.z() + 5.6), high = std::max(high, p.z() + 5.6);
  }
  EXPECT_LT(plan, 640 - 5);  // gaps
  EXPECT_GT(plan, 640 - 40);
  EXPECT_GT(stones, 20);
  EXPECT_GT(high, 0.15);  // dunes
  EXPECT_LT(low, -0.15);
  EXPECT_LT(pit, -6.2);
}

TEST(BuiltInScenes, refuse_bad_options) {
  using testing::HasSubstr;
  EXPECT_THAT(message_of("harbor", {}), HasSubstr("no scene 'harbor', must be one of: harbour, reef, river, plane"));
  EXPECT_THAT(message_of("plane", {.points = 0}), HasSubstr("points = 0"));
  EXPECT_THAT(message_of("plane", {.size = {0, 1}}), HasSubstr("size = 0 x 1 m"));
  EXPECT_THAT(message_of("sphere", {.radius = -1}), HasSubstr("radius = -1 m"));
}

TEST(BuiltInScenes, come_in_batches_bit_for_bit) {
  for (const std::string& name : built_in_scene_names()) {
    const BuiltInSceneOptions options{.points = 5000};
    const SceneCloud whole = make_built_in_scene(name, options);
    SceneCloud all = empty_built_in_scene(name, options);
    std::size_t batches = 0;
    make_built_in_scene_in_batches(name, options, 600, [&](const SceneCloud& batch) {
      ++batches;
      EXPECT_LT(batch.size(), 1200U);
      all.point.insert(all.point.end(), batch.point.begin(), batch.point.end());
      all.normal.insert(all.normal.end(), batch.normal.begin(), batch.normal.end());
      all.area.insert(all.area.end(), batch.area.begin(), batch.area.end());
      all.material.insert(all.material.end(), batch.material.begin(), batch.material.end());
      all.id.insert(all.id.end(), batch.id.begin(), batch.id.end());
    });
    EXPECT_GT(batches, 4U);
    EXPECT_EQ(all.point, whole.point) << name;
    EXPECT_EQ(all.normal, whole.normal) << name;
    EXPECT_EQ(all.area, whole.area) << name;
    EXPECT_EQ(all.material, whole.material) << name;
    EXPECT_EQ(all.id, whole.id) << name;
    EXPECT_EQ(all.materials.size(), whole.materials.size()) << name;
  }
}
