// SPDX-License-Identifier: BSD-3-Clause
#include "store/scene_file.hpp"

#include "support/test.hpp"

namespace {

const std::string poses = "time_s,x_m,y_m,z_m,yaw_deg,pitch_deg,roll_deg\n0,1,2,3,40,-10,5\n10,11,2,3,40,-10,5\n";

const std::string of_parts = R"(schema = 1
[[part]]
file = "reef.ply"
unit = "mm"
viewpoint_m = [0, 0, 2]
thin_m = 0.05
[[part]]
name = "tyre"
file = "wheel.obj"
material = "rubber"
position_m = [12.0, 3.5]
bury_m = 0.05
yaw_deg = 30
scale = 1.5
[[part]]
file = "diver.ply"
label = "person"
trajectory = "diver.csv"
[[part]]
name = "drone"
file = "wheel.obj"
position_m = [1, 2, -3]
velocity_mps = [0, 2, 0]
turn_deg_per_s = 90
[[scatter]]
files = ["pot.obj", "wheel.obj"]
count = [3, 8]
area_m = [[0, -10], [30, -10], [30, 10], [0, 10]]
min_distance_m = 1.5
yaw_deg = 180
tilt_deg = 10
bury = [0, 0.3]
scale = [0.9, 1.1]
spacing_m = 0.01
)";

/// Writes a scene file with this text beside the files that it names.
std::string scene_of(const std::string& text) {
  for (const char* name : {"reef.ply", "wheel.obj", "diver.ply", "pot.obj"}) own_file(name, "");
  own_file("diver.csv", poses);
  return own_file("scene.toml", text);
}

/// Returns the error for the file with its first `from` replaced.
std::string refusal_of_scene(const std::string& from, const std::string& to) {
  const std::string path = scene_of(replaced(of_parts, from, to));
  const std::string said = error_with_kind([&] { load_scene_file(path); });
  return said.find(path) == std::string::npos ? said : replaced(said, path, "scene.toml");
}

}  // namespace

TEST(SceneFile, reads_parts_where_they_stand_and_how_they_move) {
  const SceneFile scene = load_scene_file(scene_of(of_parts));
  ASSERT_EQ(scene.parts.size(), 4U);
  const ScenePartEntry &reef = scene.parts[0], &tyre = scene.parts[1], &diver = scene.parts[2], &drone = scene.parts[3];
  EXPECT_EQ(reef.name, "reef");
  EXPECT_EQ(reef.label, "") << "its materials are its classes";
  EXPECT_EQ(reef.file.path, own_path("reef.ply")) << "beside the scene file";
  EXPECT_TRUE(reef.placement.captured);
  EXPECT_EQ(reef.file.meaning.unit, 1e-3);
  EXPECT_EQ(reef.file.thin, 0.05);
  EXPECT_EQ(reef.file.viewpoint.value(), Eigen::Vector3d(0, 0, 2));

  EXPECT_EQ(tyre.label, "tyre");
  EXPECT_FALSE(tyre.placement.captured);
  EXPECT_EQ(tyre.placement.rest, PartRest::ground) << "two numbers";
  EXPECT_EQ(tyre.placement.bury, 0.05);
  EXPECT_EQ(tyre.placement.scale, 1.5);
  EXPECT_NEAR(tyre.placement.yaw, pi / 6, 1e-15);
  EXPECT_EQ(tyre.file.material, "rubber");
  EXPECT_FALSE(tyre.placement.moves());

  EXPECT_EQ(diver.name, "diver");
  EXPECT_EQ(diver.label, "person");
  EXPECT_EQ(diver.placement.trajectory.value().time.back(), 10);
  EXPECT_EQ(drone.placement.rest, PartRest::none) << "three numbers";
  EXPECT_EQ(drone.placement.velocity, Eigen::Vector3d(0, 2, 0));
  EXPECT_NEAR(drone.placement.turn_rate.z(), pi / 2, 1e-15);
  EXPECT_EQ(scene.text, of_parts);
}

TEST(SceneFile, reads_scatters_and_names_all_files) {
  const SceneFile scene = load_scene_file(scene_of(of_parts));
  ASSERT_EQ(scene.scatters.size(), 1U);
  const SceneScatterEntry& s = scene.scatters[0];
  EXPECT_EQ(s.names, (std::vector<std::string>{"pot", "wheel"}));
  EXPECT_EQ(s.labels, s.names);
  EXPECT_EQ(s.files[1].path, own_path("wheel.obj"));
  EXPECT_EQ(s.files[1].spacing, 0.01);
  EXPECT_EQ(s.rule.least, 3);
  EXPECT_EQ(s.rule.most, 8);
  EXPECT_EQ(s.rule.area[2], Eigen::Vector2d(30, 10));
  EXPECT_EQ(s.rule.min_distance.value(), 1.5);
  EXPECT_NEAR(s.rule.yaw, pi, 1e-15);
  EXPECT_EQ(s.rule.most_bury, 0.3);
  EXPECT_EQ(s.rule.least_scale, 0.9);
  EXPECT_EQ(s.rule.rest, PartRest::ground);
  const std::vector<std::string> files = files_of(scene);
  EXPECT_EQ(files.size(), 8U);
  EXPECT_EQ(files[0], scene.path);
  EXPECT_EQ(files[1], own_path("diver.csv"));
}

