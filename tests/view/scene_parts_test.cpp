// SPDX-License-Identifier: BSD-3-Clause
// Parts of a scene picture that do not need VTK.
#include "support/test.hpp"
#include "view/scene_camera_internal.hpp"
#include "view/scene_colours_internal.hpp"
#include "view/scene_lines_internal.hpp"
#include "view/scene_samples.hpp"
#include "view/scene_surfels_internal.hpp"

namespace {

SceneCloud floor_of(int side, double spacing, double z = -4) {
  SceneCloud scene;
  add_floor(scene, {-0.5 * side * spacing, -0.5 * side * spacing, z}, side, spacing);
  return scene;
}

bool grey(const Rgb& c) { return std::abs(c[0] - c[1]) < 8 && std::abs(c[1] - c[2]) < 8; }

}  // namespace

TEST(SceneColours, of_levels_are_those_of_the_table_and_grey_without_one) {
  const SceneCloud scene = floor_of(4, 1);
  SceneLook look;
  look.colour = SceneColour::level;
  look.level_db.assign(16, 60);
  look.level_db[3] = std::numeric_limits<float>::quiet_NaN();
  look.level_db[5] = -std::numeric_limits<float>::infinity();
  PictureOptions options;
  options.colour_map = "viridis";
  options.min_db = 50, options.max_db = 70;
  const SceneColours colours = colour_surfels(scene, look, options, "test");
  const ColourTable table = colour_table("viridis", "test");
  EXPECT_EQ(colours.colour[0], table[128]);  // the middle of the scale
  EXPECT_TRUE(grey(colours.colour[3]));
  EXPECT_EQ(colours.colour[5], table[0]);
  EXPECT_EQ(colours.key.unit, "dB re 1 µPa");
}

// A surfel 4 m below the head and d beside it is seen at an incidence of atan(d / 4).
TEST(SceneColours, of_angles_are_those_of_geometry) {
  const SceneCloud scene = floor_of(41, 0.5);
  SceneLook look;
  look.head = head_at(Pose::Identity());
  const ColourScale scale{colour_table("viridis", "test"), 0, 90};
  for (const bool grazing : {false, true}) {
    look.colour = grazing ? SceneColour::grazing : SceneColour::incidence;
    const SceneColours colours = colour_surfels(scene, look, {}, "test");
    for (std::size_t i = 0; i < scene.size(); i += 7) {
      const double beside = std::hypot(scene.point[i].x(), scene.point[i].y());
      const double incidence = degrees(std::atan(beside / 4)), shown = grazing ? 90 - incidence : incidence;
      const Rgb low = scale.colour(shown - 0.01), high = scale.colour(shown + 0.01);
      EXPECT_TRUE(colours.colour[i] == low || colours.colour[i] == high) << i;
    }
  }
  look.head = head_at(Pose(Eigen::Translation3d(0, 0, -9)));  // below the floor: all are back-facing
  EXPECT_TRUE(grey(colour_surfels(scene, look, {}, "test").colour[700]));
}

TEST(SceneColours, legends_name_what_is_there_and_nothing_else) {
  SceneCloud scene = floor_of(4, 1);
  scene.materials = {Material{"sand"}, Material{"rock"}, Material{"steel"}};
  scene.material[5] = 2;
  SceneLook look;
  look.colour = SceneColour::material;
  const SceneKey materials = colour_surfels(scene, look, {}, "test").key;
  ASSERT_EQ(materials.legend.size(), 2u);
  EXPECT_EQ(materials.legend[1].text, "steel");

  look.colour = SceneColour::visibility;
  look.visibility.assign(16, Visibility::outside);
  look.visibility[2] = Visibility::hidden;
  const SceneColours colours_by_visibility = colour_surfels(scene, look, {}, "test");
  ASSERT_EQ(colours_by_visibility.key.legend.size(), 2u);
  EXPECT_GT(colours_by_visibility.colour[2][2], 1.5 * colours_by_visibility.colour[2][0]) << "the shadow is blue";
  EXPECT_LT(colours_by_visibility.colour[2][0], 80) << "and dark";
}

TEST(SceneColours, of_heights_are_world_heights) {
  SceneCloud scene = floor_of(10, 1, 0);
  for (std::size_t i = 0; i < scene.size(); ++i) scene.point[i].z() = 0.1F * static_cast<float>(i % 10);
  scene.origin = {0, 0, 1000};
  const SceneColours colours = colour_surfels(scene, {}, {}, "test");
  const SceneKey& key = colours.key;
  EXPECT_NEAR(key.scale->min_db, 1000, 1e-6);
  EXPECT_NEAR(key.scale->max_db, 1000.9, 1e-6);
  EXPECT_NE(colours.colour[0], colours.colour[9]);
}

