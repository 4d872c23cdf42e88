#include "scene_io/save_cloud.hpp"

#include <pcl/conversions.h>
#include <pcl/io/pcd_io.h>
#include <pcl/point_types.h>

#include "scene_io/test_files.hpp"
#include "support/test.hpp"

namespace {

SceneCloud scene_at(const Eigen::Vector3d& origin, bool oriented = true) {
  SceneCloud scene;
  scene.origin = origin;
  scene.materials = {{"fine sand", 0.1 + 1e-17}, {"rock, grey", 1.0 / 30, 0.1 + 1e-17, 1.0 / 3}, {"", 0}};
  scene.normals_oriented = oriented;
  for (int i = 0; i < 50; ++i) {
    scene.point.push_back({0.731f * static_cast<float>(i % 7) - 2.1f, 0.377f * static_cast<float>(i),
                           -0.113f * static_cast<float>(i % 5)});
    scene.normal.push_back(Eigen::Vector3f(0.1f * static_cast<float>(i % 3), 0.2f, 1).normalized());
    scene.area.push_back(0.001f * static_cast<float>(i));
    scene.material.push_back(static_cast<std::uint16_t>(i % 3));
    scene.id.push_back(4000000000u - static_cast<std::uint32_t>(i));
  }
  return scene;
}

void expect_same_but_points(const LoadedScene& loaded, const SceneCloud& scene) {
  expect_same_attributes(loaded.scene, scene);
  EXPECT_FALSE(loaded.report.normals_estimated);
  EXPECT_FALSE(loaded.report.areas_estimated);
  EXPECT_TRUE(loaded.report.notes.empty()) << loaded.report.notes.front();
}

TEST(SaveScene, a_ply_gives_the_same_scene_back) {
  for (const bool oriented : {true, false}) {
    const SceneCloud scene = scene_at(Eigen::Vector3d::Zero(), oriented);
    const std::string path = own_path("a.ply");
    save_scene(path, scene);
    const LoadedScene loaded = load_scene(path);
    expect_same_but_points(loaded, scene);
    EXPECT_EQ(loaded.scene.point, scene.point);
  }
}

TEST(SaveScene, a_far_ply_gives_the_origin_back_and_points_within_a_nanometre) {
  const SceneCloud scene = scene_at({500000, 4600000, -20});
  const std::string path = own_path("a.ply");
  save_scene(path, scene);
  EXPECT_THAT(file_bytes(path), HasSubstr("property double x"));
  const LoadedScene loaded = load_scene(path);
  expect_same_but_points(loaded, scene);
  for (std::size_t i = 0; i < scene.size(); ++i) EXPECT_LT((loaded.scene.point[i] - scene.point[i]).norm(), 1e-9f);
}

TEST(SaveScene, saving_what_was_loaded_gives_the_same_bytes) {
  const std::string first = own_path("a.ply"), second = own_path("b.ply");
  save_scene(first, scene_at({500000, 4600000, -20}));
  save_scene(second, load_scene(first).scene);
  EXPECT_EQ(file_bytes(second), file_bytes(first));
}

TEST(SaveScene, a_pcd_gives_the_same_scene_back_and_opens_in_pcl) {
  const SceneCloud scene = scene_at({4, 4, -3});
  const std::string path = own_path("a.pcd");
  save_scene(path, scene);
  const LoadedScene loaded = load_scene(path);
  expect_same_but_points(loaded, scene);
  pcl::PointCloud<pcl::PointNormal> cloud;
  ASSERT_EQ(pcl::PCDReader().read(path, cloud), 0);
  ASSERT_EQ(cloud.size(), scene.size());
  for (std::size_t i = 0; i < scene.size(); ++i) {
    EXPECT_LT((loaded.scene.point[i] - scene.point[i]).norm(), 2e-6f);  // float32 steps at 22 m
    EXPECT_EQ(cloud[i].getVector3fMap(), world(scene, i).cast<float>());
    EXPECT_EQ(Eigen::Vector3f(cloud[i].getNormalVector3fMap()), scene.normal[i]);
  }
}

TEST(SaveScene, scenes_without_relief_and_coherence_have_the_lines_they_always_had) {
  SceneCloud scene = scene_at(Eigen::Vector3d::Zero());
  const std::string with = own_path("with.ply"), without = own_path("without.ply");
  save_scene(with, scene);
  scene.materials[1] = {"rock, grey", 1.0 / 30};
  save_scene(without, scene);
  EXPECT_THAT(file_bytes(with), HasSubstr("comment insonify surface 1 0.10000000000000002 0.3333333333333333\n"));
  EXPECT_THAT(file_bytes(with), HasSubstr("comment insonify material 1 0.03333333333333333 rock, grey\n"));
  EXPECT_THAT(file_bytes(without), ::testing::Not(HasSubstr("insonify surface")));
  const auto changed = [&](const std::string& old, const std::string& other) {
    std::string text = file_bytes(with);
    return own_file("changed.ply", text.replace(text.find(old), old.size(), other));
  };
  for (const char* line : {"surface 7 0.1", "surface 1 0.1 x", "surface 1 0.1 0.3 9"}) {
    const std::string path = changed("surface 1 0.10000000000000002 0.3333333333333333", line);
    expect_error(ErrorKind::content, {path, std::string("cannot understand the comment line 'insonify ") + line},
                 [&] { load_scene(path); });
  }
  // A number that came after the file was written.
  EXPECT_EQ(load_scene(changed(" 0.3333333333333333\n", "\n")).scene.materials[1].relief_slope, 0);
}

TEST(SaveScene, unit_scales_a_saved_scene_too) {
  const std::string path = own_path("a.ply");
  save_scene(path, scene_at({1000, 0, 0}));
  LoadOptions options;
  options.unit = 0.5;
  const LoadedScene loaded = load_scene(path, options);
  EXPECT_LT((world(loaded.scene, 10) - 0.5 * world(scene_at({1000, 0, 0}), 10)).norm(), 1e-6);
  EXPECT_FLOAT_EQ(loaded.scene.area[10], 0.25f * 0.01f);
}

TEST(SaveScene, a_viewpoint_orients_a_scene_saved_without_sides) {
  const std::string path = own_path("a.ply");
  save_scene(path, scene_at(Eigen::Vector3d::Zero(), false));
  LoadOptions options;
  options.viewpoint = Eigen::Vector3d(0, 0, -100);
  const LoadedScene loaded = load_scene(path, options);
  EXPECT_TRUE(loaded.scene.normals_oriented);
  for (const auto& n : loaded.scene.normal) EXPECT_LT(n.z(), 0);
}

TEST(SaveScene, refuses_what_it_cannot_write) {
  const SceneCloud scene = scene_at({500000, 4600000, 0});
  expect_error(ErrorKind::argument, {"save_scene", "float32", "save it as .ply"},
               [&] { save_scene(own_path("a.pcd"), scene); });
  EXPECT_FALSE(std::filesystem::exists(own_path("a.pcd")));
  expect_error(ErrorKind::argument, {"save_scene", "'.xyz'", ".ply or .pcd"},
               [&] { save_scene(own_path("a.xyz"), scene); });
  expect_error(ErrorKind::file, {"a.ply: folder ", "no/such/folder does not exist; create it first"},
               [&] { save_scene(::testing::TempDir() + "no/such/folder/a.ply", scene); });
  expect_error(ErrorKind::content, {"save_scene", "empty"}, [&] { save_scene(own_path("b.ply"), SceneCloud{}); });
  SceneCloud wrong = scene;
  wrong.area.pop_back();
  expect_error(ErrorKind::argument, {"save_scene", "area"}, [&] { save_scene(own_path("c.ply"), wrong); });
}

TEST(SaveScene, a_failed_rename_leaves_no_temporary_file) {
  const std::string folder = own_path("folder.ply");
  std::filesystem::create_directories(folder + "/full");
  expect_error(ErrorKind::file, {"folder.ply: is not a valid name"},
               [&] { save_scene(folder, scene_at(Eigen::Vector3d::Zero())); });
  for (const auto& entry : std::filesystem::directory_iterator(own_folder())) {
    EXPECT_THAT(entry.path().string(), ::testing::Not(HasSubstr("folder.ply.tmp")));
  }
}

Soundings some_soundings() {
  Soundings s;
  for (int i = 0; i < 20; ++i) {
    const float f = static_cast<float>(i);
    const std::uint32_t u = static_cast<std::uint32_t>(i);
    s.position.push_back({500000.125 + i, 4600000.5 - i, -i / 3.0});
    s.level_db.push_back(100.5f + f);
    s.range.push_back(5 + f / 8);
    s.azimuth.push_back(-0.5f + f / 32);
    s.elevation.push_back(0.01f * f);
    s.ping.push_back(7);
    s.beam.push_back(u * 3);
    s.bin.push_back(u * 100);
    s.true_elevation.push_back(-0.02f * f);
    s.true_surfel.push_back(u + 1000);
    s.true_material.push_back(u % 2);
  }
  return s;
}

/// Independent reader of the format of save_soundings: 3 doubles, 4 floats, 3 ints, a float, 2 ints per row.
TEST(SaveSoundings, a_ply_holds_double_coordinates_and_scalars_that_cloudcompare_knows) {
  const Soundings s = some_soundings();
  const std::string path = own_path("a.ply");
  save_soundings(path, s);
  const std::string bytes = file_bytes(path);
  const std::string expected_header =
      "ply\nformat binary_little_endian 1.0\nelement vertex 20\nproperty double x\nproperty double "
      "y\nproperty double z\n"
      "property float scalar_level_db\nproperty float scalar_range\nproperty float scalar_azimuth\nproperty "
      "float "
      "scalar_elevation\nproperty int scalar_ping\nproperty int scalar_beam\nproperty int "
      "scalar_bin\nproperty float "
      "scalar_true_elevation\nproperty int scalar_true_surfel\nproperty int scalar_true_material\nend_header\n";
  const std::size_t end = bytes.find("end_header\n") + 11;
  std::istringstream lines(bytes.substr(0, end));
  std::string header, comments;
  for (std::string line; std::getline(lines, line);) (line.starts_with("comment") ? comments : header) += line + "\n";
  ASSERT_EQ(header, expected_header);
  for (const char* unit : {"x m", "scalar_level_db dB re 1 uPa", "scalar_range m",
                           "scalar_azimuth rad, positive to port", "scalar_true_surfel id in the scene; -1: none"})
    EXPECT_THAT(comments, HasSubstr(std::string("comment unit ") + unit + "\n"));
  ASSERT_EQ(bytes.size(), end + 20 * 64);
  const char* at = bytes.data() + end;
  for (std::size_t i = 0; i < 20; ++i, at += 64) {
    double position[3];
    float reals[4], elevation;
    std::uint32_t whole[3], known[2];
    std::memcpy(position, at, 24);
    std::memcpy(reals, at + 24, 16);
    std::memcpy(whole, at + 40, 12);
    std::memcpy(&elevation, at + 52, 4);
    std::memcpy(known, at + 56, 8);
    EXPECT_EQ(Eigen::Vector3d(position[0], position[1], position[2]), s.position[i]);
    EXPECT_EQ((std::vector<float>(reals, reals + 4)),
              (std::vector<float>{s.level_db[i], s.range[i], s.azimuth[i], s.elevation[i]}));
    EXPECT_EQ((std::vector<std::uint32_t>(whole, whole + 3)), (std::vector<std::uint32_t>{7, s.beam[i], s.bin[i]}));
    EXPECT_EQ(elevation, s.true_elevation[i]);
    EXPECT_EQ((std::pair(known[0], known[1])), (std::pair(s.true_surfel[i], s.true_material[i])));
  }
}

TEST(SaveSoundings, files_of_unsigned_columns_are_read_as_those_of_today) {
  Soundings s = some_soundings();
  s.true_surfel[3] = s.true_material[3] = Soundings::none;
  s.true_surfel[4] = 3000000000;
  const std::string today = own_path("today.ply");
  save_soundings(today, s);
  std::string old = file_bytes(today);
  for (std::size_t at = 0; (at = old.find("property int ", at)) != old.npos;) old.replace(at, 12, "property uint");
  for (const std::string& path : {today, own_file("old.ply", old)}) {
    const Soundings loaded = load_soundings(path);
    EXPECT_EQ(loaded.true_surfel, s.true_surfel);
    EXPECT_EQ(loaded.true_material, s.true_material);
    EXPECT_EQ(loaded.ping, s.ping);
  }
  // Both join, and returns without a surfel lie on no bed.
  join_clouds(own_path("both.ply"), {own_path("old.ply"), today});
  EXPECT_THAT(file_bytes(own_path("both.ply")), HasSubstr("property int scalar_true_surfel\n"));
  EXPECT_EQ(load_soundings(own_path("both.ply")).true_surfel.at(23), Soundings::none);
}

// Types that Open3D's reader of PLY knows (t/io/file_format/FilePLY.cpp): it skips columns of others.
TEST(SaveScene, columns_of_a_ply_are_of_types_that_every_reader_takes) {
  const auto types_in = [](const std::string& path) {
    std::set<std::string> types;
    std::istringstream lines(file_bytes(path));
    for (std::string line; std::getline(lines, line) && line != "end_header";)
      if (line.starts_with("property ")) types.insert(line.substr(9, line.find(' ', 9) - 9));
    return types;
  };
  SceneCloud scene = scene_at(Eigen::Vector3d::Zero());
  const std::string path = own_path("a.ply");
  save_scene(path, scene);
  EXPECT_THAT(file_bytes(path),
              testing::AllOf(HasSubstr("property int material\n"), HasSubstr("property double id\n")));
  for (std::uint32_t& id : scene.id) id -= 3999999000u;
  save_scene(path, scene);
  EXPECT_THAT(file_bytes(path), HasSubstr("property int id\n"));
  EXPECT_EQ(types_in(path), (std::set<std::string>{"float", "int"}));
  EXPECT_EQ(load_scene(path).scene.id, scene.id);
  save_soundings(path, some_soundings());
  EXPECT_EQ(types_in(path), (std::set<std::string>{"double", "float", "int"}));
}

TEST(SaveSoundings, a_pcd_opens_in_pcl_with_all_fields) {
  const Soundings s = some_soundings();
  const std::string path = own_path("a.pcd");
  const Eigen::Vector3d origin = save_soundings(path, s);
  pcl::PCLPointCloud2 cloud;
  Eigen::Vector4f viewpoint;
  Eigen::Quaternionf turn;
  int version = 0;
  ASSERT_EQ(pcl::PCDReader().read(path, cloud, viewpoint, turn, version), 0);
  ASSERT_EQ(cloud.width * cloud.height, 20u);
  std::string names;
  for (const auto& field : cloud.fields) names += field.name + " ";
  EXPECT_EQ(names,
            "x y z level_db range azimuth elevation ping beam bin true_elevation true_surfel true_material intensity "
            "label ");
  for (std::size_t i = 0; i < 20; ++i) {
    float reals[7];
    std::uint32_t whole[4];
    std::memcpy(reals, cloud.data.data() + i * cloud.point_step, 28);
    std::memcpy(whole, cloud.data.data() + i * cloud.point_step + 28, 16);
    EXPECT_EQ(reals[2], static_cast<float>(s.position[i].z()));
    EXPECT_EQ(reals[3], s.level_db[i]);
    EXPECT_EQ(whole[2], s.bin[i]);
  }
  // PCL's own point types find their names.
  pcl::PointCloud<pcl::PointXYZI> levels;
  pcl::PointCloud<pcl::PointXYZL> labels;
  pcl::fromPCLPointCloud2(cloud, levels);
  pcl::fromPCLPointCloud2(cloud, labels);
  EXPECT_EQ(levels.at(7).intensity, s.level_db[7]);
  EXPECT_EQ(labels.at(7).label, s.true_material[7]);
  // Far from zero float32 would lose 0.25 m of northing: the points count from an origin that the VIEWPOINT gives.
  EXPECT_EQ(origin, Eigen::Vector3d(500000, 4600000, 0));
  EXPECT_EQ(viewpoint, Eigen::Vector4f(500000, 4600000, 0, 0));
  EXPECT_THAT(file_bytes(path), HasSubstr("VIEWPOINT 500000 4600000 0 1 0 0 0\n"));
  for (std::size_t i = 0; i < 20; ++i)
    EXPECT_LT((origin + levels.at(i).getVector3fMap().cast<double>() - s.position[i]).norm(), 2e-6);
}

TEST(SaveSoundings, a_pcd_near_zero_holds_world_coordinates) {
  Soundings s = some_soundings();
  for (Eigen::Vector3d& p : s.position) p -= Eigen::Vector3d(500000, 4600000, 0);
  const std::string path = own_path("a.pcd");
  EXPECT_EQ(save_soundings(path, s), Eigen::Vector3d::Zero());
  EXPECT_THAT(file_bytes(path), HasSubstr("VIEWPOINT 0 0 0 1 0 0 0\n"));
  pcl::PointCloud<pcl::PointXYZ> cloud;
  ASSERT_EQ(pcl::io::loadPCDFile(path, cloud), 0);
  EXPECT_EQ(cloud.at(3).getVector3fMap(), s.position[3].cast<float>());
}

TEST(SaveSoundings, no_soundings_make_a_file_with_no_points) {
  for (const char* name : {"a.ply", "a.pcd"}) {
    const std::string path = own_path(name);
    save_soundings(path, {});
    EXPECT_THAT(file_bytes(path), ::testing::ContainsRegex("(element vertex|POINTS) 0"));
  }
}

TEST(SaveSoundings, columns_of_different_lengths_are_refused) {
  Soundings s = some_soundings();
  s.beam.pop_back();
  expect_error(ErrorKind::argument, {"save_soundings", "20 positions", "length 19"},
               [&] { save_soundings(own_path("a.ply"), s); });
}

}  // namespace
