// SPDX-License-Identifier: BSD-3-Clause
// Scenes of parts at the doors of the tool.
#include "scene_io/cloud_field.hpp"
#include "scene_io/load_scene.hpp"
#include "tool/parts_fixture.hpp"

TEST_F(PartsOfTool, info_lists_parts_where_they_stand) {
  const nlohmann::json info = json_of("info drawn.toml");
  EXPECT_EQ(info["format"], "insonify scene of parts");
  EXPECT_EQ(named(info["parts"], "harbour")["placed"], "captured");
  const nlohmann::json crate = named(info["parts"], "crate"), diver = named(info["parts"], "diver");
  EXPECT_EQ(crate["label"], "crate");
  EXPECT_THAT(crate["file"].get<std::string>(), HasSubstr("box.obj"));
  EXPECT_EQ(crate["position_m"][0], 8);
  EXPECT_NEAR(crate["yaw_pitch_roll_deg"][0].get<double>(), 30, 1e-9);
  EXPECT_EQ(diver["velocity_mps"][1], 1);
  EXPECT_EQ(diver["position_m"][1], -3);
  EXPECT_EQ(named(info["parts"], "pot-1")["label"], "pot");
  // Sizes are those of the mesh, whatever is buried, and as the scatter scales it.
  EXPECT_EQ(crate["scale"], 1);
  EXPECT_EQ(crate["size_m"], nlohmann::json({0.5, 0.5, 0.5}));
  const nlohmann::json pot = named(info["parts"], "pot-1");
  const double scale = pot["scale"];
  EXPECT_GT(scale, 0.5);
  EXPECT_LT(scale, 1);
  for (const auto& size : pot["size_m"]) EXPECT_DOUBLE_EQ(size.get<double>(), 0.5 * scale);
  EXPECT_FALSE(named(info["parts"], "harbour").contains("scale"));
  EXPECT_EQ(info["scatters"][0]["most"], 4);
  EXPECT_THAT(info["next"].dump(), HasSubstr("insonify ping drawn.toml"));
}

TEST_F(PartsOfTool, prepare_writes_one_cloud_with_the_part_of_each_surfel) {
  succeed("prepare scene.toml -q -o at_0.ply");
  succeed("prepare scene.toml -q -o at_3.ply --time 3");
  const nlohmann::json parts = json_of("info scene.toml")["parts"];
  const LoadedScene start = load_scene(path("at_0.ply")), later = load_scene(path("at_3.ply"));
  std::size_t surfels = 0;
  for (const auto& part : parts) surfels += part["surfels"].get<std::size_t>();
  EXPECT_EQ(start.scene.size(), surfels);
  const CloudField field = load_cloud_field(path("at_3.ply"), "instance");
  // In the order of names: crate, diver, harbour. The diver moved by 3 m along y, all else rests.
  std::array<std::size_t, 3> count{};
  for (std::size_t i = 0; i < surfels; ++i) {
    const auto part = static_cast<std::size_t>(field.value[i]) - 1;
    ++count.at(part);
    const Eigen::Vector3d by = later.scene.origin + later.scene.point[i].cast<double>() - start.scene.origin -
                               start.scene.point[i].cast<double>();
    EXPECT_LT((by - Eigen::Vector3d(0, part == 1 ? 3 : 0, 0)).norm(), 1e-5);
  }
  EXPECT_EQ(count[0], named(parts, "crate")["surfels"]);
  EXPECT_EQ(count[1], named(parts, "diver")["surfels"]);
  EXPECT_EQ(later.scene.materials[later.scene.material[0]].name, "steel");
  expect_refused("prepare harbour.ply -o again.ply --time 3", 2, {"--time", "harbour.ply", "no scene of parts"});
}

