// SPDX-License-Identifier: BSD-3-Clause
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

TEST(SaveScene, laws_are_kept_by_both_formats) {
  SceneCloud scene = scene_at(Eigen::Vector3d::Zero());
  const SurfaceLaw laws[] = {SeabedLaw{{.loss = 1.0 / 300}},
                             RoughLaw{.slope = 0.3, .density = 7850, .compression_speed = 5960},
                             TableLaw{{0, 0.1, 1.4}, {1e5, 2e5}, {-10, -11.25, -30, -1.0 / 3, -20, -30}, true}};
  for (const char* name : {"law.ply", "law.pcd"})
    for (const SurfaceLaw& law : laws) {
      scene.materials[1] = {"rock, grey", 1.0 / 30};
      scene.materials[1].law = law;
      save_scene(own_path(name), scene);
      EXPECT_EQ(load_scene(own_path(name)).scene.materials, scene.materials) << name;
    }
  std::string text = file_bytes(own_path("law.ply"));
  const std::string path = own_file("bad.ply", text.replace(text.find("half_vector=1"), 13, "half_vectors=1"));
  expect_error(ErrorKind::content, {path, "cannot understand the comment line 'insonify law 1 table"},
               [&] { load_scene(path); });
}

TEST(SaveScene, unit_scales_a_saved_scene_too) {
  const std::string path = own_path("a.ply");
  save_scene(path, scene_at({1000, 0, 0}));
  LoadOptions options;
  options.meaning.unit = 0.5;
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
}

}  // namespace
