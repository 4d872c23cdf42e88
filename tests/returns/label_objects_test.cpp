// SPDX-License-Identifier: BSD-3-Clause
// Objects of label images.
#include "returns/label_objects.hpp"

#include "support/test.hpp"

namespace {

Grid<std::uint32_t> three_parts_of_two() {
  Grid<std::uint32_t> key(4, 5);
  key << 0, 2, 2, 0, 3,  //
      0, 2, 0, 3, 0,     //
      0, 0, 0, 0, 0,     //
      2, 2, 0, 0, 2;
  return key;
}

}  // namespace

TEST(LabelObjects, parts_are_connected_by_sides_and_corners) {
  Grid<std::uint32_t> expected(4, 5);
  expected << 0, 1, 1, 0, 2,  //
      0, 1, 0, 2, 0,          //
      0, 0, 0, 0, 0,          //
      3, 3, 0, 0, 4;
  EXPECT_TRUE((connected_groups(three_parts_of_two(), 1) == expected).all());
  const Grid<std::uint32_t> large = connected_groups(three_parts_of_two(), 2);
  EXPECT_EQ(large.maxCoeff(), 3U);
  EXPECT_EQ(large(3, 4), 0U);
  EXPECT_EQ(large(3, 0), 3U);
}

TEST(LabelObjects, given_ids_stay_and_larger_ones_have_the_lowest_free_numbers) {
  const SceneInstances all =
      number_instances({{5, 1}, {6, 65534}, {7, 4000000000}, {8, 65535}, {9, 3}, {10, 0}, {11, 65535}});
  EXPECT_EQ(all.of_surfel,
            (std::unordered_map<std::uint32_t, std::uint32_t>{{5, 1}, {6, 65534}, {7, 4}, {8, 2}, {9, 3}, {11, 2}}));
  EXPECT_EQ(all.renumbered, (std::map<std::uint32_t, std::uint32_t>{{2, 65535}, {4, 4000000000}}));
  EXPECT_EQ(all.most, 65534U);
  EXPECT_EQ(number_instances({}), SceneInstances{});
}

TEST(LabelObjects, keep_the_ids_of_the_scene_and_connected_parts_come_above_all_of_them) {
  Grid<std::uint32_t> id(4, 5);  // surfels 10 and 11 are of object 42, 12 of object 7; 13 of 100 is in no pixel
  id << 0, 10, 12, 0, 12,        //
      0, 11, 0, 99, 0,           //
      0, 0, 0, 0, 0,             //
      10, 99, 0, 0, 98;
  Grid<std::uint32_t> expected(4, 5);
  expected << 0, 42, 7, 0, 7,  // object 7 is of two kinds, and one nevertheless
      0, 42, 0, 101, 0,        //
      0, 0, 0, 0, 0,           //
      42, 102, 0, 0, 103;
  const SceneInstances instances = number_instances({{10, 42}, {11, 42}, {12, 7}, {13, 100}});
  EXPECT_TRUE((number_objects(three_parts_of_two(), id, instances) == expected).all());
  EXPECT_TRUE((number_objects(three_parts_of_two(), id, {}) == connected_groups(three_parts_of_two(), 1)).all());
  const Grid<std::uint32_t> large = number_objects(three_parts_of_two(), id, instances, 3);
  EXPECT_EQ(large.maxCoeff(), 42U);  // of three pixels
  EXPECT_EQ(large(0, 2), 0U);
  expect_error(ErrorKind::argument, {"number_objects", "one size"},
               [] { number_objects(three_parts_of_two(), Grid<std::uint32_t>::Zero(5, 4), {}); });
}

TEST(LabelObjects, of_a_ground_with_given_ids_and_of_its_parts_have_numbers_of_their_own) {
  PixelLabels labels{Grid<std::uint16_t>(1, 5), Grid<std::uint32_t>(1, 5), Grid<float>::Ones(1, 5), {"sand", "mine"}};
  labels.material << 0, 0, 1, 1, 0;
  labels.id << 7, 8, 7, 3, 9;
  labels.part.resize(1, 5);
  labels.part << 0, 0, 1, 2, 0;
  labels.part_names = {"bed", "mine", "net"}, labels.part_labels = {"", "mine", ""};
  // Surfel 7 of the bed is of object 4; surfels 7 and 3 of other parts are not.
  Grid<std::uint32_t> expected(1, 5), without(1, 5);
  expected << 4, 8, 6, 9, 10;
  EXPECT_TRUE((instance_image(labels, number_instances({{7, 4}, {3, 4}})) == expected).all());
  without << 4, 4, 2, 5, 6;
  EXPECT_TRUE((instance_image(labels) == without).all());
}

TEST(LabelObjects, shadow_and_weak_labels_are_of_no_object) {
  PixelLabels labels;
  labels.material.resize(1, 5), labels.id.resize(1, 5), labels.share.resize(1, 5);
  labels.material << 0, 0, PixelLabels::shadow, PixelLabels::nothing, 0;
  labels.id << 4, 5, PixelLabels::no_id, PixelLabels::no_id, 4;
  labels.share << 0.9F, 0.4F, 0, 0, 0.9F;
  Grid<std::uint32_t> apart(1, 5), joined(1, 5);
  apart << 1, 0, 0, 0, 2;
  joined << 3, 0, 0, 0, 3;
  EXPECT_TRUE((instance_image(labels) == apart).all());
  EXPECT_TRUE((instance_image(labels, number_instances({{4, 3}})) == joined).all());
}