TEST_F(PartsOfTool, a_ping_hears_parts_where_they_are_at_its_time) {
  succeed("ping scene.toml -o a --time 1" + parts_head);
  succeed("ping scene.toml -o b --time 4" + parts_head);
  EXPECT_NE(read("a/cube.h5"), read("b/cube.h5"));
  const nlohmann::json parts = manifest_of("b")["scene"]["parts"];
  EXPECT_EQ(named(parts, "diver")["position_m"][1], 1);
  succeed("ping --run a/run.toml -o again -q --no-picture");
  EXPECT_EQ(read("a/cube.h5"), read("again/cube.h5"));
  EXPECT_THAT(succeed("plan scene.toml --sonar p900-45 --pose=0,0,-3,0,10,0"), HasSubstr("direct"));
  succeed("image scene.toml --view scene -q -o scene.png");
  succeed("image b --view scene -q -o run.png");
  EXPECT_TRUE(file_exists(path("run.png")));
}

TEST_F(PartsOfTool, a_bed_of_tiles_is_read_where_a_ping_reaches) {
  succeed("prepare harbour.ply -q -o harbour.tiles");
  write("tiled.toml", replaced(harbour_with_parts, "\"harbour.ply\"", "\"harbour.tiles\""));
  succeed("ping scene.toml -o whole --time 1" + parts_head);
  succeed("ping tiled.toml -o read --time 1" + parts_head);
  const Ping whole = ping_of("whole"), tiled = ping_of("read");
  const double energy = whole.pressure.matrix().squaredNorm();
  EXPECT_LT((whole.pressure - tiled.pressure).matrix().squaredNorm(), 1e-10 * energy);
  EXPECT_EQ(json_of("info tiled.toml")["parts"].size(), 3U);
  expect_refused("ping tiled.toml -o big --memory-limit 0.0001" + parts_head, 4, {"harbour.tiles", "raise the limit"});
}

TEST_F(PartsOfTool, a_survey_of_moving_and_drawn_parts_does_not_depend_on_shards_and_threads) {
  mission_over("drawn.toml", "[randomise]\nscene = \"ping\"\n");
  survey("one", "--threads 1");
  survey("two", "--threads 2");
  survey("shards", "--shard 1/2");
  survey("shards", "--shard 0/2");
  const auto digests = merged_cubes("one", {"fls", "turning"});
  EXPECT_EQ(digests, merged_cubes("two", {"fls", "turning"}));
  EXPECT_EQ(digests, merged_cubes("shards", {"fls", "turning"}));
  // Drawn once, or every third ping, it is another survey.
  mission_over("drawn.toml");
  survey("once");
  EXPECT_NE(digests, merged_cubes("once", {"fls", "turning"}));
  mission_over("drawn.toml", "[randomise]\nscene = 3\n");
  survey("third");
  EXPECT_NE(digests, merged_cubes("third", {"fls", "turning"}));
  // The digest of a survey is that of all files of its scene.
  write("box.obj", box_obj + "# other\n");
  expect_refused("survey m.toml -o third", 3, {"third"});
}

TEST_F(PartsOfTool, a_survey_of_what_rests_prepares_it_once) {
  write("still.toml", replaced(harbour_with_parts, "trajectory = \"swim.csv\"", "position_m = [6, 0, -2]"));
  mission_over("still.toml");
  survey("one", "--threads 1");
  mission_over("still.toml", "[randomise]\nscene = \"survey\"\n");
  survey("two");
  EXPECT_EQ(merged_cubes("one", {"fls"}), merged_cubes("two", {"fls"}));
}

TEST_F(PartsOfTool, scenes_of_parts_are_parts) {
  write("raft.toml",
        "schema = 1\n[[part]]\nname = \"left\"\nfile = \"box.obj\"\nposition_m = [0, 0, 0]\n"
        "[[part]]\nname = \"right\"\nfile = \"box.obj\"\nposition_m = [0, 2, 0]\n");
  write("outer.toml", replaced(harbour_with_parts, "file = \"box.obj\"\nmaterial = \"steel\"", "file = \"raft.toml\""));
  const nlohmann::json crate = named(json_of("info outer.toml")["parts"], "crate");
  const nlohmann::json raft = json_of("info raft.toml")["parts"];
  EXPECT_LE(crate["surfels"], 2 * raft[0]["surfels"].get<std::size_t>()) << "less what is buried";
  EXPECT_GT(crate["surfels"], raft[0]["surfels"].get<std::size_t>());
}

