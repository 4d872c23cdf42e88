// SPDX-License-Identifier: BSD-3-Clause
// Materials of a scene: from labels, from intervals of a scalar field, from one for all.
#include "scene_io/test_files.hpp"
#include "support/test.hpp"

namespace insonify::scene_materials_tests {

TEST(Materials, labels_choose_from_the_table_given) {
  const std::string path = own_file("a.csv", "x,y,z,label\n0,0,0,0\n1,0,0,1\n0,1,0,1\n1,1,0,0\n");
  LoadOptions options;
  options.materials = {{"sand", 0.01}, {"rock", 0.1}};
  const LoadedScene loaded = load_scene(path, options);
  EXPECT_EQ(loaded.scene.material, (std::vector<std::uint16_t>{0, 1, 1, 0}));
  EXPECT_EQ(loaded.scene.materials[1].name, "rock");
  EXPECT_TRUE(loaded.report.materials_found);
  options.material = 1;
  EXPECT_EQ(load_scene(path, options).scene.material, (std::vector<std::uint16_t>{1, 1, 1, 1}));
  options = {};
  options.materials = {{"sand", 0.01}};
  expect_error(ErrorKind::content, {path, "label 1 found", "1 materials"}, [&] { load_scene(path, options); });
}

TEST(Materials, labels_without_a_table_keep_their_numbers_under_default_materials) {
  const LoadedScene loaded = load_scene(own_file("a.csv", "x,y,z,class\n0,0,0,0\n1,0,0,2\n0,1,0,2\n1,1,0,0\n"));
  EXPECT_EQ(loaded.scene.material[1], 2);
  ASSERT_EQ(loaded.scene.materials.size(), 3u);
  EXPECT_EQ(loaded.scene.materials[2].lambert_mu, Material{}.lambert_mu);
  EXPECT_TRUE(has_note(loaded.report, "no materials given"));
}

TEST(Materials, labels_that_are_no_index_are_refused_unless_one_material_is_given_for_all) {
  for (const char* label : {"-1", "0.5", "70000", "nan"}) {
    const std::string path =
        own_file("a.csv", std::string("x,y,z,label\n0,0,0,0\n1,0,0,") + label + "\n0,1,0,0\n1,1,0,0\n");
    expect_error(ErrorKind::content, {path, "a label is negative, above 65534 or not an integer"},
                 [&] { load_scene(path); });
    LoadOptions options;
    options.material = 0;
    EXPECT_EQ(load_scene(path, options).scene.size(), 4u);
  }
}

TEST(Materials, whole_numbers_stored_as_floats_are_labels) {
  const std::string path = own_file("a.csv", "x,y,z,scalar_Classification\n0,0,0,2.0\n1,0,0,1.0\n0,1,0,2.0\n1,1,0,0\n");
  const LoadedScene loaded = load_scene(path);
  EXPECT_EQ(loaded.scene.material, (std::vector<std::uint16_t>{2, 1, 2, 0}));
  EXPECT_EQ(loaded.report.material_field, "scalar_classification");
}

TEST(Materials, come_from_the_field_named_whatever_its_case_and_prefix) {
  const std::string path = own_file("a.csv", "x,y,z,label,scalar_Kind of ground\n0,0,0,0,1\n1,0,0,0,1\n0,1,0,1,0\n");
  for (const char* name : {"kind_of_ground", "Kind of ground", "scalar_Kind of ground", "SCALAR_KIND_OF_GROUND"}) {
    LoadOptions options;
    options.material_field.name = name;
    EXPECT_EQ(load_scene(path, options).scene.material, (std::vector<std::uint16_t>{1, 1, 0})) << name;
  }
  EXPECT_EQ(load_scene(path).scene.material, (std::vector<std::uint16_t>{0, 0, 1}));
}

TEST(Materials, an_unknown_field_is_refused_with_the_fields_there_are) {
  const std::string path = own_file("a.csv", "x,y,z,intensity,gain\n0,0,0,0,1\n1,0,0,0,1\n0,1,0,1,0\n");
  LoadOptions options;
  options.material_field.name = "reflectance";
  expect_error(ErrorKind::content,
               {path + ": no field 'reflectance' to take materials from", "'x y z intensity gain'", "name one of them"},
               [&] { load_scene(path, options); });
  options.material = 0;  // one for all: no field is needed
  EXPECT_EQ(load_scene(path, options).scene.size(), 3u);
}

/// Returns intervals: mud below 80, weed from 80 up to 200.
LoadOptions two_intervals() {
  LoadOptions options;
  options.materials = {{"rock", 0.1}, {"mud", 0.01}, {"weed", 0.02}};
  options.material_field = {"intensity", {{.to = 80, .material = 1}, {80, 200, 2}}};
  return options;
}

TEST(Materials, intervals_are_half_open_and_what_lies_outside_is_counted) {
  std::string text = "x,y,z,Intensity\n";
  int row = 0;
  for (const char* value : {"-1e30", "79.9999", "80", "199", "200", "nan", "0.5"}) {
    text += std::to_string(row) + "," + std::to_string(row % 3) + ",0," + value + "\n";
    ++row;
  }
  const LoadedScene loaded = load_scene(own_file("a.csv", text), two_intervals());
  EXPECT_EQ(loaded.scene.material, (std::vector<std::uint16_t>{1, 1, 2, 2, 3, 3, 1}));
  ASSERT_EQ(loaded.scene.materials.size(), 4u);
  EXPECT_EQ(loaded.scene.materials[3].name, "outside");
  EXPECT_EQ(loaded.scene.materials[3].lambert_mu, Material{}.lambert_mu);
  EXPECT_EQ(loaded.report.outside_intervals, 2u);
  EXPECT_TRUE(has_note(loaded.report, "2 of 7 surfels (29 %) have a 'intensity' in none of the 2 intervals"));
}

TEST(Materials, a_table_whose_intervals_hold_every_number_stays_as_it_is) {
  const LoadedScene loaded =
      load_scene(own_file("a.csv", "x,y,z,intensity\n0,0,0,10\n1,0,0,90\n0,1,0,90\n"), two_intervals());
  EXPECT_EQ(loaded.scene.materials.size(), 3u);
  EXPECT_EQ(loaded.report.outside_intervals, 0u);
}

TEST(Materials, intervals_that_cannot_be_meant_are_refused) {
  const std::string path = own_file("a.csv", "x,y,z,intensity\n0,0,0,10\n1,0,0,90\n0,1,0,90\n");
  LoadOptions options = two_intervals();
  options.material_field.intervals.push_back({100, 101, 0});
  expect_error(ErrorKind::argument,
               {"load_scene: material_field.intervals[1] = 80 .. 200 and [2] = 100 .. 101 overlap"},
               [&] { load_scene(path, options); });
  options.material_field.intervals[2] = {300, 300, 0};
  expect_error(ErrorKind::argument, {"intervals[2] = 300 .. 300, from must be below to"},
               [&] { load_scene(path, options); });
  options.material_field.intervals[2] = {300, 301, 3};
  expect_error(ErrorKind::argument, {"intervals[2].material = 3", "number of options.materials, 3"},
               [&] { load_scene(path, options); });
}

TEST(Materials, of_a_mesh_come_from_the_nearest_corner) {
  const std::string path = own_file(
      "a.ply",
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nproperty float "
      "scalar_Intensity\nelement face 2\nproperty list uchar int vertex_indices\nend_header\n"
      "0 0 0 10\n1 0 0 10\n1 1 0 150\n0 1 0 150\n3 0 1 2\n3 0 2 3\n");
  LoadOptions options = two_intervals();
  options.mesh_spacing = 0.1;
  const LoadedScene loaded = load_scene(path, options);
  ASSERT_EQ(loaded.scene.size(), 100u);
  for (std::size_t i = 0; i < 100; ++i) {
    const double y = world(loaded.scene, i).y();
    if (std::abs(y - 0.5) < 0.26) continue;
    EXPECT_EQ(loaded.scene.material[i], y > 0.5 ? 2 : 1) << y;
  }
  EXPECT_EQ(loaded.report.outside_intervals, 0u);
}

}  // namespace insonify::scene_materials_tests
