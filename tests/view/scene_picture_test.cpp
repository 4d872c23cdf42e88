// SPDX-License-Identifier: BSD-3-Clause
#include "support/test.hpp"
#include "view/scene_colours_internal.hpp"
#include "view/scene_samples.hpp"
#include "view/show_scene.hpp"
#include "view/test_pictures.hpp"

namespace {

class ShowScene : public JetPictureTest {
 protected:
  ShowScene() { options.width = 700, options.height = 520, options.title = "Test", options.min_db = 50; }
  ReadPicture show(const SceneCloud& scene, const SceneLook& look) {
    show_scene(scene, look, options, path);
    return read_png(path);
  }
  Rgb colour_of(float level_db) const {
    return colour_scale(Grid<float>::Zero(1, 1), options, "test").colour(level_db);
  }
  Blob find(const ReadPicture& picture, const Rgb& colour) const {
    return find_colour(picture, colour, 0, 0.82 * picture.width, 0, picture.height);  // left of the colour bar
  }
};

// Three spheres of three levels: near on port, on starboard, and above; seen from a head at `world_from_head`.
struct ThreeSpheres {
  explicit ThreeSpheres(const Pose& world_from_head, const Eigen::Vector3d& origin = Eigen::Vector3d::Zero()) {
    scene.origin = origin;
    const Eigen::Vector3d positions[] = {{6, 3, 0}, {9, -3, 0}, {8, 0, 3}};
    for (const Eigen::Vector3d& position : positions) add_sphere(scene, world_from_head * position, 0.5, 3000);
    look.colour = SceneColour::level;
    for (const float level : {port_db, starboard_db, above_db}) look.level_db.insert(look.level_db.end(), 3000, level);
    look.head = head_at(world_from_head);
    look.axes = false;
  }
  static constexpr float port_db = 63, starboard_db = 76, above_db = 89;
  SceneCloud scene;
  SceneLook look;
};

std::string message_of(const SceneCloud& scene, const SceneLook& look, ErrorKind kind, const std::string& path) {
  return error_of([&] { show_scene(scene, look, {}, path); }, kind);
}

}  // namespace

TEST_F(ShowScene, from_behind_the_head_has_port_on_the_left_and_up_above) {
  for (const double yaw_deg : {0.0, 90.0, 200.0}) {
    const ThreeSpheres spheres(pose_from_yaw_pitch_roll({3, -4, -2}, radians(yaw_deg), 0, 0));
    const ReadPicture picture = show(spheres.scene, spheres.look);
    const Blob port = find(picture, colour_of(ThreeSpheres::port_db));
    const Blob starboard = find(picture, colour_of(ThreeSpheres::starboard_db));
    const Blob above = find(picture, colour_of(ThreeSpheres::above_db));
    for (const Blob& blob : {port, starboard, above}) ASSERT_GT(blob.pixels, 100) << yaw_deg;
    EXPECT_LT(port.x + 50, above.x) << yaw_deg;
    EXPECT_LT(above.x + 50, starboard.x) << yaw_deg;
    EXPECT_GT(above.y, port.y + 50) << yaw_deg;
    EXPECT_GT(above.y, starboard.y + 50) << yaw_deg;
    EXPECT_GT(port.pixels, starboard.pixels) << "the nearer one is larger";
  }
}

TEST_F(ShowScene, from_above_has_x_to_the_right_and_y_up) {
  ThreeSpheres spheres(Pose::Identity());
  spheres.look.camera = ScenePreset::top;
  const ReadPicture picture = show(spheres.scene, spheres.look);
  const Blob port = find(picture, colour_of(ThreeSpheres::port_db));
  const Blob starboard = find(picture, colour_of(ThreeSpheres::starboard_db));
  EXPECT_GT(port.y, starboard.y + 50);
  EXPECT_LT(port.x + 20, starboard.x);
}

TEST_F(ShowScene, from_the_side_is_seen_from_starboard_with_ahead_to_the_right) {
  ThreeSpheres spheres(Pose::Identity());
  spheres.look.camera = ScenePreset::side;
  const ReadPicture picture = show(spheres.scene, spheres.look);
  const Blob port = find(picture, colour_of(ThreeSpheres::port_db));
  const Blob starboard = find(picture, colour_of(ThreeSpheres::starboard_db));  // 3 m farther ahead
  EXPECT_LT(port.x + 20, starboard.x);
  EXPECT_GT(starboard.pixels, port.pixels) << "the nearer one is larger";
}