TEST(DrawnSurfels, are_chosen_by_id_whatever_the_order) {
  SceneCloud scene = floor_of(200, 0.1);
  const auto ids = [](const SceneCloud& cloud, const std::vector<std::uint32_t>& drawn) {
    std::vector<std::uint32_t> id;
    for (const std::uint32_t i : drawn) id.push_back(cloud.id[i]);
    std::sort(id.begin(), id.end());
    return id;
  };
  std::vector<std::uint32_t> turned(scene.size());
  for (std::size_t i = 0; i < turned.size(); ++i) turned[i] = static_cast<std::uint32_t>((i * 7919) % turned.size());
  const SceneCloud other = subset(scene, turned);
  const auto drawn = drawn_surfels(scene, 5000);
  EXPECT_NEAR(static_cast<double>(drawn.size()), 5000, 250);  // four standard deviations of a binomial draw
  EXPECT_EQ(ids(scene, drawn), ids(other, drawn_surfels(other, 5000)));
  EXPECT_EQ(drawn_surfels(scene, scene.size()).size(), scene.size());

  // Uniformity: each of 16 parts has 312 of 2500 within five standard deviations.
  std::array<int, 16> count{};
  for (const std::uint32_t i : drawn)
    ++count[static_cast<std::size_t>((scene.point[i].x() + 10) / 5) * 4 +
            static_cast<std::size_t>((scene.point[i].y() + 10) / 5)];
  for (const int c : count) EXPECT_NEAR(c, 312, 83);
}

TEST(SurfelSides, are_bounded_and_never_nothing) {
  SceneCloud scene = floor_of(10, 0.5);
  scene.area[3] = 0;
  scene.area[4] = 100;
  const std::vector<float> side = surfel_sides(scene);
  EXPECT_FLOAT_EQ(side[0], 0.5F);
  EXPECT_FLOAT_EQ(side[3], 0.5F);
  EXPECT_FLOAT_EQ(side[4], 1.25F);
}

TEST(SceneView, of_a_preset_holds_every_point_and_wastes_no_room) {
  SceneCloud scene;
  add_sphere(scene, {20, 5, -8}, 3, 2000);
  add_floor(scene, {10, -10, -12}, 40, 0.5);
  SceneLook look;
  look.head = head_at(pose_from_yaw_pitch_roll({0, 0, -5}, 0.3, 0.2, 0.1), 90, 40);
  const std::vector<Eigen::Vector3d> points = points_of_interest(scene, look);
  constexpr double width = 900, height = 600, margin = 40;
  for (const ScenePreset preset :
       {ScenePreset::automatic, ScenePreset::behind, ScenePreset::top, ScenePreset::side, ScenePreset::iso}) {
    const CameraView view = place_view(scene, look, preset, points, width, height, margin);
    Box box{1e9, -1e9, 1e9, -1e9};
    for (const Eigen::Vector3d& point : points) {
      const ShownPoint shown = show_point(view, point, width, height);
      ASSERT_GT(shown.distance, 0);
      box = {std::min(box.left, shown.at.x), std::max(box.right, shown.at.x), std::min(box.bottom, shown.at.y),
             std::max(box.top, shown.at.y)};
    }
    EXPECT_GT(box.left, margin - 0.01);
    EXPECT_LT(box.right, width - margin + 0.01);
    EXPECT_GT(box.bottom, margin - 0.01);
    EXPECT_LT(box.top, height - margin + 0.01);
    const bool fills_across = box.left < margin + 1 && box.right > width - margin - 1;
    const bool fills_upwards = box.bottom < margin + 1 && box.top > height - margin - 1;
    EXPECT_TRUE(fills_across || fills_upwards) << static_cast<int>(preset);
  }
}

// From behind at 30 degrees a flat scene leaves half of a square picture empty.
TEST(SceneView, automatic_looks_down_until_the_picture_is_filled) {
  SceneCloud scene;
  add_floor(scene, {0, -20, -5}, 40, 0.5);
  SceneLook look;
  look.head = head_at(Pose(Eigen::Translation3d(0, 0, -2)), 60, 30);
  const std::vector<Eigen::Vector3d> points = points_of_interest(scene, look);
  constexpr double side = 600, margin = 20;
  const auto height_of = [&](ScenePreset preset) {
    const CameraView view = place_view(scene, look, preset, points, side, side, margin);
    double low = 1e9, high = -1e9;
    for (const Eigen::Vector3d& point : points) {
      const double y = show_point(view, point, side, side).at.y;
      low = std::min(low, y), high = std::max(high, y);
    }
    return (high - low) / side;
  };
  EXPECT_LT(height_of(ScenePreset::behind), 0.55);
  EXPECT_GT(height_of(ScenePreset::automatic), 0.65);
}

