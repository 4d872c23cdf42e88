// SPDX-License-Identifier: BSD-3-Clause
// Clouds whose columns have names that PLY and PCD cannot hold.
#include <pcl/io/pcd_io.h>
#include <pcl/io/ply_io.h>

#include "core/text.hpp"
#include "scene_io/describe_file.hpp"
#include "scene_io/prepare_tiles.hpp"
#include "scene_io/save_cloud.hpp"
#include "scene_io/test_files.hpp"
#include "tiles/tiled_scene.hpp"

namespace {

/// Returns a name of blanks, brackets, quotes, nothing, UTF-8, newlines, 300 letters, and words with a meaning in
/// headers.
std::string hostile_name(std::mt19937& random) {
  static const std::vector<std::string> pieces = [] {
    std::istringstream words(
        " |[|]|(|)|\"|'||\\n|\\|\t|\xc3\xb6|\xe2\x82\xac|#|//"
        "|:|{}|%s|x|y|z|nx|X|id|area|property|end_header|element|comment|"
        "format|ply|vertex|face|list|float|DATA|FIELDS|_|VERSION|insonify|scene|material|label|noise|1|-1.5|a|GPS "
        "time");
    std::vector<std::string> all = {std::string(300, 'a')};
    for (std::string word; std::getline(words, word, '|');) all.push_back(word);
    return all;
  }();
  std::string name;
  for (std::size_t n = random() % 4; n > 0; --n) name += pieces[random() % pieces.size()];
  return name;
}

SceneCloud eight_surfels() {
  SceneCloud scene;
  scene.materials = {{"sand", 0.01}, {"rock", 0.02}};
  for (int i = 0; i < 8; ++i) {
    scene.point.push_back({static_cast<float>(i % 4), static_cast<float>(i / 4), 0});
    scene.normal.push_back({0, 0, 1});
    scene.area.push_back(1);
    scene.material.push_back(static_cast<std::uint16_t>(i % 2));
    scene.id.push_back(static_cast<std::uint32_t>(i));
  }
  return scene;
}

/// Returns columns of random names, with newlines. One in four names is that of an earlier column.
SceneColumns hostile_columns(std::mt19937& random, std::size_t rows) {
  SceneColumns columns;
  if (random() % 2 == 0) columns.material = hostile_name(random) + "m";
  for (std::size_t k = 0; k < 1 + random() % 6; ++k) {
    const bool again = k > 0 && random() % 4 == 0;
    SceneColumn column{again ? columns.others[random() % k].name : hostile_name(random), "float64", {}};
    if (random() % 8 == 0) column.name += "\n";
    for (std::size_t i = 0; i < rows; ++i) {
      const std::string number = bytes_of(static_cast<double>(10 * k + i));
      column.bytes.insert(column.bytes.end(), number.begin(), number.end());
    }
    columns.others.push_back(std::move(column));
  }
  return columns;
}

bool is_legal(const std::string& name) {
  return !name.empty() && name.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_.-") ==
                              std::string::npos;
}

}  // namespace

TEST(ColumnNames, hostile_ones_are_written_legal_and_unique_and_come_back) {
  std::mt19937 random(7);
  const SceneCloud scene = eight_surfels();
  for (int cloud = 0; cloud < 125; ++cloud)
    for (const char* name : {"a.ply", "a.pcd"}) {
      const SceneColumns columns = hostile_columns(random, scene.size());
      const std::string path = own_path(name);
      save_scene(path, scene, columns);
      std::set<std::string> names;
      const FileDescription file = describe_file(path);
      for (const auto& field : file.fields) {
        EXPECT_TRUE(is_legal(field.name)) << cloud << ": '" << field.name << "'";
        EXPECT_TRUE(names.insert(lower_case(field.name)).second) << cloud << ": '" << field.name << "' twice";
      }
      pcl::PCLPointCloud2 opened;
      const bool ply = path.ends_with("ply");
      ASSERT_EQ(ply ? pcl::PLYReader().read(path, opened) : pcl::PCDReader().read(path, opened), 0) << cloud;
      EXPECT_EQ(opened.fields.size(), file.fields.size()) << cloud;
      LoadOptions options;
      options.keep_columns = true;
      const LoadedScene loaded = load_scene(path, options);
      ASSERT_EQ(loaded.scene.material, scene.material) << cloud;
      ASSERT_EQ(loaded.columns.others.size(), columns.others.size()) << cloud;
      for (std::size_t k = 0; k < columns.others.size(); ++k) {
        const std::string &was = columns.others[k].name, &is = loaded.columns.others[k].name;
        EXPECT_TRUE(is == was || is == was + "_in_file") << cloud << ": '" << was << "' came back as '" << is << "'";
        EXPECT_EQ(loaded.columns.others[k].bytes, columns.others[k].bytes) << cloud;
      }
      // Written again they have the same bytes.
      const std::string again = own_path(ply ? "again.ply" : "again.pcd");
      save_scene(again, loaded.scene, loaded.columns);
      EXPECT_EQ(file_bytes(again), file_bytes(path)) << cloud;
    }
}

