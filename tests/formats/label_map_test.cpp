// SPDX-License-Identifier: BSD-3-Clause
// Objects in pictures, checked by an independent decoder of run lengths.
#include "formats/label_map.hpp"

#include "support/test.hpp"

namespace {

// Returns two categories in four objects.
LabelMap four_objects() {
  LabelMap map{Grid<std::uint8_t>(4, 5), Grid<std::uint16_t>(4, 5)};
  map.category << 0, 2, 2, 0, 3, 0, 2, 0, 3, 0, 0, 0, 0, 0, 0, 2, 2, 0, 0, 2;
  map.instance << 0, 1, 1, 0, 2, 0, 1, 0, 2, 0, 0, 0, 0, 0, 0, 3, 3, 0, 0, 4;
  return map;
}

}  // namespace

TEST(LabelMap, annotations_hold_box_area_and_every_pixel) {
  const LabelMap map = four_objects();
  const std::vector<Annotation> annotations = annotations_of(map);
  ASSERT_EQ(annotations.size(), 4U);
  const Annotation& corner = annotations[1];
  EXPECT_EQ(corner.category, 3);
  EXPECT_EQ(corner.area, 2U);
  EXPECT_EQ(corner.left, 3);
  EXPECT_EQ(corner.top, 0);
  EXPECT_EQ(corner.width, 2);
  EXPECT_EQ(corner.height, 2);
  for (const Annotation& a : annotations) {  // down the columns, beginning with pixels that are not of it
    std::vector<bool> mask;
    for (std::size_t k = 0; k < a.counts.size(); ++k) mask.insert(mask.end(), a.counts[k], k % 2 == 1);
    ASSERT_EQ(mask.size(), 20U);
    for (Eigen::Index row = 0; row < 4; ++row)
      for (Eigen::Index column = 0; column < 5; ++column)
        EXPECT_EQ(mask[static_cast<std::size_t>(4 * column + row)], map.instance(row, column) == a.instance);
  }
}

TEST(LabelMap, empty_ones_have_no_annotations) {
  const LabelMap map{Grid<std::uint8_t>::Zero(4, 5), Grid<std::uint16_t>::Zero(4, 5)};
  EXPECT_TRUE(annotations_of(map).empty());
}

TEST(LabelMap, refuses_maps_that_do_not_fit) {
  expect_error(ErrorKind::argument, {"annotations_of", "one size"}, [] {
    annotations_of({Grid<std::uint8_t>::Zero(4, 5), Grid<std::uint16_t>::Zero(5, 4)});
  });
}

TEST(LabelMap, an_object_of_two_categories_is_one_of_the_category_of_most_pixels) {
  LabelMap map{Grid<std::uint8_t>::Constant(4, 5, 3), Grid<std::uint16_t>::Constant(4, 5, 9)};
  map.category.leftCols(2).setConstant(2);  // 8 of 20 pixels
  ASSERT_EQ(annotations_of(map).size(), 1U);
  EXPECT_EQ(annotations_of(map)[0].category, 3);
  EXPECT_EQ(annotations_of(map)[0].area, 20U);
  map.category.leftCols(3).setConstant(2);
  EXPECT_EQ(annotations_of(map)[0].category, 2);
}

TEST(LabelMap, outlines_follow_the_sides_of_pixels) {
  Grid<std::uint16_t> map(4, 6);
  map << 0, 7, 7, 0, 0, 0,  //
      0, 7, 7, 0, 0, 0,     //
      0, 0, 0, 7, 7, 7,     //
      0, 0, 0, 7, 7, 7;
  // Two parts that touch at a corner alone.
  EXPECT_EQ(outlines_of(map, 7), (std::vector<std::vector<int>>{{1, 0, 3, 0, 3, 2, 1, 2}, {3, 2, 6, 2, 6, 4, 3, 4}}));
  EXPECT_TRUE(outlines_of(map, 3).empty());
  map.setConstant(1);
  map.block(1, 1, 2, 3).setZero();  // a hole, which is left out
  EXPECT_EQ(outlines_of(map, 1), (std::vector<std::vector<int>>{{0, 0, 6, 0, 6, 4, 0, 4}}));
  // In any picture without holes the area within equals that of the pixels.
  for (int seed = 0; seed < 20; ++seed) {
    Grid<std::uint16_t> bars = Grid<std::uint16_t>::Zero(12, 17);
    int area = 0;
    for (Eigen::Index column = 0; column < 17; ++column) {
      const Eigen::Index height = (seed * 7 + column * column * 5) % 12;
      bars.col(column).tail(height).setConstant(2);
      area += static_cast<int>(height);
    }
    double found = 0;
    for (const std::vector<int>& line : outlines_of(bars, 2))
      for (std::size_t k = 0; k < line.size(); k += 2) {
        const std::size_t next = (k + 2) % line.size();
        found += 0.5 * (line[k] * line[next + 1] - line[next] * line[k + 1]);
      }
    EXPECT_EQ(found, area) << seed;
  }
}