TEST(SceneFile, holds_scenes_of_parts_but_not_itself) {
  scene_of(of_parts);
  own_file("raft.toml", "schema = 1\n[[part]]\nfile = \"wheel.obj\"\nposition_m = [0, 0, 0]\n");
  const SceneFile scene =
      load_scene_file(own_file("outer.toml", "schema = 1\n[[part]]\nfile = \"raft.toml\"\nposition_m = [1, 2]\n"));
  ASSERT_TRUE(scene.parts[0].file.scene);
  EXPECT_EQ(scene.parts[0].file.scene->parts[0].file.path, own_path("wheel.obj"));
  EXPECT_EQ(files_of(scene).size(), 3U);

  own_file("a.toml", "schema = 1\n[[part]]\nfile = \"b.toml\"\n");
  own_file("b.toml", "schema = 1\n[[part]]\nfile = \"wheel.obj\"\n[[part]]\nfile = \"a.toml\"\n");
  expect_error(ErrorKind::content, {"b.toml:5: file: a scene cannot hold itself", "a.toml -> ", "b.toml -> "},
               [] { load_scene_file(own_path("a.toml")); });
}

TEST(SceneFile, refuses_what_is_wrong_with_line_key_and_remedy) {
  EXPECT_EQ(error_with_kind([] { load_scene_file("none.toml"); }), "file: none.toml: no such file");
  EXPECT_THAT(refusal_of_scene("wheel.obj", "lost.obj"),
              HasSubstr("content: scene.toml:9: file = 'lost.obj': there is no file "));
  EXPECT_EQ(refusal_of_scene("yaw_deg", "yaw_dge"),
            "content: scene.toml:13: unknown key 'part.yaw_dge'; did you mean 'part.yaw_deg'?");
  EXPECT_THAT(refusal_of_scene("[12.0, 3.5]", "[12.0, nan]"),
              HasSubstr("content: scene.toml:11: part.position_m = [12.0, nan], must be two or three numbers"));
  EXPECT_THAT(refusal_of_scene("[12.0, 3.5]", "[12.0]"), HasSubstr("must be two or three numbers"));
  EXPECT_EQ(
      refusal_of_scene("file = \"diver.ply\"", "name = \"tyre\"\nfile = \"diver.ply\""),
      "content: scene.toml:15: two parts are called 'tyre', the other one in line 7; give one of them another name");
  EXPECT_EQ(refusal_of_scene("trajectory = \"diver.csv\"", "trajectory = \"diver.csv\"\nposition_m = [0, 0]"),
            "content: scene.toml:19: position_m follows from trajectory; leave it out");
  EXPECT_EQ(refusal_of_scene("bury_m = 0.05", "rest = \"none\""),
            "content: scene.toml:12: rest = \"none\" needs a height: position_m = [x, y, z]");
  EXPECT_EQ(refusal_of_scene("velocity_mps", "bury_m = 0.1\nvelocity_mps"),
            "content: scene.toml:23: bury_m needs rest = \"ground\" or \"bed\"");
  EXPECT_EQ(refusal_of_scene("= 90", "= [1, 2]"),
            "content: scene.toml:24: turn_deg_per_s must be one number, or three");
  EXPECT_THAT(refusal_of_scene("count = [3, 8]", "count = [3, 4000]"),
              HasSubstr("scene.toml:25: scatter: count = 4000 does not fit"))
      << "discs of 1.5 m";
  EXPECT_THAT(refusal_of_scene("count = [3, 8]", "count = [9, 8]"), HasSubstr("least and most"));
  EXPECT_THAT(refusal_of_scene("min_distance_m = 1.5\n", ""), "no error");
  EXPECT_EQ(refusal_of_scene("count = [3, 8]\narea_m = [[0, -10], [30, -10], [30, 10], [0, 10]]\nmin_distance_m = 1.5",
                             "count = 65000\narea_m = [[0, -10], [30, -10], [30, 10], [0, 10]]"),
            "content: scene.toml:25: count of 65000 for each of 2 files: more than 65000 parts in all; ask for fewer");
  EXPECT_THAT(refusal_of_scene("[[0, -10], [30, -10], [30, 10], [0, 10]]", "[[0, 0], [1, 1], [2, 2]]"),
              HasSubstr("area_m = 0 m^2, must be a polygon"));
  EXPECT_THAT(refusal_of_scene("schema = 1", "schema = 2"), HasSubstr("this version reads schema 1"));
}