TEST(ColumnNames, text_with_hostile_headings_becomes_clouds_that_read_back) {
  std::mt19937 random(8);
  for (int cloud = 0; cloud < 250; ++cloud) {
    const std::size_t others = 1 + random() % 5;
    std::string text = "x,y,z";
    for (std::size_t k = 0; k < others; ++k) {
      std::string name = hostile_name(random);
      std::erase_if(name, [](char c) { return c == '\t'; });
      text += "," + name;
    }
    text += "\n";
    for (int i = 0; i < 16; ++i) {
      text += std::to_string(0.1 * (i % 4)) + "," + std::to_string(0.1 * (i / 4)) + ",-3";
      for (std::size_t k = 0; k < others; ++k) text += "," + std::to_string((i + k) % 3);
      text += "\n";
    }
    const std::string path = own_file("a.csv", text);
    LoadOptions options;
    options.keep_columns = true;
    const LoadedScene loaded = load_scene(path, options);
    ASSERT_GE(loaded.scene.size(), 2u) << text.substr(0, 200);
    for (const char* name : {"a.ply", "a.pcd"}) {
      save_scene(own_path(name), loaded);
      EXPECT_EQ(describe_file(own_path(name)).points, loaded.scene.size()) << text.substr(0, 200);
    }
    prepare_tiles(path, own_path("a.tiles"), {});
    EXPECT_EQ(TiledScene(own_path("a.tiles")).info().surfels, loaded.scene.size());
  }
}

TEST(ColumnNames, bytes_that_are_no_utf8_do_not_reach_what_is_printed) {
  const std::string path = own_file("a.csv", "x,y,z,H\xf6he\n0,0,0,1\n1,0,0,1\n0,1,0,1\n1,1,0,1\n");
  EXPECT_EQ(describe_file(path).fields[3].name, "H\xef\xbf\xbdhe");
  EXPECT_EQ(load_scene(path).report.other_columns, std::vector<std::string>{"H\xef\xbf\xbdhe"});
}

TEST(ColumnNames, legal_and_unique_names_keep_their_bytes) {
  const SceneCloud scene = eight_surfels();
  SceneColumns columns;
  for (const char* name : {"Intensity", "gps_time", "scalar_Quality", "size", "type", "R", "area", "e.g-1"})
    columns.others.push_back({name, "uint8", std::vector<char>(scene.size())});
  save_scene(own_path("a.ply"), scene, columns);
  const std::string bytes = file_bytes(own_path("a.ply"));
  EXPECT_THAT(bytes, HasSubstr("comment insonify material_field material\nelement vertex 8\n"));
  EXPECT_THAT(bytes, HasSubstr("property int id\nproperty uchar Intensity\nproperty uchar gps_time\n"
                               "property uchar scalar_Quality\nproperty uchar size\nproperty uchar type\n"
                               "property uchar R\nproperty uchar area_in_file\nproperty uchar e.g-1\nend_header\n"));
}

TEST(ColumnNames, a_material_field_is_found_by_the_name_that_it_had) {
  std::string text = "x,y,z,Bottom type [1]\n";
  for (int i = 0; i < 64; ++i)
    text += std::to_string(0.1 * (i % 8)) + "," + std::to_string(0.1 * (i / 8)) + ",-3," + std::to_string(i % 2) + "\n";
  const std::string path = own_file("a.csv", text);
  LoadOptions options;
  options.keep_columns = true;
  save_scene(own_path("a.ply"), load_scene(path, options));
  EXPECT_THAT(file_bytes(own_path("a.ply")),
              HasSubstr("comment insonify column bottom_type__1_ \"Bottom type [1]\"\n"));
  options.material_field.name = "Bottom type [1]";
  options.materials = {{"mud", 0.01}, {"sand", 0.02}};
  for (const std::string& from : {path, own_path("a.ply")})
    EXPECT_EQ(load_scene(from, options).scene.material[1], 1) << from;
  save_scene(own_path("b.ply"), load_scene(path, options));
  EXPECT_THAT(file_bytes(own_path("b.ply")), HasSubstr("comment insonify material_field bottom_type__1_\n"));
  EXPECT_EQ(load_scene(own_path("b.ply")).scene.material[1], 1);
}
