// SPDX-License-Identifier: BSD-3-Clause
#include "scene_io/describe_file.hpp"

#include <fstream>

#include "files/peak_memory.hpp"
#include "scene_io/save_cloud.hpp"
#include "scene_io/test_files.hpp"

namespace {

bool has_problem(const FileDescription& file, const std::string& part) {
  return std::any_of(file.problems.begin(), file.problems.end(),
                     [&](const std::string& problem) { return problem.find(part) != std::string::npos; });
}

TEST(DescribeFile, counts_bounds_and_spacing_of_a_plate) {
  const FileDescription file =
      describe_file(own_file("a.xyz", plate_text(20, 0.25, 500000, 4600000) + "nan 0 0\n500000 4600000 0\n"));
  EXPECT_EQ(file.format, "text");
  EXPECT_EQ(file.points, 402u);
  EXPECT_EQ(file.not_finite, 1u);
  EXPECT_EQ(file.duplicates, 1u);
  EXPECT_EQ(file.min, Eigen::Vector3d(500000, 4600000, 0));
  EXPECT_EQ(file.max, Eigen::Vector3d(500004.75, 4600004.75, 0));
  EXPECT_DOUBLE_EQ(file.median_spacing, 0.25);
  EXPECT_FALSE(file.has_normals);
  EXPECT_TRUE(has_problem(file, "1 of 402 points (0.25 %) are not finite"));
  EXPECT_TRUE(has_problem(file, "a raster of heights: its surface looks up"));
}

TEST(DescribeFile, says_that_sides_are_not_known) {
  std::string text;
  for (int i = 0; i < 50; ++i) text += std::to_string(std::sin(i)) + " " + std::to_string(std::cos(2.3 * i)) + " 0\n";
  EXPECT_TRUE(has_problem(describe_file(own_file("a.xyz", text)), "no normals and no viewpoint"));
}

TEST(DescribeFile, fields_size_and_viewpoint_of_an_organised_pcd) {
  const FileDescription file =
      describe_file(own_file("a.pcd",
                             "# .PCD v0.7\nVERSION 0.7\nFIELDS x y z rgb\nSIZE 4 4 8 4\nTYPE F F F "
                             "U\nCOUNT 1 1 1 1\nWIDTH 2\nHEIGHT 3\n"
                             "VIEWPOINT 1 2 3 1 0 0 0\nPOINTS 6\nDATA ascii\n0 0 0 1\n1 0 0 1\n0 1 0 1\n1 "
                             "1 0 1\n0 2 0 1\n1 2 0 1\n"));
  EXPECT_EQ(file.width, 2u);
  EXPECT_EQ(file.height, 3u);
  ASSERT_EQ(file.fields.size(), 4u);
  EXPECT_EQ(file.fields[2].name + " " + file.fields[2].type, "z float64");
  EXPECT_EQ(file.fields[3].name + " " + file.fields[3].type, "rgb uint32");
  EXPECT_EQ(*file.viewpoint, Eigen::Vector3d(1, 2, 3));
  EXPECT_TRUE(has_problem(file, "towards the viewpoint in the file"));
}

TEST(DescribeFile, a_prepared_scene_has_no_problem) {
  SceneCloud scene;
  for (int i = 0; i < 100; ++i) add_surfel(scene, {i / 10 * 0.1, i % 10 * 0.1, 0}, {0, 0, 1}, 0.01);
  const std::string path = own_path("a.ply");
  save_scene(path, scene);
  const FileDescription file = describe_file(path);
  EXPECT_TRUE(file.has_normals && file.has_area && file.has_materials);
  EXPECT_TRUE(file.problems.empty()) << file.problems.front();
  EXPECT_EQ(file.format, "PLY binary_little_endian");
}

TEST(DescribeFile, a_mesh_has_triangles) {
  const FileDescription file =
      describe_file(own_file("a.obj", "v 0 0 0\nv 3 0 0\nv 3 4 0\nv 0 4 0\nf 1 2 3 4\nf 1 2 9\n"));
  EXPECT_EQ(file.format, "OBJ mesh");
  EXPECT_EQ(file.points, 4u);
  EXPECT_EQ(file.triangles, 3u);
  EXPECT_TRUE(has_problem(file, "1 of 3 polygons"));
}

TEST(DescribeFile, materials_of_a_cloud_by_its_areas_and_without_areas_by_its_points) {
  const std::string rows = "0 0 0 1 1\n1 0 0 1 2\n0 1 0 3 9\n0 1 0 3 9\nnan 0 0 0 1\n";
  const FileDescription file = describe_file(own_file("a.xyz", "x y z label area\n" + rows));
  ASSERT_EQ(file.materials.size(), 2u);
  EXPECT_EQ(file.materials[0].name, "label 1");
  EXPECT_EQ(file.materials[0].points, 2u);
  EXPECT_DOUBLE_EQ(*file.materials[0].area, 3);
  EXPECT_DOUBLE_EQ(file.materials[1].share, 0.75);
  const FileDescription bare = describe_file(own_file("b.xyz", "x y z label other\n" + rows));
  EXPECT_FALSE(bare.materials[1].area);
  EXPECT_DOUBLE_EQ(bare.materials[1].share, 1.0 / 3);
}

TEST(DescribeFile, materials_of_a_mesh_by_its_triangles) {
  const FileDescription file =
      describe_file(own_file("a.ply",
                             "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty "
                             "float z\nproperty int label\n"
                             "element face 2\nproperty list uchar int vertex_indices\nend_header\n0 0 0 0\n3 0 0 0\n3 "
                             "4 0 1\n0 4 0 1\n3 0 1 2\n3 0 2 "
                             "3\n"));
  ASSERT_EQ(file.materials.size(), 2u);
  EXPECT_NEAR(*file.materials[0].area, 6, 1e-6);  // 2 + 2 of the first corner, 2 of the second
  EXPECT_NEAR(*file.materials[1].area, 6, 1e-6);
}

TEST(DescribeFile, labels_that_are_no_materials_are_a_problem) {
  const FileDescription file = describe_file(own_file("a.xyz", "x y z label\n0 0 0 -1\n1 0 0 0\n0 1 0 0\n1 2 0 0\n"));
  EXPECT_TRUE(file.materials.empty());
  EXPECT_TRUE(has_problem(file, "a label is negative"));
}

TEST(DescribeFile, millimetres_and_kilometres_are_suspected_with_the_unit_to_give) {
  const auto room = [](double unit) {
    std::string text = plate_text(50, 0.02 / unit);
    for (int i = 1; i < 50; ++i)
      text += "0 " + std::to_string(0.02 * i / unit) + " " + std::to_string(0.015 * i / unit) + "\n";
    return describe_file(own_file("a.xyz", text));
  };
  EXPECT_TRUE(has_problem(room(0.001), "this looks like millimetres. If so, give the unit (0.001"));
  EXPECT_TRUE(has_problem(room(1000), "for kilometres"));
  EXPECT_FALSE(has_problem(room(1), "unit"));
}

TEST(DescribeFile, a_coarse_survey_on_a_map_grid_is_in_metres) {
  // A slope of 1 : 2, 4 m between its points, at easting 451 km and northing 5 411 km.
  std::ostringstream local, grid;
  for (int i = 0; i < 60; ++i)
    for (int j = 0; j < 60; ++j) {
      local << 4 * i << ' ' << 4 * j << ' ' << 2 * i << '\n';
      grid << 451000 + 4 * i << ' ' << 5411000 + 4 * j << ' ' << 2 * i << '\n';
    }
  EXPECT_TRUE(has_problem(describe_file(own_file("local.xyz", local.str())), "millimetres"));
  EXPECT_FALSE(has_problem(describe_file(own_file("grid.xyz", grid.str())), "millimetres"));
}

// The second half of the points is the first one, 0.25 m beside it; the rows take 126 MB, of which 38 are read as points.
TEST(DescribeFile, the_nearest_neighbour_may_stand_anywhere_in_a_file_that_is_read_in_blocks) {
  constexpr std::size_t half = 1 << 20;
  const std::string path = own_path("wide.ply");
  std::ofstream out(path, std::ios::binary);
  out << "ply\nformat binary_little_endian 1.0\nelement vertex " << 2 * half << '\n';
  for (const char* axis : {"x", "y", "z"}) out << "property float " << axis << '\n';
  for (const char* other : {"a", "b", "c", "d", "e", "f"}) out << "property double " << other << '\n';
  out << "end_header\n";
  for (std::size_t i = 0; i < 2 * half; ++i) {
    const std::size_t k = i % half;
    const float x = static_cast<float>(k % 1024) + (i < half ? 0.0F : 0.25F), y = static_cast<float>(k / 1024);
    out << bytes_of(x) << bytes_of(y) << bytes_of(0.0F) << std::string(48, '\1');
  }
  out.close();
  forget_peak_memory();
  const double before = peak_memory_mib();
  const FileDescription file = describe_file(path);
  EXPECT_EQ(file.points, 2 * half);
  EXPECT_EQ(file.duplicates, 0U);
  EXPECT_FLOAT_EQ(static_cast<float>(file.median_spacing), 0.25F);
  EXPECT_LT(peak_memory_mib() - before, 120);
}

}  // namespace
