// SPDX-License-Identifier: BSD-3-Clause
#include "scene/thin_scene.hpp"

#include "scene/built_in_scenes.hpp"
#include "scene/scene_index.hpp"
#include "support/test.hpp"

namespace {

std::map<std::uint16_t, double> area_by_material(const SceneCloud& scene) {
  std::map<std::uint16_t, double> sum;
  for (std::size_t i = 0; i < scene.size(); ++i) sum[scene.material[i]] += scene.area[i];
  return sum;
}

std::map<std::uint32_t, float> area_by_id(const SceneCloud& scene) {
  std::map<std::uint32_t, float> area;
  for (std::size_t i = 0; i < scene.size(); ++i) area[scene.id[i]] = scene.area[i];
  return area;
}

SceneCloud dense_plane() { return make_built_in_scene("plane", {.points = 40000, .size = {8, 8}}); }  // 4 cm apart

}  // namespace

TEST(ThinScene, keeps_the_area_of_each_material) {
  const SceneCloud scene = make_built_in_scene("harbour", {.points = 30000});
  const auto before = area_by_material(scene);
  ASSERT_GT(before.size(), 2u);
  for (const double spacing : {0.2, 0.6, 1.8}) {
    const SceneCloud thinned = thin_scene(scene, spacing);
    const auto after = area_by_material(thinned);
    ASSERT_EQ(after.size(), before.size());
    for (const auto& [material, area] : before) EXPECT_NEAR(after.at(material), area, 1e-6 * area) << spacing;
    EXPECT_EQ(thinned.materials.size(), scene.materials.size());
  }
}

TEST(ThinScene, leaves_surfels_as_far_apart_as_asked) {
  constexpr double spacing = 0.16, least = 0.8 * spacing;
  const SceneCloud scene = dense_plane(), thinned = thin_scene(scene, spacing);
  EXPECT_NEAR(64 / static_cast<double>(thinned.size()), spacing * spacing, 0.1 * spacing * spacing);
  const SceneIndex index(thinned.point);
  std::vector<Neighbour> near;
  for (const Eigen::Vector3f& p : thinned.point) {
    index.find_nearest(p, 2, near);
    ASSERT_GE(std::sqrt(near[1].squared_distance), least * (1 - 1e-5));
  }
  // Every removed surfel has a kept one nearby; otherwise there would be a hole.
  for (const Eigen::Vector3f& p : scene.point) {
    index.find_nearest(p, 1, near);
    ASSERT_LE(std::sqrt(near[0].squared_distance), least);
  }
}

TEST(ThinScene, keeps_all_other_fields_of_kept_surfels) {
  const SceneCloud scene = dense_plane(), thinned = thin_scene(scene, 0.2);
  std::map<std::uint32_t, std::size_t> position;
  for (std::size_t i = 0; i < scene.size(); ++i) position[scene.id[i]] = i;
  for (std::size_t k = 0; k < thinned.size(); ++k) {
    const std::size_t i = position.at(thinned.id[k]);
    ASSERT_EQ(thinned.point[k], scene.point[i]);
    ASSERT_EQ(thinned.normal[k], scene.normal[i]);
    ASSERT_GE(thinned.area[k], scene.area[i]);
    ASSERT_TRUE(k == 0 || position.at(thinned.id[k - 1]) < i);
  }
  EXPECT_EQ(area_by_id(thin_scene(scene, 0.001)), area_by_id(scene));
}

TEST(ThinScene, is_decided_by_ids_not_by_the_order_of_surfels) {
  const SceneCloud scene = dense_plane();
  std::vector<std::uint32_t> order(scene.size());
  std::iota(order.begin(), order.end(), 0u);
  std::shuffle(order.begin(), order.end(), std::mt19937(4));
  const auto straight = area_by_id(thin_scene(scene, 0.2)),
             shuffled = area_by_id(thin_scene(subset(scene, order), 0.2));
  ASSERT_EQ(straight.size(), shuffled.size());
  for (const auto& [id, area] : straight) ASSERT_NEAR(shuffled.at(id), area, 1e-6 * area);
}

TEST(ThinScene, joins_neither_materials_nor_the_two_sides_of_a_plate) {
  SceneCloud scene;
  scene.materials = {{.name = "mud"}, {.name = "rock"}};
  for (int i = 0; i < 4; ++i) add_surfel(scene, {0.001 * i, 0, 0}, {0, 0, i < 2 ? 1.0 : -1.0}, 1, i == 0 ? 0 : 1);
  EXPECT_THAT(area_by_id(thin_scene(scene, 1)), testing::SizeIs(3));
  scene.normals_oriented = false;  // both sides reflect
  EXPECT_THAT(area_by_id(thin_scene(scene, 1)), testing::SizeIs(2));
  EXPECT_THAT(area_by_id(thin_scene(scene, 0.0001)), testing::SizeIs(4));
}

TEST(ThinScene, of_nothing_is_empty_and_of_coincident_points_is_one) {
  EXPECT_EQ(thin_scene({}, 1).size(), 0u);
  SceneCloud heap;
  for (int i = 0; i < 100; ++i) add_surfel(heap, {1e6, 2, 3}, {0, 0, 1}, 0.01);
  const SceneCloud one = thin_scene(heap, 1e-3);
  ASSERT_EQ(one.size(), 1u);
  EXPECT_NEAR(one.area[0], 1, 1e-6);
}

TEST(ThinScene, says_what_is_wrong_with_its_arguments) {
  SceneCloud scene;
  add_surfel(scene, {0, 0, 0}, {0, 0, 1}, 1);
  add_surfel(scene, {1000, 0, 0}, {0, 0, 1}, 1);
  const auto message = [&](double spacing, double angle) -> std::string {
    return error_of([&] { thin_scene(scene, spacing, {.normal_angle = angle}); });
  };
  EXPECT_EQ(message(1, 0.5), "no error");
  EXPECT_THAT(message(0, 0.5), testing::StartsWith("thin_scene: spacing = 0 m, must be > 0"));
  EXPECT_THAT(message(NAN, 0.5), HasSubstr("must be > 0"));
  EXPECT_THAT(message(1e-5, 0.5), HasSubstr("too small for a scene of this extent"));
  EXPECT_THAT(message(1, 2), HasSubstr("normal_angle = 2 rad"));
  scene.normal[0].setZero();
  EXPECT_THAT(error_of([&] { thin_scene(scene, 1); }, ErrorKind::content),
              testing::StartsWith("thin_scene: scene.normal[0]"));
}
