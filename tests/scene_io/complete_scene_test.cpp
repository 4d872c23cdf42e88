// SPDX-License-Identifier: BSD-3-Clause
#include "core/random.hpp"
#include "scene_io/test_files.hpp"
#include "support/test.hpp"

namespace {

/// Returns points on a sphere of radius 2 about (10, 0, 0), evenly spaced by the golden angle.
std::string sphere_text(int count) {
  std::ostringstream text;
  for (int i = 0; i < count; ++i) {
    const double z = 1 - (2 * i + 1.0) / count, r = std::sqrt(1 - z * z), a = 2.399963229728653 * i;
    text << 10 + 2 * r * std::cos(a) << ' ' << 2 * r * std::sin(a) << ' ' << 2 * z << '\n';
  }
  return text.str();
}

TEST(CompleteScene, everything_dropped_is_counted) {
  const std::string plate = plate_text(6, 0.5);
  const LoadedScene loaded = load_scene(own_file("a.xyz", plate + "nan 0 0\n0 0 inf\n1e30 0 0\n0.5 0.5 0\n-0.0 0 0\n"));
  EXPECT_EQ(loaded.report.points_read, 41u);
  EXPECT_EQ(loaded.report.dropped_not_finite, 3u);
  EXPECT_EQ(loaded.report.dropped_duplicates, 2u);
  EXPECT_EQ(loaded.scene.size(), 36u);
  EXPECT_TRUE(loaded.report.normals_estimated);
  EXPECT_TRUE(loaded.report.areas_estimated);
}

TEST(CompleteScene, ids_are_row_numbers_so_that_a_dropped_point_renumbers_no_other) {
  const LoadedScene loaded = load_scene(own_file("a.xyz", "nan 0 0\n" + plate_text(3, 0.5)));
  ASSERT_EQ(loaded.scene.size(), 9u);
  for (std::size_t i = 0; i < 9; ++i) EXPECT_EQ(loaded.scene.id[i], i + 1);
}

TEST(CompleteScene, ids_that_are_not_unique_are_renumbered_with_a_note) {
  const LoadedScene loaded = load_scene(own_file("a.csv", "x,y,z,id\n0,0,0,5\n1,0,0,5\n0,1,0,6\n1,1,0,7\n"));
  EXPECT_EQ(loaded.scene.id, (std::vector<std::uint32_t>{0, 1, 2, 3}));
  EXPECT_TRUE(has_note(loaded.report, "ids in the file are not unique"));
}

TEST(CompleteScene, estimated_normals_look_at_the_viewpoint_and_lie_within_two_degrees_on_a_sphere) {
  LoadOptions options;
  options.viewpoint = Eigen::Vector3d(10, 0, 0);  // the centre: all normals point inwards
  const LoadedScene loaded = load_scene(own_file("a.xyz", sphere_text(5000)), options);
  ASSERT_EQ(loaded.scene.size(), 5000u);
  EXPECT_TRUE(loaded.scene.normals_oriented);
  EXPECT_EQ(*loaded.report.viewpoint, *options.viewpoint);
  for (std::size_t i = 0; i < loaded.scene.size(); ++i) {
    const Eigen::Vector3d inward = (*options.viewpoint - world(loaded.scene, i)).normalized();
    EXPECT_GT(loaded.scene.normal[i].cast<double>().dot(inward), std::cos(0.035));
  }
  EXPECT_NEAR(total_area(loaded.scene), 16 * M_PI, 0.03 * 16 * M_PI);
}

TEST(CompleteScene, without_a_viewpoint_normals_have_no_sides_and_a_note_says_so) {
  const LoadedScene loaded = load_scene(own_file("a.xyz", sphere_text(500)));
  EXPECT_FALSE(loaded.scene.normals_oriented);
  EXPECT_FALSE(loaded.report.viewpoint.has_value());
  EXPECT_TRUE(has_note(loaded.report, "both sides of every surface reflect"));
}

std::string pcd_text(const std::string& viewpoint, const std::string& rows, int count) {
  return "# .PCD v0.7\nVERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH " + std::to_string(count) +
         "\nHEIGHT 1\nVIEWPOINT " + viewpoint + "\nPOINTS " + std::to_string(count) + "\nDATA ascii\n" + rows;
}

TEST(CompleteScene, the_viewpoint_of_a_pcd_orients_normals_and_turns_no_point) {
  const std::string rows = plate_text(5, 0.5, 0, 0, 3);
  const LoadedScene turned = load_scene(own_file("a.pcd", pcd_text("0 0 0 0 1 0 0", rows, 25)));
  EXPECT_TRUE(turned.scene.normals_oriented);
  EXPECT_EQ(*turned.report.viewpoint, Eigen::Vector3d::Zero());
  for (const auto& n : turned.scene.normal) EXPECT_LT(n.z(), -0.999f);  // the plate z = 3 seen from 0
  EXPECT_EQ(world(turned.scene, 24), Eigen::Vector3d(2, 2, 3));
  const LoadedScene above = load_scene(own_file("b.pcd", pcd_text("0 0 5 1 0 0 0", rows, 25)));
  for (const auto& n : above.scene.normal) EXPECT_GT(n.z(), 0.999f);
  // The identity pose is what writers put when they know nothing: then a raster of heights looks up.
  const LoadedScene unknown = load_scene(own_file("c.pcd", pcd_text("0 0 0 1 0 0 0", rows, 25)));
  EXPECT_FALSE(unknown.report.viewpoint);
  for (const auto& n : unknown.scene.normal) EXPECT_GT(n.z(), 0.999f);
  // The caller's word counts more than the file's.
  LoadOptions options;
  options.viewpoint = Eigen::Vector3d(0, 0, 9);
  for (const auto& n : load_scene(own_file("d.pcd", pcd_text("0 0 0 0 1 0 0", rows, 25)), options).scene.normal) {
    EXPECT_GT(n.z(), 0.999f);
  }
}

TEST(CompleteScene, zero_and_nan_normals_are_repaired_to_agree_with_their_neighbours) {
  std::string text = "x y z nx ny nz\n";
  for (int i = 0; i < 64; ++i) {
    text += std::to_string(i / 8) + " " + std::to_string(i % 8) + " 0 ";
    text += i == 20 ? "0 0 0\n" : i == 43 ? "nan 0 1\n" : "0 0 -1\n";
  }
  const LoadedScene loaded = load_scene(own_file("a.txt", text));
  EXPECT_EQ(loaded.report.repaired_normals, 2u);
  EXPECT_FALSE(loaded.report.normals_estimated);
  EXPECT_TRUE(loaded.scene.normals_oriented);
  for (const auto& n : loaded.scene.normal) EXPECT_LT(n.z(), -0.999f);
}

TEST(CompleteScene, all_normals_zero_is_the_same_as_none) {
  const LoadedScene loaded =
      load_scene(own_file("a.csv", "x,y,z,nx,ny,nz\n0,0,0,0,0,0\n1,0,0,0,0,0\n0,1,0,0,0,0\n1,1,0,0,0,0\n"));
  EXPECT_TRUE(loaded.report.normals_estimated);
  EXPECT_TRUE(has_note(loaded.report, "zero or NaN"));
}

TEST(CompleteScene, normals_of_another_length_are_scaled_to_one) {
  const LoadedScene loaded =
      load_scene(own_file("a.csv", "x,y,z,nx,ny,nz\n0,0,0,0,0,5\n1,0,0,0,3,4\n0,1,0,0,0,1\n1,1,0,0,0,1\n"));
  EXPECT_LT((loaded.scene.normal[1] - Eigen::Vector3f(0, 0.6f, 0.8f)).norm(), 1e-6f);
  EXPECT_TRUE(has_note(loaded.report, "2 of 4 normals (50 %) were not unit vectors"));
}

TEST(CompleteScene, file_normals_that_look_away_from_the_viewpoint_are_noted) {
  LoadOptions options;
  options.viewpoint = Eigen::Vector3d(0, 0, -5);
  const std::string path = own_file("a.csv", "x,y,z,nx,ny,nz\n0,0,0,0,0,1\n1,0,0,0,0,1\n0,1,0,0,0,1\n1,1,0,0,0,1\n");
  EXPECT_TRUE(has_note(load_scene(path, options).report, "look away from the viewpoint"));
  EXPECT_FALSE(has_note(load_scene(path).report, "look away"));
}

TEST(CompleteScene, moving_a_cloud_by_whole_metres_changes_the_origin_alone) {
  // Multiples of 1/64 are exact in double even at a UTM northing.
  const LoadedScene near = load_scene(own_file("a.xyz", plate_text(8, 0.171875, 0.015625, 0.25)));
  const LoadedScene far = load_scene(own_file("b.xyz", plate_text(8, 0.171875, 500000.015625, 4600000.25)));
  EXPECT_EQ(far.scene.origin - near.scene.origin, Eigen::Vector3d(500000, 4600000, 0));
  EXPECT_EQ(far.scene.point, near.scene.point);
  EXPECT_EQ(far.scene.normal, near.scene.normal);
  EXPECT_EQ(far.scene.area, near.scene.area);
}

TEST(CompleteScene, unit_scales_coordinates_and_areas) {
  LoadOptions options;
  options.meaning.unit = 0.001;
  const LoadedScene loaded =
      load_scene(own_file("a.csv", "x,y,z,area\n0,0,0,250000\n1000,0,0,250000\n0,500,0,1e6\n1000,500,0,0\n"), options);
  EXPECT_LT((world(loaded.scene, 3) - Eigen::Vector3d(1, 0.5, 0)).norm(), 1e-7);
  EXPECT_FLOAT_EQ(loaded.scene.area[0], 0.25f);
  EXPECT_FLOAT_EQ(loaded.scene.area[2], 1.0f);
  EXPECT_EQ(loaded.scene.area[3], 0.0f);
}

TEST(CompleteScene, unusable_areas_are_estimated) {
  std::string text = "x y z nx ny nz area\n";
  for (int i = 0; i < 100; ++i)
    text += std::to_string(i / 10) + " " + std::to_string(i % 10) + " 0 0 0 1 " + (i == 44 ? "-1\n" : "0.5\n");
  const LoadedScene loaded = load_scene(own_file("a.txt", text));
  EXPECT_NEAR(loaded.scene.area[44], 1.0f, 1e-4f);  // the Voronoi cell of a unit grid
  EXPECT_EQ(loaded.scene.area[43], 0.5f);
  EXPECT_TRUE(has_note(loaded.report, "1 of 100 areas"));
}

namespace {

// Returns a grid of 10 x 10 points, 1 m apart, with areas of 0.5 m^2 but for `areas`.
std::string grid_with_areas(const std::string& all, int changed = -1, const std::string& other = "") {
  std::string text = "x y z nx ny nz area\n";
  for (int i = 0; i < 100; ++i)
    text += std::to_string(i / 10) + " " + std::to_string(i % 10) + " 0 0 0 1 " + (i == changed ? other : all) + "\n";
  return text;
}

}  // namespace

TEST(CompleteScene, areas_larger_than_the_cloud_are_estimated) {
  for (const char* huge : {"1e30", "inf", "400"}) {
    const LoadedScene loaded = load_scene(own_file("huge.txt", grid_with_areas("0.5", 44, huge)));
    EXPECT_NEAR(loaded.scene.area[44], 1.0f, 1e-4f) << huge;
    EXPECT_TRUE(has_note(loaded.report, "1 of 100 areas (1 %) were negative, NaN or larger than the cloud")) << huge;
  }
  EXPECT_EQ(load_scene(own_file("large.txt", grid_with_areas("0.5", 44, "300"))).scene.area[44], 300.0f);
}

TEST(CompleteScene, a_scene_without_area_is_noted) {
  EXPECT_TRUE(has_note(load_scene(own_file("zero.txt", grid_with_areas("0"))).report, "nothing returns an echo"));
  EXPECT_FALSE(has_note(load_scene(own_file("some.txt", grid_with_areas("0", 7, "1"))).report, "nothing returns"));
}

TEST(CompleteScene, strays_keep_their_areas_if_asked_to) {
  std::string text = plate_text(30, 0.02);
  for (int k = 0; k < 4; ++k) text += std::to_string(0.1 * k) + " 0.3 " + std::to_string(2 + 0.5 * k) + "\n";
  const std::string path = own_file("strays.xyz", text);
  LoadOptions options;
  const LoadedScene cut = load_scene(path, options);
  options.keep_strays = true;
  const LoadedScene kept = load_scene(path, options);
  EXPECT_GT(cut.report.strays, 0U);
  EXPECT_EQ(kept.report.strays, cut.report.strays);
  EXPECT_TRUE(has_note(cut.report, "their areas are those of their neighbours"));
  EXPECT_TRUE(has_note(kept.report, "kept with areas as large as their cells"));
  const auto largest = [](const LoadedScene& s) { return *std::max_element(s.scene.area.begin(), s.scene.area.end()); };
  EXPECT_GT(largest(kept), 16 * largest(cut));
}

TEST(Doubts, a_scan_in_millimetres_is_suspected_and_one_in_metres_is_not) {
  // A 4 x 4 x 3 m room corner, 20 mm between its points.
  const auto corner = [](double unit) {
    std::ostringstream text;
    for (int i = 0; i < 200; ++i) {
      for (int j = 0; j < 200; ++j) text << i * 20 * unit << ' ' << j * 20 * unit << " 0\n";
      for (int j = 1; j < 150; ++j) text << i * 20 * unit << " 0 " << j * 20 * unit << '\n';
    }
    return text.str();
  };
  EXPECT_TRUE(has_note(load_scene(own_file("a.xyz", corner(1))).report, "looks like millimetres"));
  LoadOptions options;
  options.meaning.unit = 0.001;
  EXPECT_FALSE(has_note(load_scene(own_file("b.xyz", corner(1)), options).report, "millimetres"));
  EXPECT_FALSE(has_note(load_scene(own_file("c.xyz", corner(0.001))).report, "millimetres"));
  // A bathymetric grid of 1 km with 10 m spacing is coarse, not wrong.
  const LoadedScene survey = load_scene(own_file("d.xyz", plate_text(100, 10)));
  EXPECT_TRUE(has_note(survey.report, "a coarse survey?"));
}

TEST(Doubts, what_float32_rounds_away_is_said) {
  const std::string plate = plate_text(10, 1, 500000, 4600000);
  std::string bytes =
      "ply\nformat binary_little_endian 1.0\nelement vertex 100\nproperty float x\nproperty float "
      "y\nproperty float z\nend_header\n";
  for (int i = 0; i < 100; ++i)
    bytes += bytes_of(500000.f + static_cast<float>(i / 10)) + bytes_of(4600000.f + static_cast<float>(i % 10)) +
             bytes_of(0.f);
  const LoadedScene loaded = load_scene(own_file("a.ply", bytes));
  EXPECT_TRUE(has_note(loaded.report, "stored as float32, in steps of 500 mm"));  // 2^(22-23) m
  EXPECT_FALSE(has_note(load_scene(own_file("b.xyz", plate)).report, "float32"));
}

TEST(CompleteScene, the_same_bytes_for_1_2_and_7_threads) {
  const std::string path = own_file("a.xyz", sphere_text(3000));
  LoadOptions options;
  options.viewpoint = Eigen::Vector3d(0, 0, 0);
  options.threads = 1;
  const LoadedScene one = load_scene(path, options);
  for (const int threads : {2, 7}) {
    options.threads = threads;
    const LoadedScene many = load_scene(path, options);
    EXPECT_EQ(many.scene.point, one.scene.point);
    EXPECT_EQ(many.scene.normal, one.scene.normal);
    EXPECT_EQ(many.scene.area, one.scene.area);
  }
}

}  // namespace
