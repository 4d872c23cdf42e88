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
  EXPECT_TRUE((connected_parts(three_parts_of_two(), 1) == expected).all());
  const Grid<std::uint32_t> large = connected_parts(three_parts_of_two(), 2);
  EXPECT_EQ(large.maxCoeff(), 3U);
  EXPECT_EQ(large(3, 4), 0U);
  EXPECT_EQ(large(3, 0), 3U);
}

TEST(LabelObjects, keys_are_numbered_in_their_order) {
  const Grid<std::uint32_t> number = numbered_keys(three_parts_of_two() * 100, 1);
  EXPECT_EQ(number(0, 1), 1U);
  EXPECT_EQ(number(3, 4), 1U);
  EXPECT_EQ(number(0, 4), 2U);
  EXPECT_EQ(numbered_keys(three_parts_of_two(), 3).maxCoeff(), 1U);  // key 3 has two pixels
}

TEST(LabelObjects, instances_of_the_scene_come_before_connected_parts) {
  Grid<std::uint32_t> id(4, 5);  // surfels 10 and 11 are of instance 0, 12 of instance 7
  id << 0, 10, 12, 0, 12,        //
      0, 11, 0, 99, 0,           //
      0, 0, 0, 0, 0,             //
      10, 99, 0, 0, 98;
  Grid<std::uint32_t> expected(4, 5);
  expected << 0, 1, 2, 0, 3,  // instance 7 is of two kinds, and so two objects
      0, 1, 0, 4, 0,          //
      0, 0, 0, 0, 0,          //
      1, 5, 0, 0, 6;
  EXPECT_TRUE((number_objects(three_parts_of_two(), id, {{10, 0}, {11, 0}, {12, 7}}) == expected).all());
  EXPECT_TRUE((number_objects(three_parts_of_two(), id, {}) == connected_parts(three_parts_of_two(), 1)).all());
  expect_error(ErrorKind::argument, {"number_objects", "one size"},
               [] { number_objects(three_parts_of_two(), Grid<std::uint32_t>::Zero(5, 4), {}); });
}

TEST(LabelObjects, shadow_and_weak_labels_are_of_no_object) {
  PixelLabels labels;
  labels.material.resize(1, 5), labels.id.resize(1, 5), labels.share.resize(1, 5);
  labels.material << 0, 0, PixelLabels::shadow, PixelLabels::nothing, 0;
  labels.id << 4, 5, PixelLabels::no_id, PixelLabels::no_id, 4;
  labels.share << 0.9F, 0.4F, 0, 0, 0.9F;
  Grid<std::uint32_t> apart(1, 5), joined(1, 5);
  apart << 1, 0, 0, 0, 2;
  joined << 1, 0, 0, 0, 1;
  EXPECT_TRUE((instance_image(labels) == apart).all());
  EXPECT_TRUE((instance_image(labels, {{4, 3}}) == joined).all());
}
