// Clouds as they come from files: holes, duplicates, degenerate triangles, far origins, other units; and pings of them.
#include "scene_io/describe_file.hpp"
#include "scene_io/load_scene.hpp"
#include "support/checked_ping.hpp"

namespace insonify::loaded_clouds {

/// Rows "x y z nx ny nz" of a plate at x = 5 + east that faces the head, 2 m square.
std::string plate_rows(int n, double east = 0, double north = 0) {
  std::ostringstream text;
  text.precision(12);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      text << 5 + east << ' ' << north - 1 + (i + 0.5) * 2 / n << ' ' << -1 + (j + 0.5) * 2 / n << " -1 0 0\n";
  return text.str();
}

LoadedScene load_rows(const std::string& rows) {
  const std::string path = own_file("in.txt", "x y z nx ny nz\n" + rows);
  return load_scene(path);
}

/// Floor and one wall of a room of 4 x 4 x 3 m, 20 mm between points, in units of `unit` metres.
std::string room(double unit) {
  std::ostringstream text;
  for (int i = 0; i < 200; ++i) {
    for (int j = 0; j < 200; ++j) text << i * 0.02 / unit << ' ' << j * 0.02 / unit << " 0\n";
    for (int j = 1; j < 150; ++j) text << i * 0.02 / unit << " 0 " << j * 0.02 / unit << '\n';
  }
  return text.str();
}

TEST(LoadedClouds, points_that_are_no_numbers_are_dropped_and_counted) {
  const LoadedScene loaded = load_rows(plate_rows(10) + "nan 0 0 -1 0 0\n1 inf 0 -1 0 0\n");
  EXPECT_EQ(loaded.report.dropped_not_finite, 2U);
  EXPECT_EQ(loaded.scene.size(), 100U);
  EXPECT_TRUE(same(image(ping_of(loaded.scene)), image(ping_of(load_rows(plate_rows(10)).scene))));
}

TEST(LoadedClouds, unusable_normals_are_repaired_and_counted_and_long_ones_shortened) {
  std::string rows = plate_rows(10);
  const auto replace_row = [&rows](int row, const std::string& normal) {
    std::size_t begin = 0;
    for (int i = 0; i < row; ++i) begin = rows.find('\n', begin) + 1;
    const std::size_t at = rows.find("-1 0 0\n", begin);
    rows.replace(at, 6, normal);
  };
  replace_row(33, "0 0 0");
  replace_row(44, "nan 0 0");
  replace_row(55, "-7 0 0");
  const LoadedScene loaded = load_rows(rows);
  EXPECT_EQ(loaded.report.repaired_normals, 2U);
  ASSERT_EQ(loaded.scene.size(), 100U);
  EXPECT_LT(relative_l2(image(ping_of(loaded.scene)), image(ping_of(load_rows(plate_rows(10)).scene))), 1e-4);
}

TEST(LoadedClouds, duplicates_are_dropped_and_counted) {
  const LoadedScene loaded = load_rows(plate_rows(10) + plate_rows(10));
  EXPECT_EQ(loaded.report.dropped_duplicates, 100U);
  EXPECT_TRUE(same(image(ping_of(loaded.scene)), image(ping_of(load_rows(plate_rows(10)).scene))));
}

TEST(LoadedClouds, cloud_in_millimetres_is_suspected_with_the_unit_to_give) {
  const std::string path = own_file("room_mm.xyz", room(0.001)), metres = own_file("room_m.xyz", room(1)),
                    kilometres = own_file("room_km.xyz", room(1000));
  const auto problems = [](const std::string& file) {
    std::string all;
    for (const std::string& problem : describe_file(file).problems) all += problem + "\n";
    return all;
  };
  EXPECT_THAT(problems(path), HasSubstr("this looks like millimetres. If so, give the unit (0.001"));
  EXPECT_THAT(problems(kilometres), HasSubstr("for kilometres"));
  EXPECT_THAT(problems(metres), ::testing::Not(HasSubstr("unit")));
  LoadOptions options;
  options.unit = 0.001;
  const SceneCloud scaled = load_scene(path, options).scene;
  EXPECT_NEAR((bounds(scaled).max - bounds(scaled).min).maxCoeff(), 3.98, 1e-5);
  for (const std::string& file : {path, metres, kilometres}) std::filesystem::remove(file);
}

// Single precision has a step of 0.5 m at 4 500 000 m: coordinates must be made relative in double.
TEST(LoadedClouds, cloud_in_map_coordinates_gives_the_image_of_a_centred_one) {
  const Eigen::Vector3d offset(565000, 4500000, 0);
  const LoadedScene near = load_rows(plate_rows(16)), far = load_rows(plate_rows(16, offset.x(), offset.y()));
  const SonarHead head = make_head(nine_beams(), sound_speed({}));
  Pose pose = Pose::Identity();
  const ComplexGrid here = image(simulate_ping(near.scene, head, pose, {}));
  pose.translation() = offset;
  EXPECT_LT(relative_l2(image(simulate_ping(far.scene, head, pose, {})), here), 1e-9);
}

// Half of a plate sampled k^2 times as densely as the other: its sum of cross-sections must not follow.
TEST(LoadedClouds, cross_section_follows_the_area_and_not_the_density) {
  for (const int k : {1, 2, 3}) {
    std::ostringstream rows;
    const auto half = [&rows](double left, double step) {
      for (int i = 0; i < std::lround(1 / step); ++i)
        for (int j = 0; j < std::lround(2 / step); ++j)
          rows << "5 " << left + (i + 0.5) * step << ' ' << -1 + (j + 0.5) * step << " -1 0 0\n";
    };
    half(-1, 0.1);
    half(0, 0.1 / k);
    const SceneCloud scene = load_rows(rows.str()).scene;
    double sparse = 0, dense = 0;
    for (std::size_t i = 0; i < scene.size(); ++i)
      (scene.origin.y() + scene.point[i].y() < 0 ? sparse : dense) += scene.area[i];
    EXPECT_NEAR(dense, 2, 0.12) << k;
    EXPECT_NEAR(sparse, 2, 0.12) << k;
  }
}

TEST(LoadedClouds, triangles_without_area_are_dropped_and_counted) {
  const std::string path = own_file("in.obj",
                                    "v 5 -1 -1\nv 5 1 -1\nv 5 1 1\nv 5 -1 1\nv 5 0 0\n"
                                    "f 1 3 2\nf 1 4 3\nf 1 1 2\nf 1 5 3\n");  // a point twice; three on one line
  LoadOptions options;
  options.mesh_spacing = 0.1;
  const LoadedScene loaded = load_scene(path, options);
  EXPECT_EQ(loaded.report.dropped_degenerate, 2U);
  double area = 0;
  for (const float a : loaded.scene.area) area += a;
  EXPECT_NEAR(area, 4, 1e-4);
  EXPECT_TRUE(all_finite(ping_of(loaded.scene)));
}

TEST(LoadedClouds, holes_of_an_organised_cloud_are_dropped_and_counted) {
  std::string rows;
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 8; ++j)
      rows +=
          (i * j) % 5 == 4 ? "nan nan nan\n" : "5 " + std::to_string(0.1 * i) + " " + std::to_string(0.1 * j) + "\n";
  const std::string path =
      own_file("in.pcd",
               "# .PCD v0.7\nVERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 8\n"
               "HEIGHT 6\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS 48\nDATA ascii\n" +
                   rows);
  const LoadedScene loaded = load_scene(path);
  EXPECT_EQ(loaded.report.points_read, 48U);
  EXPECT_EQ(loaded.report.dropped_not_finite, 6U);
  EXPECT_EQ(loaded.scene.size(), 42U);
  EXPECT_TRUE(all_finite(ping_of(loaded.scene)));
}

TEST(LoadedClouds, cloud_without_materials_gets_the_default_and_says_so) {
  const LoadedScene loaded = load_rows(plate_rows(10));
  EXPECT_FALSE(loaded.report.materials_found);
  ASSERT_EQ(loaded.scene.materials.size(), 1U);
  EXPECT_NEAR(db_from_power(loaded.scene.materials[0].lambert_mu), -27, 1e-9);
}

}  // namespace insonify::loaded_clouds