// A playing picture stands still: its frame holds the whole way, wherever the head is on it.
TEST(SceneView, of_a_track_holds_the_way_and_keeps_its_frame) {
  SceneCloud scene;
  add_floor(scene, {0, -50, -5}, 100, 1);
  SceneLook look;
  for (double x = 10; x <= 60; x += 5) look.track.emplace_back(x, 10, -2);
  const auto seen_from = [&](double x) {
    look.head = head_at(Pose(Eigen::Translation3d(x, 10, -2)), 60, 10);
    return points_of_interest(scene, look);
  };
  const std::vector<Eigen::Vector3d> begin = seen_from(10), end = seen_from(60);
  EXPECT_EQ(begin, end);
  for (const double x : {10.0, 60.0})
    EXPECT_TRUE(std::any_of(begin.begin(), begin.end(), [&](const Eigen::Vector3d& p) {
      return (p + scene.origin - Eigen::Vector3d(x, 10, -2)).norm() < 1e-9;
    })) << x;
}

TEST(SceneView, shows_what_it_looks_at_in_the_middle) {
  const CameraView view{{0, 0, 10}, {3, 0, 0}, Eigen::Vector3d::UnitZ(), radians(30)};
  const ShownPoint middle = show_point(view, {3, 0, 0}, 100, 100);
  EXPECT_NEAR(middle.at.x, 50, 1e-9);
  EXPECT_NEAR(middle.at.y, 50, 1e-9);
}

TEST(FanSector, over_the_stern_is_one_piece) {
  SceneHead head = head_at(Pose::Identity(), 120);
  for (double& azimuth : head.fan.azimuth) azimuth = std::remainder(azimuth + pi, 2 * pi);
  const FanSector sector = fan_sector(head.fan);
  EXPECT_NEAR(degrees(sector.high_azimuth - sector.low_azimuth), 120, 1e-6);
  EXPECT_NEAR(std::abs(std::remainder((sector.high_azimuth + sector.low_azimuth) / 2, 2 * pi)), pi, 1e-9);
  EXPECT_FALSE(sector.full_circle);
  EXPECT_TRUE(fan_sector(head_at(Pose::Identity(), 360).fan).full_circle);
}

TEST(HeadLines, reach_from_the_first_range_to_the_last) {
  const Pose pose = pose_from_yaw_pitch_roll({10, 20, -3}, 1, 0.3, 0.2);
  const HeadLines lines = head_lines(head_at(pose), {5, 5, 0}, 0.1);
  const Eigen::Vector3d at = pose.translation() - Eigen::Vector3d(5, 5, 0);
  double nearest = 1e9, farthest = 0;
  for (const Polyline& line : lines.outline)
    for (const Eigen::Vector3d& position : line) {
      nearest = std::min(nearest, (position - at).norm());
      farthest = std::max(farthest, (position - at).norm());
    }
  EXPECT_NEAR(nearest, 1, 1e-9);
  EXPECT_NEAR(farthest, 15, 1e-9);
  // The y axis of the head points to port.
  EXPECT_NEAR((lines.axes[1][1] - lines.axes[1][0]).normalized().dot(pose.linear().col(1)), 1, 1e-9);
}

// The sector of a level fan 4 m above a floor: between the cones 10 degrees below (and above) the horizon, the sides at
// 45 degrees, and 15 m of range.
TEST(FootprintOutline, lies_where_the_walls_meet_the_floor) {
  const SceneCloud scene = floor_of(400, 0.1);
  const SceneHead head = head_at(pose_from_yaw_pitch_roll({0, 0, 0}, 0, radians(20), 0));
  const std::vector<std::uint32_t> outline = footprint_outline(scene, head);
  ASSERT_GT(outline.size(), 300u);
  const Eigen::Matrix3d turn = head.world_from_head.linear().transpose();
  for (const std::uint32_t i : outline) {
    const Eigen::Vector3d position = turn * scene.point[i].cast<double>();
    const Direction towards = direction_of(position);
    const double range = position.norm(), across = range * std::cos(towards.elevation);
    const double to_sides = std::abs(across * (std::abs(towards.azimuth) - radians(45)));
    const double to_cones = std::abs(range * (std::abs(towards.elevation) - radians(10)));
    const double to_end = std::abs(range - 15);
    EXPECT_LT(std::min({to_sides, to_cones, to_end}), 0.071);
    EXPECT_LT(std::abs(towards.azimuth), radians(46));
    EXPECT_LT(range, 15.1);
  }
}