TEST_F(PartsOfTool, what_cannot_be_is_refused_with_file_line_and_remedy) {
  const auto refused = [&](const std::string& from, const std::string& to, int code,
                           const std::vector<std::string>& words) {
    write("bad.toml", replaced(harbour_with_parts + strewn_pots, from, to));
    expect_refused("ping bad.toml -o out" + parts_head, code, words);
  };
  refused("\"harbour.ply\"", "\"lost.ply\"", 3, {"bad.toml:3", "lost.ply", "no file"});
  refused("\"harbour.ply\"", "\"bad.toml\"", 3, {"bad.toml:3", "a scene cannot hold itself"});
  refused("material = \"rock\"", "material = \"rokc\"", 3, {"bad.toml:13", "rokc", "did you mean 'rock'"});
  // The line is that of the key: values of a file's meaning are read with their keys, not when the file is loaded.
  refused("file = \"box.obj\"\nmaterial = \"rock\"", "unit = \"yd\"\nfile = \"box.obj\"", 3, {"bad.toml:13", "yd"});
  refused("[8, 1]", "[8, nan]", 3, {"bad.toml:8", "position_m"});
  refused("[8, 1]", "[8, 900]", 3, {"bad.toml", "part 'crate' at x = 8, y = 900 m: no ground beneath it"});
  refused("name = \"diver\"", "name = \"crate\"", 3, {"bad.toml:11", "two parts are called 'crate'"});
  refused("[12, 4]", "[12, 900]", 3, {"bad.toml", "corner (12, 900) of area_m is outside the bed"});
  refused("count = [2, 4]", "count = [2, 400]", 3, {"bad.toml:16", "count = 400 does not fit", "min_distance_m"});
  refused("count = [2, 4]", "count = 65000", 3, {"bad.toml:16"});
  refused("count", "cuont", 3, {"bad.toml:20", "did you mean 'scatter.count'"});
  write("flat.ply",
        "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\n"
        "property float nx\nproperty float ny\nproperty float nz\nproperty float area\nend_header\n"
        "0 0 0 0 0 1 0\n");
  refused("file = \"box.obj\"\nmaterial = \"rock\"", "file = \"flat.ply\"", 3,
          {"bad.toml", "part 'diver' has no area"});
  expect_refused("ping scene.toml -o out --time 7" + parts_head, 3,
                 {"scene.toml", "part 'diver'", "from 0 to 6 s", "asked for at 7 s"});
  expect_refused("ping scene.toml -o out --material sand" + parts_head, 2, {"--material", "says itself"});
  expect_refused("ping lost.toml -o out" + parts_head, 4, {"lost.toml"});
  mission_over("scene.toml", "[randomise]\nscene = \"ping\"\n");
  expect_refused("survey m.toml -o out", 3, {"m.toml", "[[scatter]]"});
  mission_over("harbour.ply", "[randomise]\nscene = \"ping\"\n");
  expect_refused("survey m.toml -o out", 3, {"m.toml", "harbour.ply is not"});
  mission_over("scene.toml");
  write("m.toml", replaced(read("m.toml"), "seed = 7", "seed = 7\ncoverage = true"));
  expect_refused("survey m.toml -o out", 3, {"m.toml", "coverage", "scene of parts"});
  write("short.toml", replaced(harbour_with_parts, "swim.csv", "short.csv"));
  write("short.csv", replaced(swim, "\n6,6,3", "\n2,6,3"));
  mission_over("short.toml");
  expect_refused("survey m.toml -o out", 3, {"short.toml", "part 'diver'", "from 0 to 2 s"});
}
