// SPDX-License-Identifier: BSD-3-Clause
#include "scene/posed_scene.hpp"

#include <algorithm>

#include "core/units.hpp"
#include "support/errors.hpp"
#include "support/scenes.hpp"
#include "support/test.hpp"

namespace insonify::posed_scene_tests {

using Eigen::Vector3d;

std::shared_ptr<const SceneCloud> floor_cloud(double height = -5) {
  SceneCloud bed;
  bed.materials = {{.name = "sand"}};
  add_floor(bed, {-2, -2, height}, 40, 0.1);
  return std::make_shared<SceneCloud>(bed);
}

std::shared_ptr<const SceneCloud> ball_cloud(const std::string& material = "steel", int count = 500) {
  SceneCloud ball;
  ball.materials = {{.name = material, .lambert_mu = 0.01}};
  add_sphere(ball, {0, 0, 0}, 0.2, count);
  return std::make_shared<SceneCloud>(ball);
}

PlacedPart bed_part(const std::string& name = "bed") {
  return {.name = name, .cloud = floor_cloud(), .captured = true};
}

PlacedPart ball_part(const std::string& name, const Vector3d& at, const std::string& material = "steel") {
  PlacedPart part{.name = name, .cloud = ball_cloud(material)};
  part.world_from_part = pose_from_yaw_pitch_roll(at, 0.3, 0.2, -0.4);
  return part;
}

TEST(MergeParts, places_each_surfel_by_the_pose_of_its_part) {
  const PlacedPart parts[] = {bed_part(), ball_part("tyre", {1, 0.5, -4})};
  const SceneCloud scene = merge_parts(parts);
  require_valid(scene, "test");
  ASSERT_EQ(scene.size(), parts[0].cloud->size() + parts[1].cloud->size());
  for (std::size_t i = 0; i < scene.size(); ++i) {
    const PlacedPart& part = parts[scene.part[i]];
    const Vector3d own = world(*part.cloud, scene.id[i]);
    EXPECT_LT((world(scene, i) - part.world_from_part * own).norm(), 1e-6);
    const Vector3d normal = part.world_from_part.linear() * part.cloud->normal[scene.id[i]].cast<double>();
    EXPECT_LT((scene.normal[i].cast<double>() - normal).norm(), 1e-6);
    EXPECT_EQ(scene.materials[scene.material[i]].name, scene.part[i] == 0 ? "sand" : "steel");
  }
}

TEST(MergeParts, does_not_depend_on_the_order_of_the_parts) {
  const PlacedPart a = bed_part(), b = ball_part("b", {1, 0, -4}), c = ball_part("c", {0, 1, -3}, "rubber");
  const SceneCloud one = merge_parts(std::vector{a, b, c}), other = merge_parts(std::vector{c, a, b});
  expect_same_surfels(one, other);
  EXPECT_EQ(one.part, other.part);
  EXPECT_EQ(one.material, other.material);
}

TEST(MergeParts, keeps_the_random_numbers_of_a_part_whatever_else_is_there) {
  const auto keys = [](const SceneCloud& scene, const std::string& part) {
    std::vector<std::uint64_t> all;
    for (std::size_t i = 0; i < scene.size(); ++i)
      if (scene.part_of_surfel(i)->name == part) all.push_back(scene.piece_id(i, 3));
    return all;
  };
  const SceneCloud few = merge_parts(std::vector{bed_part(), ball_part("pot", {1, 0, -4})});
  const SceneCloud more =
      merge_parts(std::vector{bed_part(), ball_part("anchor", {0, 0, -3}), ball_part("pot", {0, 0, -4})});
  EXPECT_EQ(keys(few, "pot"), keys(more, "pot"));
  EXPECT_EQ(keys(few, "bed"), keys(more, "bed"));
  EXPECT_NE(keys(more, "anchor"), keys(more, "pot"));  // of the same cloud
  EXPECT_EQ(more.piece_of(more.size() - 1, more.piece_id(more.size() - 1, 3)), 3U);
}

TEST(MergeParts, keeps_which_parts_have_two_sides) {
  auto thin = std::make_shared<SceneCloud>(*ball_cloud());
  thin->normals_oriented = false;
  const SceneCloud scene = merge_parts(std::vector{bed_part(), PlacedPart{.name = "net", .cloud = thin}});
  EXPECT_FALSE(scene.normals_oriented);
  EXPECT_TRUE(scene.oriented(0));
  EXPECT_FALSE(scene.oriented(scene.size() - 1));
}

TEST(MergeParts, leaves_out_the_surfels_that_are_not_there) {
  PlacedPart half = ball_part("mine", {0, 0, -4});
  half.surfels = {0, 7, 499};
  const SceneCloud scene = merge_parts(std::vector{half});
  EXPECT_EQ(scene.id, (std::vector<std::uint32_t>{0, 7, 499}));
}

TEST(MergeParts, lists_parts_that_are_not_there) {
  const PlacedPart absent{.name = "anchor", .label = "anchor", .absent = true};
  const SceneCloud scene = merge_parts(std::vector{bed_part(), ball_part("pot", {1, 0, -4}), absent});
  ASSERT_EQ(scene.parts.size(), 3U);
  EXPECT_EQ(scene.parts[0].name, "anchor");
  EXPECT_EQ(std::count(scene.part.begin(), scene.part.end(), 0), 0);
  PosedScene posed(std::vector{bed_part()}, ball_cloud()->materials);
  EXPECT_EQ(posed.pose(std::vector{absent})->scene().size(), floor_cloud()->size());
  EXPECT_EQ(posed.pose(std::vector{absent})->scene().parts.size(), 2U);
}

TEST(MergeParts, refuses_what_cannot_be_a_scene) {
  const auto refusal = [](std::vector<PlacedPart> parts) { return error_of([&] { merge_parts(parts); }); };
  PlacedPart moved = bed_part(), empty{.name = "nothing"}, bent = ball_part("bent", {0, 0, 0}), lost = bent;
  moved.velocity = {1, 0, 0};
  bent.world_from_part.linear() *= 2;
  lost.world_from_part.translation().x() = NAN;
  EXPECT_EQ(refusal({bed_part(), ball_part("bed", {0, 0, 0})}),
            "merge_parts: two parts are called 'bed'; give each a name of its own");
  EXPECT_EQ(refusal({moved}), "merge_parts: part 'bed': a captured part is neither moved nor turned");
  EXPECT_EQ(refusal({empty}), "merge_parts: part 'nothing': it has no surfels");
  for (const PlacedPart& bad : {bent, lost})
    EXPECT_EQ(refusal({bad}), "merge_parts: part 'bent': world_from_part must be finite, a rotation and a translation");
  EXPECT_EQ(refusal({{.cloud = ball_cloud()}}), "merge_parts: a part has no name");
}

TEST(PosedScene, has_the_surfels_of_the_merged_parts_at_every_pose) {
  const PlacedPart bed = bed_part();
  PosedScene posed(std::vector{bed}, ball_cloud()->materials);
  for (const double x : {0.0, 1.5, -0.7}) {
    std::vector<PlacedPart> others{ball_part("diver", {x, 0.2, -4}), ball_part("fish", {-x, 1, -3})};
    others[0].velocity = {2, 0, 0};
    others.resize(x < 0 ? 1 : 2);
    const auto scene = posed.pose(others);
    others.push_back(bed);
    const SceneCloud merged = merge_parts(others, ball_cloud()->materials);
    expect_same_surfels(scene->scene(), merged);
    require_valid(scene->scene(), "test");
    EXPECT_EQ(scene->whole().surfels, merged.size());
    EXPECT_NEAR(scene->whole().mean_spacing, whole_of(merged).mean_spacing, 1e-6);
    EXPECT_EQ(scene->whole().largest_area, whole_of(merged).largest_area);
    EXPECT_NEAR(scene->whole().fastest, 2, 1e-12);
  }
}

TEST(PosedScene, has_blocks_that_hold_their_surfels) {
  PosedScene posed(std::vector{bed_part()});
  const auto scene = posed.pose(std::vector{ball_part("diver", {30, -8, 5}), ball_part("fish", {0.3, 1, -3})});
  std::vector<int> visits(scene->scene().size());
  for (const SurfelBlock& block : scene->blocks())
    for (std::uint32_t k = block.begin; k < block.end; ++k) {
      const std::uint32_t i = scene->order()[k];
      ++visits[i];
      EXPECT_LE((scene->scene().point[i] - block.centre).norm(), block.radius);
      EXPECT_LE(scene->scene().area[i], block.largest_area);
    }
  EXPECT_EQ(std::count(visits.begin(), visits.end(), 1), static_cast<std::ptrdiff_t>(visits.size()));
}

TEST(PosedScene, may_have_nothing_that_rests) {
  PosedScene posed({});
  EXPECT_EQ(posed.pose({})->scene().size(), 0U);
  EXPECT_EQ(posed.pose(std::vector{ball_part("ball", {4e5, 5e6, -10})})->scene().size(), 500U);
}

}  // namespace insonify::posed_scene_tests