TEST_F(ShowScene, looks_the_same_in_utm_coordinates) {
  const Eigen::Vector3d far(500000, 5000000, 100);
  const Pose here = pose_from_yaw_pitch_roll({3, -4, -2}, 0.5, 0.25, 0);
  Pose there = here;
  there.pretranslate(far);
  const ThreeSpheres near_zero(here), in_utm(there, far);
  show_scene(near_zero.scene, near_zero.look, options, path);
  const std::string first = file_bytes(path);
  show_scene(in_utm.scene, in_utm.look, options, path);
  // The rounding of large coordinates, millimetres, may change a pixel at an edge.
  const ReadPicture a = read_png(path);
  show_scene(near_zero.scene, near_zero.look, options, path);
  const ReadPicture b = read_png(path);
  std::size_t different = 0;
  for (std::size_t i = 0; i < a.bytes.size(); ++i) different += a.bytes[i] != b.bytes[i];
  EXPECT_LT(different, a.bytes.size() / 2000);
  EXPECT_EQ(first, file_bytes(path));
}

TEST_F(ShowScene, is_the_same_bytes_every_time) {
  SceneCloud scene;
  add_floor(scene, {0, -10, -3}, 200, 0.1);
  SceneLook look;
  look.head = head_at(pose_from_yaw_pitch_roll({0, 0, 0}, 0, 0.3, 0));
  look.most_surfels = 15000;  // thinned
  show_scene(scene, look, options, path);
  const std::string first = file_bytes(path);
  show_scene(scene, look, options, path);
  EXPECT_GT(first.size(), 10000u);
  EXPECT_TRUE(first == file_bytes(path));
}

TEST_F(ShowScene, shows_every_level_in_the_colour_of_the_bar) {
  SceneCloud scene;
  add_floor(scene, {0, 0, 0}, 10, 1);
  SceneLook look;
  look.colour = SceneColour::level;
  look.camera = ScenePreset::top;
  for (std::size_t i = 0; i < scene.size(); ++i) look.level_db.push_back(50.25F + 0.5F * static_cast<float>(i));
  const ReadPicture picture = show(scene, look);
  for (const float level : look.level_db) EXPECT_GT(find(picture, colour_of(level)).pixels, 20) << level;
}

TEST_F(ShowScene, draws_surfels_without_level_grey) {
  SceneCloud scene;
  add_floor(scene, {0, 0, 0}, 10, 1);
  SceneLook look;
  look.colour = SceneColour::level;
  look.camera = ScenePreset::top;
  look.level_db.assign(scene.size(), std::numeric_limits<float>::quiet_NaN());
  look.level_db[55] = 80;
  const ReadPicture picture = show(scene, look);
  const Rgb middle = picture.at(0.42 * picture.width, 0.3 * picture.height);
  EXPECT_NEAR(middle[0], middle[1], 4);
  EXPECT_NEAR(middle[1], middle[2], 8);
  EXPECT_LT(middle[0], 200);
  EXPECT_GT(find(picture, colour_of(80)).pixels, 20);
}

TEST_F(ShowScene, covers_a_plate_without_gaps_thinned_or_not) {
  SceneCloud scene;
  add_floor(scene, {-5, -5, 0}, 100, 0.1);
  SceneLook look;
  look.colour = SceneColour::level;
  look.level_db.assign(scene.size(), 80);
  look.camera = ScenePreset::top;
  look.axes = false;
  for (const std::size_t most : {std::size_t{0}, std::size_t{5000}}) {
    look.most_surfels = most;
    const ReadPicture picture = show(scene, look);
    const Blob plate = find(picture, colour_of(80));
    int holes = 0;
    for (int x = -100; x <= 100; ++x)
      for (int y = -100; y <= 100; ++y)
        holes += colour_difference(picture.at(plate.x + x, plate.y + y), colour_of(80)) > 2;
    EXPECT_LT(holes, most == 0 ? 1 : 7000) << most;  // a random subset leaves exp(-1.96) = 14 % uncovered
  }
}

TEST_F(ShowScene, shows_soundings_in_the_colour_of_their_level) {
  SceneCloud scene;
  add_floor(scene, {0, -5, 0}, 50, 0.2);
  SceneLook look;
  look.colour = SceneColour::level;
  look.camera = ScenePreset::top;
  for (int i = 0; i < 5; ++i) {
    look.soundings.position.push_back({2.0 + i, 0.0, 0.0});
    look.soundings.level_db.push_back(72);
  }
  EXPECT_GT(find(show(scene, look), colour_of(72)).pixels, 15);  // at least five marks of 2 x 2 full pixels
  look.soundings = {};
  EXPECT_EQ(find(show(scene, look), colour_of(72)).pixels, 0);
}

