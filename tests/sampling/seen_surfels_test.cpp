// SPDX-License-Identifier: BSD-3-Clause
#include "sampling/seen_surfels.hpp"

#include "sampling/sampling_scenes.hpp"
#include "scene/built_in_scenes.hpp"
#include "support/test.hpp"

namespace {

std::vector<std::uint32_t> seen_of(const std::vector<Visibility>& visibility) {
  std::vector<std::uint32_t> list;
  for (std::uint32_t i = 0; i < visibility.size(); ++i)
    if (visibility[i] == Visibility::seen) list.push_back(i);
  return list;
}

}  // namespace

TEST(FindVisibility, agrees_with_find_scatterers) {
  const SceneCloud scene = make_built_in_scene("harbour", {.points = 20000});
  const Pose pose = at(0, 0, -3, 0, 10);
  const BeamFan fan = make_fan(91, radians(90), radians(1), radians(20));
  const RangeGate gate{1, 40, 0.02};
  for (const bool occlusion : {true, false}) {
    SamplingOptions options = unsplit();
    options.occlusion = occlusion;
    const Sampling expected = find_scatterers(scene, pose, fan, gate, options);
    const auto visibility =
        find_visibility(scene, pose, fan, gate, std::vector<std::uint8_t>(scene.size(), 1), options);
    EXPECT_EQ(
        find_visibility(PreparedScene(scene), pose, fan, gate, std::vector<std::uint8_t>(scene.size(), 1), options),
        visibility);
    EXPECT_EQ(seen_of(visibility), expected.scatterers.surfel);
    EXPECT_EQ(std::count(visibility.begin(), visibility.end(), Visibility::hidden), expected.report.hidden);
    EXPECT_EQ(std::count(visibility.begin(), visibility.end(), Visibility::turned_away), expected.report.back_facing);
    EXPECT_EQ(std::count(visibility.begin(), visibility.end(), Visibility::outside),
              scene.size() - expected.report.in_gate);
  }
}

TEST(FindVisibility, surfels_not_queried_still_occlude) {
  SceneCloud scene;
  add_surfel(scene, {10, 0, 0}, {-1, 0, 0}, 1e-4);
  add_wall(scene, 5, 1, 1, 0.1);
  std::vector<std::uint8_t> queried(scene.size(), 0);
  queried[0] = 1;
  const auto visibility = find_visibility(scene, Pose::Identity(), wide_fan(), long_gate(), queried, unsplit());
  EXPECT_EQ(find_visibility(PreparedScene(scene), Pose::Identity(), wide_fan(), long_gate(), queried, unsplit()),
            visibility);
  EXPECT_EQ(visibility[0], Visibility::hidden);
  EXPECT_EQ(std::count(visibility.begin(), visibility.end(), Visibility::not_queried), scene.size() - 1);
}

TEST(FindVisibility, refuses_a_list_of_another_length) {
  SceneCloud scene;
  add_wall(scene, 5, 1, 1, 1);
  EXPECT_EQ(error_of([&] { find_visibility(scene, Pose::Identity(), wide_fan(), long_gate(), {}, unsplit()); }),
            "find_visibility: asked has 0 entries, must have one per surfel (4)");
  const PreparedScene prepared(scene);
  EXPECT_EQ(error_of([&] { find_visibility(prepared, Pose::Identity(), wide_fan(), long_gate(), {}, unsplit()); }),
            "find_visibility: asked has 0 entries, must have one per surfel (4)");
}

TEST(SplitListed, splits_as_find_scatterers_does) {
  SceneCloud scene;
  add_wall(scene, 5, 2, 2, 0.2);
  const Sampling expected = find_scatterers(scene, Pose::Identity(), wide_fan(), long_gate());
  ASSERT_GT(expected.scatterers.size(), 2 * scene.size());
  std::vector<std::uint32_t> all;
  for (std::uint32_t i = 0; i < scene.size(); ++i) all.push_back(i);
  EXPECT_TRUE(equal(split_listed(scene, Pose::Identity(), wide_fan(), long_gate(), all, {}), expected.scatterers));
  EXPECT_TRUE(equal(split_listed(PreparedScene(scene), Pose::Identity(), wide_fan(), long_gate(), all, {}),
                    expected.scatterers));
}