TEST(FootprintOutline, of_a_fan_over_the_stern_is_that_of_a_head_turned_round) {
  const SceneCloud scene = floor_of(300, 0.1, -2);
  const SceneHead ahead = head_at(pose_from_yaw_pitch_roll({0.03, 0.02, 0}, 0.4, 0, 0));
  SceneHead astern = head_at(pose_from_yaw_pitch_roll({0.03, 0.02, 0}, 0.4 + pi, 0, 0));
  for (double& azimuth : astern.fan.azimuth) azimuth = std::remainder(azimuth + pi, 2 * pi);
  EXPECT_GT(footprint_outline(scene, ahead).size(), 10u);
  EXPECT_EQ(footprint_outline(scene, ahead), footprint_outline(scene, astern));
}

TEST(FootprintOutline, of_a_whole_circle_has_no_sides) {
  const SceneCloud scene = floor_of(200, 0.1);
  const SceneHead head = head_at(Pose(Eigen::Translation3d(0, 0, -3.2)), 360, 7);
  for (const std::uint32_t i : footprint_outline(scene, head)) {
    const double range = std::sqrt(scene.point[i].head<2>().squaredNorm() + 0.8F * 0.8F);
    EXPECT_TRUE(std::abs(range - 7) < 0.1 || std::abs(range - 0.8 / std::sin(radians(10))) < 0.6) << range;
  }
}

TEST(SceneAxes, are_labelled_in_world_metres) {
  const CameraView view{{-30, -40, 30}, {0, 0, 0}, Eigen::Vector3d::UnitZ(), 0.5};
  const Eigen::AlignedBox3d box(Eigen::Vector3d(-10, -12, -4), Eigen::Vector3d(10, 12, 4));
  const SceneAxes axes = lay_out_axes(box, {500000, 5000000, -20}, view);
  const auto has = [&](const std::string& text) {
    return std::any_of(axes.labels.begin(), axes.labels.end(), [&](const AxisLabel& l) { return l.text == text; });
  };
  for (const char* text : {"500000", "5000000", "-20", "x [m]", "y [m]", "z [m]"}) EXPECT_TRUE(has(text)) << text;
  for (const AxisLabel& label : axes.labels)
    if (label.text == "500000") {
      EXPECT_NEAR(label.position.x(), 0, 1e-6);
    }
}

TEST(SceneAxes, leave_out_the_one_that_the_camera_looks_along) {
  const Eigen::AlignedBox3d box(Eigen::Vector3d(-1, -1, -1), Eigen::Vector3d(1, 1, 1));
  const CameraView from_above{{0, 0, 10}, {0, 0, 0}, Eigen::Vector3d::UnitY(), 0.5};
  for (const AxisLabel& label : lay_out_axes(box, {0, 0, 0}, from_above).labels) EXPECT_NE(label.text, "z [m]");
}

// A side-scan looks to port and to starboard, not all round.
TEST(FootprintOutline, of_the_sides_of_a_side_scan_lies_athwart) {
  const SceneCloud scene = floor_of(400, 0.1);
  SceneHead head = head_at(Pose::Identity());
  head.fan.azimuth = {pi / 2, -pi / 2}, head.fan.elevation = {radians(-30), radians(-30)};
  head.fan.beam_width = radians(2), head.fan.elevation_width = radians(50);
  std::size_t to_port = 0, to_starboard = 0;
  for (const std::uint32_t i : footprint_outline(scene, head)) {
    const Eigen::Vector3f& at = scene.point[i];
    EXPECT_LT(std::abs(at.x()), std::abs(at.y()) * std::tan(radians(1)) + 0.15F) << at.transpose();
    ++(at.y() > 0 ? to_port : to_starboard);
  }
  EXPECT_GT(to_port, 50U);
  EXPECT_GT(to_starboard, 50U);
  for (const Polyline& line : head_lines(head, {0, 0, 0}, 0.1).outline)
    for (const Eigen::Vector3d& at : line) EXPECT_LT(std::abs(at.x()), 15 * std::sin(radians(1)) + 1e-6);
}