TEST_F(ShowScene, shows_highlighted_surfels_through_what_is_before_them) {
  SceneCloud scene;
  add_floor(scene, {0, 0, 0}, 40, 0.25);
  add_surfel(scene, {5.0, 5.0, -2.0}, {0, 0, 1}, 0.04);  // under the floor
  SceneLook look;
  look.camera = ScenePreset::top;
  const Rgb magenta = {245, 13, 158};
  EXPECT_EQ(find(show(scene, look), magenta).pixels, 0);
  look.highlighted = {static_cast<std::uint32_t>(scene.size() - 1)};
  EXPECT_GT(find(show(scene, look), magenta).pixels, 10);
}

TEST_F(ShowScene, keeps_its_texts_off_the_borders) {
  SceneCloud scene;
  add_sphere(scene, {500000, 5000000, -20}, 4, 20000);
  options.title = "A title that is long enough to fill a picture of this width from one side to the other side";
  for (const auto& [width, height] : {std::pair{1400, 1050}, std::pair{600, 400}, std::pair{300, 500}}) {
    options.width = width, options.height = height;
    const ReadPicture picture = show(scene, {});
    ASSERT_EQ(picture.width, width);
    ASSERT_EQ(picture.height, height);
    int touched = 0;
    for (int x = 0; x < width; ++x) touched += picture.at(x, 0)[0] < 255 || picture.at(x, height - 1)[0] < 255;
    for (int y = 0; y < height; ++y) touched += picture.at(0, y)[0] < 255 || picture.at(width - 1, y)[0] < 255;
    EXPECT_EQ(touched, 0) << width;
  }
}

TEST_F(ShowScene, has_a_dark_theme_and_prints_nothing) {
  SceneCloud scene;
  add_sphere(scene, {0, 0, 0}, 1, 1000);
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  options.dark = true;
  EXPECT_LT(show(scene, {}).at(2, 2)[0], 40);
  options.dark = false;
  EXPECT_EQ(show(scene, {}).at(2, 2)[0], 255);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
}

TEST_F(ShowScene, draws_fans_of_every_kind) {
  SceneCloud scene;
  add_floor(scene, {-15, -15, -3}, 150, 0.2);
  SceneLook look;
  look.head = head_at(Pose::Identity(), 360, 12);
  EXPECT_NO_THROW(show(scene, look)) << "whole circle";
  look.head = head_at(Pose::Identity(), 120, 12);
  for (double& azimuth : look.head->fan.azimuth) azimuth = std::remainder(azimuth + pi, 2 * pi);
  EXPECT_NO_THROW(show(scene, look)) << "over the stern";
  look.head->fan.azimuth = {-0.2, 0, 0.2, -0.2, 0, 0.2};
  look.head->fan.elevation = {-0.3, -0.3, -0.3, 0.1, 0.1, 0.1};
  EXPECT_NO_THROW(show(scene, look)) << "two rows";
  look.head = head_at(pose_from_yaw_pitch_roll({0, 0, 0}, 0, pi / 2, 0));
  EXPECT_NO_THROW(show(scene, look)) << "straight down";
}

TEST_F(ShowScene, draws_a_scene_of_one_surfel) {
  SceneCloud scene;
  add_surfel(scene, {1, 2, 3}, {0, 0, 1}, 0);
  EXPECT_NO_THROW(show(scene, {}));
}

TEST_F(ShowScene, refuses_what_it_cannot_draw) {
  SceneCloud scene;
  EXPECT_THAT(message_of(scene, {}, ErrorKind::content, path), HasSubstr("scene has no surfels"));
  add_sphere(scene, {0, 0, 0}, 1, 10);
  SceneLook look;
  look.colour = SceneColour::visibility;
  EXPECT_THAT(message_of(scene, look, ErrorKind::argument, path), HasSubstr("look.visibility is empty"));
  look.colour = SceneColour::grazing;
  EXPECT_THAT(message_of(scene, look, ErrorKind::argument, path), HasSubstr("look.head is absent"));
  look = {};
  look.level_db = {1, 2};
  EXPECT_THAT(message_of(scene, look, ErrorKind::argument, path),
              HasSubstr("level_db has 2 entries, must have none or 10"));
  look = {};
  look.highlighted = {10};
  EXPECT_THAT(message_of(scene, look, ErrorKind::argument, path), HasSubstr("surfel 10, must be below 10"));
  look = {};
  look.point_size = 0;
  EXPECT_THAT(message_of(scene, look, ErrorKind::argument, path), HasSubstr("point_size = 0"));
  EXPECT_FALSE(file_exists(path));
}
