// SPDX-License-Identifier: BSD-3-Clause
// Depths from above: contours, relief, and a picture of both.
#include "view/show_depths.hpp"

#include "core/units.hpp"
#include "support/test.hpp"
#include "view/contours_internal.hpp"
#include "view/test_pictures.hpp"

namespace {

/// A cone with its top in the middle of n x n cells: height 0 there, and a fall of `slope` to a cell.
Grid<float> cone_of_cells(Eigen::Index n, double slope) {
  Grid<float> height(n, n);
  const double middle = 0.5 * static_cast<double>(n - 1);
  for (Eigen::Index x = 0; x < n; ++x)
    for (Eigen::Index y = 0; y < n; ++y)
      height(x, y) =
          static_cast<float>(-slope * std::hypot(static_cast<double>(x) - middle, static_cast<double>(y) - middle));
  return height;
}

class ShowDepths : public PictureTest {
 protected:
  /// Sets a slope of 10 m over 20 m along x, between 10 and 20 m deep, with a hole and two rejected soundings.
  ShowDepths() {
    map.x = 500000, map.y = 6000000, map.cell = 0.5;
    map.height.resize(40, 30);
    for (Eigen::Index x = 0; x < 40; ++x)
      map.height.row(x).setConstant(static_cast<float>(-10 - 0.25 * static_cast<double>(x)));
    map.height.block(5, 5, 3, 3).setConstant(std::numeric_limits<float>::quiet_NaN());
    map.rejected = {{500005, 6000010}, {500015, 6000010}};
    map.datum = "below MSL";
  }
  DepthMap map;
};

int count_near(const ReadPicture& picture, const Rgb& colour) {
  int count = 0;
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x) count += colour_difference(picture.at(x, y), colour) < 20;
  return count;
}

}  // namespace

TEST(Contours, of_a_cone_are_one_ring_at_its_radius) {
  const Grid<float> cone = cone_of_cells(41, 0.1);
  const std::vector<Contour> rings = contours_at(cone, -1.5);
  ASSERT_EQ(rings.size(), 1U);
  EXPECT_EQ(rings[0].front(), rings[0].back());
  EXPECT_GT(rings[0].size(), 80U);
  for (const Eigen::Vector2d& place : rings[0]) EXPECT_NEAR((place - Eigen::Vector2d(20, 20)).norm(), 15, 0.02);
  EXPECT_TRUE(contours_at(cone, 1).empty());
  // Beyond 20 cells the ring leaves the grid at four sides.
  EXPECT_EQ(contours_at(cone, -2.2).size(), 4U);
}

TEST(Contours, stop_at_cells_without_a_height_and_part_saddles_by_their_middle) {
  Grid<float> slope(9, 9);
  for (Eigen::Index x = 0; x < 9; ++x) slope.row(x).setConstant(static_cast<float>(x));
  ASSERT_EQ(contours_at(slope, 3.5).size(), 1U);
  slope(4, 4) = std::numeric_limits<float>::quiet_NaN();
  const std::vector<Contour> parted = contours_at(slope, 3.5);
  ASSERT_EQ(parted.size(), 2U);
  for (const Contour& part : parted) EXPECT_EQ(part.size(), 4U);
  Grid<float> saddle(2, 2);
  saddle << 1, 0, 0, 1;
  const std::vector<Contour> high = contours_at(saddle, 0.4), low = contours_at(saddle, 0.6);
  ASSERT_EQ(high.size(), 2U);
  ASSERT_EQ(low.size(), 2U);
  // The low corners are cut off if the middle is above the level, else the high ones.
  const auto sum_of = [](const Contour& part) { return (part.front() + part.back()).sum(); };
  EXPECT_NEAR(std::abs(sum_of(high[0]) - 2), 0, 1e-6);
  EXPECT_NEAR(std::abs(sum_of(low[0]) - 2), 1.2, 1e-6);
}

TEST(Contours, relief_is_bright_towards_the_upper_left) {
  Grid<float> slope(5, 5);
  const auto bright = [&](double dx, double dy, double exaggeration) {
    for (Eigen::Index x = 0; x < 5; ++x)
      for (Eigen::Index y = 0; y < 5; ++y)
        slope(x, y) = static_cast<float>(dx * static_cast<double>(x) + dy * static_cast<double>(y));
    return static_cast<double>(relief_of(slope, exaggeration)(2, 2));
  };
  EXPECT_NEAR(bright(0, 0, 5), 1, 1e-6);
  // A slope of 45 degrees that faces the light stands square to it; away from it light only grazes it.
  const double side = std::sqrt(0.5);
  EXPECT_NEAR(bright(side, -side, 1), std::sqrt(2.0), 1e-6);
  EXPECT_NEAR(bright(-side, side, 1), 0, 1e-6);
  EXPECT_NEAR(bright(side / 4, -side / 4, 4), std::sqrt(2.0), 1e-6);
}

TEST_F(ShowDepths, colours_depths_and_marks_rejected_soundings) {
  show_depths(map, options, path);
  const ReadPicture with = read_png(path);
  map.rejected.clear();
  show_depths(map, options, path);
  const ReadPicture without = read_png(path);
  const Rgb red = {230, 26, 26};
  EXPECT_GT(count_near(with, red), 20);
  EXPECT_EQ(count_near(without, red), 0);
  EXPECT_NE(with.at(with.width / 4, with.height / 2), with.at(with.width / 2, with.height / 2)) << "of other depth";
}

TEST_F(ShowDepths, refuses_a_map_without_heights) {
  map.height.setConstant(std::numeric_limits<float>::quiet_NaN());
  EXPECT_THAT(error_of([&] { show_depths(map, options, path); }), HasSubstr("no cell has a height"));
  map.height.setZero();
  map.cell = 0;
  EXPECT_THAT(error_of([&] { show_depths(map, options, path); }), HasSubstr("cell = 0 m, must be > 0"));
}
