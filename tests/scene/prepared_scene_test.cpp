// SPDX-License-Identifier: BSD-3-Clause
#include "scene/prepared_scene.hpp"

#include "scene/built_in_scenes.hpp"
#include "support/test.hpp"

namespace {

SceneCloud harbour_with_strays() {
  SceneCloud scene = make_built_in_scene("harbour", {.points = 20000});
  for (const double x : {1e3, -1e4, 1e5, 3e5, -7e5}) add_surfel(scene, {x, x / 3, -x}, {0, 0, 1}, 0.1);
  return scene;
}

}  // namespace

TEST(PreparedScene, blocks_hold_every_surfel_once_inside_their_balls) {
  const SceneCloud scene = harbour_with_strays();
  const PreparedScene prepared(scene);
  std::vector<int> times(scene.size(), 0);
  std::uint32_t end = 0;
  for (const SurfelBlock& block : prepared.blocks()) {
    EXPECT_EQ(block.begin, end);
    end = block.end;
    for (std::uint32_t k = block.begin; k < block.end; ++k) {
      const std::uint32_t i = prepared.order()[k];
      ++times[i];
      ASSERT_LE((scene.point[i].cast<double>() - block.centre.cast<double>()).norm(), block.radius);
      ASSERT_LE(scene.area[i], block.largest_area);
      if (k > block.begin) {
        ASSERT_LT(prepared.order()[k - 1], i);
      }
    }
  }
  EXPECT_EQ(end, scene.size());
  EXPECT_THAT(times, testing::Each(1));
}

// 20 000 surfels on about 10 000 m^2: 128 of them cover 8 m x 8 m, also if a few points are far away.
TEST(PreparedScene, takes_a_given_curve) {
  const SceneCloud scene = harbour_with_strays();
  std::vector<std::uint32_t> backwards(scene.size());
  std::iota(backwards.rbegin(), backwards.rend(), 0);
  const PreparedScene prepared(SceneCloud(scene), backwards);
  ASSERT_EQ(prepared.blocks().size(), PreparedScene(scene).blocks().size());
  // Blocks follow the curve, and ascend inside.
  const SurfelBlock& first = prepared.blocks().front();
  for (std::uint32_t k = first.begin; k < first.end; ++k)
    EXPECT_EQ(prepared.order()[k], scene.size() - (first.end - k));
  EXPECT_EQ(prepared.whole().mean_spacing, PreparedScene(scene).whole().mean_spacing);
  backwards.pop_back();
  EXPECT_THAT(error_of([&] { const PreparedScene one_is_missing(SceneCloud(scene), backwards); }, ErrorKind::argument),
              testing::HasSubstr("order holds"));
}

TEST(PreparedScene, blocks_are_small_though_a_few_points_are_far_away) {
  const SceneCloud scene = harbour_with_strays();
  const PreparedScene prepared(scene);
  std::vector<float> radii;
  for (const SurfelBlock& block : prepared.blocks()) radii.push_back(block.radius);
  std::sort(radii.begin(), radii.end());
  EXPECT_LT(radii[radii.size() / 2], 8);
  EXPECT_LT(radii[radii.size() * 9 / 10], 16);
}

TEST(PreparedScene, knows_the_mean_spacing) {
  const SceneCloud scene = harbour_with_strays();
  const double area = std::accumulate(scene.area.begin(), scene.area.end(), 0.0);
  EXPECT_DOUBLE_EQ(PreparedScene(scene).whole().mean_spacing, std::sqrt(area / static_cast<double>(scene.size())));
}

TEST(PreparedScene, knows_the_largest_surfel) {
  const SceneCloud scene = harbour_with_strays();
  EXPECT_EQ(PreparedScene(scene).whole().largest_area, *std::max_element(scene.area.begin(), scene.area.end()));
  const SceneCloud empty;
  EXPECT_EQ(PreparedScene(empty).whole().largest_area, 0);
}

TEST(PreparedScene, may_be_empty_or_of_coincident_points) {
  const SceneCloud empty;
  EXPECT_TRUE(PreparedScene(empty).blocks().empty());
  SceneCloud heap;
  for (int i = 0; i < 300; ++i) add_surfel(heap, {1, 2, 3}, {0, 0, 1}, 0);
  const PreparedScene prepared(heap);
  EXPECT_EQ(prepared.order().size(), 300u);
  EXPECT_EQ(prepared.blocks().size(), 3u);
}

TEST(PreparedScene, refuses_an_invalid_scene) {
  SceneCloud scene;
  add_surfel(scene, {1, 2, 3}, {0, 0, 0}, 1);
  EXPECT_THAT(error_of([&] { const PreparedScene prepared(scene); }, ErrorKind::content),
              testing::StartsWith("PreparedScene: scene.normal[0]"));
}
