// SPDX-License-Identifier: BSD-3-Clause
// Holes of the scan and normals in the picture of a scene.

#include "support/test.hpp"
#include "view/scene_samples.hpp"
#include "view/show_scene.hpp"
#include "view/test_pictures.hpp"

namespace {

class SceneMarks : public PictureTest {
 protected:
  SceneMarks() {
    scene.origin = {5e5, 4e6, 0};
    add_floor(scene, scene.origin + Eigen::Vector3d(-3, -3, 0), 60, 0.1);
    look.colour = SceneColour::visibility;
    look.visibility.assign(scene.size(), Visibility::outside);
    look.camera = ScenePreset::top;
    look.axes = false;
    options.width = 500, options.height = 400;
  }
  ReadPicture show() {
    show_scene(scene, look, options, path);
    return read_png(path);
  }
  Blob above_legend(const ReadPicture& picture, const Rgb& colour) const {
    return find_colour(picture, colour, 0, picture.width, 60, picture.height);
  }

  SceneCloud scene;
  SceneLook look;
  const Rgb red = {222, 45, 38};
};

TEST_F(SceneMarks, holes_are_red_where_they_are_and_named_below) {
  EXPECT_EQ(find_colour(show(), red, 0, 500, 0, 400).pixels, 0);
  look.holes = {scene.origin + Eigen::Vector3d(2, 0, 0.01)};  // to the right, seen from above
  const ReadPicture picture = show();
  const Blob hole = above_legend(picture, red);
  EXPECT_GT(hole.pixels, 4);
  EXPECT_GT(hole.x, 280);
  EXPECT_NEAR(hole.y, find_colour(picture, red, 0, 500, 60, 400).y, 1);
  EXPECT_GT(find_colour(picture, red, 0, 500, 0, 60).pixels, 20);  // its patch in the legend
}

TEST_F(SceneMarks, normals_are_lines_only_if_asked_for) {
  look.camera = ScenePreset::side;
  const ReadPicture without = show();
  look.normals = true;
  const ReadPicture with = show();
  int changed = 0;
  for (std::size_t i = 0; i < with.bytes.size(); ++i) changed += with.bytes[i] != without.bytes[i];
  EXPECT_GT(changed, 500);
  scene.normals_oriented = false;  // then they point both ways
  EXPECT_NE(show().bytes, with.bytes);
}

TEST_F(SceneMarks, the_way_of_the_head_is_a_line_where_it_went) {
  const ReadPicture without = show();
  // From above the middle of the floor 2 m to the right, a line to x = 2 lies right of the middle.
  look.track = {scene.origin + Eigen::Vector3d(0, 0, 1), scene.origin + Eigen::Vector3d(2, 0, 1)};
  const ReadPicture with = show();
  int left = 0, right = 0;
  for (int y = 0; y < with.height; ++y)
    for (int x = 0; x < with.width; ++x)
      if (colour_difference(with.at(x, y), without.at(x, y)) > 20) ++(x < with.width / 2 - 3 ? left : right);
  EXPECT_EQ(left, 0);
  EXPECT_GT(right, 60);
}

}  // namespace
