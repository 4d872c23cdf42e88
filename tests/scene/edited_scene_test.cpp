// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <thread>

#include "scene/detail_levels.hpp"
#include "scene/posed_scene.hpp"
#include "support/errors.hpp"
#include "support/scenes.hpp"
#include "support/test.hpp"

namespace insonify::edited_scene_tests {

using Eigen::Vector3d;

std::shared_ptr<const SceneCloud> sand_bed() {
  SceneCloud bed;
  bed.materials = {{.name = "sand"}};
  add_floor(bed, {-2, -2, -5}, 40, 0.1);
  return std::make_shared<SceneCloud>(bed);
}

PlacedPart placed_ball(const std::string& name, const Vector3d& at, const std::string& material = "steel",
                       int count = 300) {
  SceneCloud ball;
  ball.materials = {{.name = material, .lambert_mu = 0.01}};
  add_sphere(ball, {0, 0, 0}, 0.2, count);
  PlacedPart part{.name = name, .label = name + " class", .cloud = std::make_shared<SceneCloud>(ball)};
  part.file_origin = {0.1, 0, -0.2};
  part.place_file(pose_from_yaw_pitch_roll(at, 0.3, 0.2, -0.4));
  return part;
}

EditedScene edited_bed() { return EditedScene({{.name = "bed", .cloud = sand_bed(), .captured = true, .key = 0}}); }

/// Expects that the scene is what it would be if its parts had been there from the beginning.
void expect_as_new(const EditedScene& edited) {
  const auto now = edited.scene_of(edited.now());
  const SceneCloud& scene = now->scene();
  require_valid(scene, "test");
  const EditedScene again = edited_bed();
  const auto fresh_scene = again.scene_of(std::make_shared<SceneArrangement>(*edited.now()));
  const SceneCloud& fresh = fresh_scene->scene();
  expect_same_surfels(scene, fresh);
  EXPECT_EQ(scene.part, fresh.part);
  EXPECT_EQ(scene.material, fresh.material);
  EXPECT_EQ(scene.materials, fresh.materials);
  ASSERT_EQ(scene.parts.size(), fresh.parts.size());
  for (std::size_t p = 0; p < scene.parts.size(); ++p) {
    EXPECT_EQ(scene.parts[p].name, fresh.parts[p].name);
    EXPECT_EQ(scene.parts[p].world_from_part.matrix(), fresh.parts[p].world_from_part.matrix());
    EXPECT_EQ(scene.parts[p].velocity, fresh.parts[p].velocity);
  }
  EXPECT_TRUE(std::ranges::equal(now->order(), fresh_scene->order()));
  ASSERT_EQ(now->blocks().size(), fresh_scene->blocks().size());
  for (std::size_t b = 0; b < now->blocks().size(); ++b) {
    EXPECT_EQ(now->blocks()[b].begin, fresh_scene->blocks()[b].begin);
    EXPECT_EQ(now->blocks()[b].end, fresh_scene->blocks()[b].end);
    EXPECT_EQ(now->blocks()[b].centre, fresh_scene->blocks()[b].centre);
  }
  EXPECT_EQ(now->whole().surfels, fresh_scene->whole().surfels);
  EXPECT_EQ(now->whole().fastest, fresh_scene->whole().fastest);
}

TEST(EditedScene, is_after_each_edit_what_it_would_be_if_made_anew) {
  EditedScene edited = edited_bed();
  EXPECT_EQ(edited.add(placed_ball("mine", {1, 0, -4})), 2U);
  expect_as_new(edited);
  EXPECT_EQ(edited.add(placed_ball("anchor", {0, 1, -4}, "iron", 200)), 3U);
  EXPECT_EQ(edited.add(placed_ball("tyre", {0, -1, -3}, "rubber", 400)), 4U);
  expect_as_new(edited);
  edited.move(3, pose_from_yaw_pitch_roll({2, 2, -3}, 1, 0, 0), {1, 0, 0}, {0, 0, 2});
  expect_as_new(edited);
  edited.remove(2);
  expect_as_new(edited);
  edited.move(4, pose_from_yaw_pitch_roll({-1, -1, -3}, 0, 0, 0));
  EXPECT_EQ(edited.add(placed_ball("pot", {1, 1, -4}, "steel")), 5U);
  edited.remove(4);
  expect_as_new(edited);
  EXPECT_EQ(edited.add(placed_ball("mine", {1, 0, -4})), 2U);  // its id again
  expect_as_new(edited);
}

TEST(EditedScene, keeps_ids_classes_and_the_random_numbers_of_the_ground) {
  EditedScene edited = edited_bed();
  edited.add(placed_ball("mine", {1, 0, -4})), edited.add(placed_ball("tyre", {0, -1, -3}, "rubber"));
  const auto class_of_tyre = [&] {
    const auto scene = edited.scene_of(edited.now());
    const auto& table = scene->scene().materials;
    return std::ranges::find(table, "tyre class", &Material::name) - table.begin();
  };
  const auto before = class_of_tyre();
  edited.remove(2);
  EXPECT_EQ(class_of_tyre(), before);
  const auto held = edited.scene_of(edited.now());
  const SceneCloud& scene = held->scene();
  ASSERT_EQ(scene.parts.size(), 3U);
  EXPECT_EQ(scene.parts[1].name, "mine");
  EXPECT_EQ(scene.parts[2].name, "tyre");
  EXPECT_EQ(std::ranges::count(scene.part, 1), 0);
  EXPECT_EQ(std::ranges::count(scene.part, 2), 300);
  for (const std::size_t i : {0, 700}) EXPECT_EQ(scene.random_id(i), sand_bed()->random_id(i));
  EXPECT_EQ(edited.add(placed_ball("pot", {0, 0, -4})), 4U);
}

TEST(EditedScene, leaves_the_ground_where_it_is_in_memory) {
  EditedScene edited = edited_bed();
  edited.add(placed_ball("mine", {1, 0, -4}));
  const Eigen::Vector3f* const points = edited.scene_of(edited.now())->scene().point.data();
  for (int k = 0; k < 50; ++k) {
    edited.move(2, pose_from_yaw_pitch_roll({0.1 * k, 0, -4}, 0, 0, 0));
    EXPECT_EQ(edited.scene_of(edited.now())->scene().point.data(), points);
  }
}

TEST(EditedScene, is_posed_once_for_threads_that_ask_at_once) {
  EditedScene edited = edited_bed();
  edited.add(placed_ball("mine", {1, 0, -4}));
  const auto arrangement = edited.now();
  std::vector<std::shared_ptr<const PreparedScene>> held(8);
  std::vector<std::thread> threads;
  for (auto& scene : held) threads.emplace_back([&] { scene = edited.scene_of(arrangement); });
  for (std::thread& thread : threads) thread.join();
  for (const auto& scene : held) EXPECT_EQ(scene, held.front());
  // Levels that a scene made stay while nothing is edited.
  const DetailLevels* const levels = &held.front()->levels();
  held.clear();
  EXPECT_EQ(&edited.scene_of(arrangement)->levels(), levels);
}

TEST(EditedScene, gives_what_was_held_before_an_edit) {
  EditedScene edited = edited_bed();
  edited.add(placed_ball("mine", {1, 0, -4}));
  const auto before = edited.now();
  const auto in_use = edited.scene_of(before);
  edited.remove(2);
  const auto after = edited.scene_of(edited.now());
  EXPECT_EQ(in_use->scene().size(), sand_bed()->size() + 300);
  EXPECT_EQ(after->scene().size(), sand_bed()->size());
  EXPECT_EQ(edited.scene_of(before), in_use);
}

TEST(EditedScene, has_the_parts_of_its_beginning_by_name) {
  EditedScene edited({{.name = "sea bed", .cloud = sand_bed(), .captured = true}, placed_ball("anchor", {1, 0, -4})});
  edited.move(1, pose_from_yaw_pitch_roll({0, 0, -2}, 0, 0, 0));
  const auto scene = edited.scene_of(edited.now());
  ASSERT_EQ(scene->scene().parts.size(), 2U);
  EXPECT_EQ(scene->scene().parts[0].name, "anchor");
  EXPECT_EQ(std::ranges::count(scene->scene().part, 0), 300);
  EXPECT_EQ(error_of([&] { edited.remove(2); }),
            "EditedScene::remove: part 2, 'sea bed', stands as captured, and is neither moved nor removed");
}

TEST(EditedScene, refuses_what_cannot_be_edited) {
  EditedScene edited = edited_bed();
  edited.add(placed_ball("mine", {1, 0, -4}));
  EXPECT_EQ(error_of([&] { edited.move(3, Pose::Identity()); }),
            "EditedScene::move: no part has the id 3; ids are 1 to 2");
  EXPECT_EQ(error_of([&] { edited.remove(0); }), "EditedScene::remove: no part has the id 0; ids are 1 to 2");
  EXPECT_EQ(error_of([&] {
              edited.add(placed_ball("mine", {0, 0, 0}));
            }),
            "EditedScene::add: two parts are called 'mine'; give each a name of its own");
  edited.remove(2);
  EXPECT_EQ(error_of([&] { edited.remove(2); }), "EditedScene::remove: part 2, 'mine', is not in the scene");
  Pose bent = Pose::Identity();
  bent.linear() *= 2;
  edited.add(placed_ball("mine", {1, 0, -4}));
  EXPECT_EQ(error_of([&] { edited.move(2, bent); }),
            "EditedScene::move: part 'mine': world_from_part must be finite, a rotation and a translation");
  expect_as_new(edited);
}

}  // namespace insonify::edited_scene_tests
