// SPDX-License-Identifier: BSD-3-Clause
// Tests what `info` says of every kind of file and what comes next, and what `materials` lists.
#include <fmt/format.h>

#include "tool/first_hour_fixture.hpp"
#include "tool/survey_fixture.hpp"

using nlohmann::json;

TEST_F(FirstHour, info_names_materials_with_their_shares) {
  have("harbour.ply", "make-scene harbour --points 6000");
  double share = 0, points = 0;
  std::map<std::string, double> of;
  const json harbour = info("harbour.ply");
  for (const json& m : harbour["material_shares"]) {
    share += m["share"].get<double>(), points += m["points"].get<double>();
    of[m["name"]] = m["share"].get<double>();
  }
  EXPECT_NEAR(share, 1, 1e-6);
  EXPECT_EQ(points, harbour["points"].get<double>());
  EXPECT_GT(of.at("sand"), 0.7);
  EXPECT_LT(of.at("rubber"), 0.01);
  EXPECT_THAT(succeed("info harbour.ply"), HasSubstr("material   sand: "));
  succeed("prepare harbour.ply -q -o harbour.tiles");
  const json tiles = info("harbour.tiles");
  EXPECT_EQ(tiles["material_shares"].size(), of.size());
  for (const json& m : tiles["material_shares"]) EXPECT_NEAR(m["share"].get<double>(), of.at(m["name"]), 1e-6) << m;
}

TEST_F(FirstHour, info_proposes_commands_that_run_as_they_stand) {
  have("reef.pcd", "make-scene reef --bare --points 6000");
  const json reef = info("reef.pcd");
  EXPECT_THAT(next_of(reef), HasSubstr("insonify prepare reef.pcd --viewpoint x,y,z"));
  EXPECT_THAT(next_of(reef), HasSubstr("insonify materials"));
  // The viewpoint is the user's to fill in; later lines take the prepared scene.
  const std::string all = replaced(succeed("info reef.pcd"), "x,y,z", "0,0,0");
  for (const char* begin : {"insonify prepare ", "insonify ping ", "insonify make-mission "}) {
    const std::size_t at = all.find(begin);
    ASSERT_NE(at, all.npos) << begin;
    std::string command = all.substr(at + 9, all.find('\n', at) - at - 9);
    command.resize(std::min(command.size(), command.find('#')));
    succeed(command + " -q" + (command.starts_with("ping") ? " --no-picture" : ""));
  }
  EXPECT_GT(manifest_of("first")["sampling"]["scatterers"].get<int>(), 1000);
  EXPECT_THAT(info("first")["built_with"], json(manifest_of("first")["built_with"]));
  EXPECT_THAT(succeed("info first"), testing::ContainsRegex("built_with +.*VTK.*\n  next"));
  const json mission = info("mission.toml");
  EXPECT_EQ(mission["format"], "insonify mission");
  EXPECT_GE(mission["legs"].size(), 2U);
}

TEST_F(FirstHour, info_proposes_the_place_of_the_camera_for_a_cloud_in_its_axes) {
  // A wall 3 m ahead of a camera, and the same points below a position from which a scanner saw them.
  const auto scan = [&](const char* name, double z) {
    std::string text =
        "VERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 40\nHEIGHT 30\n"
        "VIEWPOINT 0 0 0 0 1 0 0\nPOINTS 1200\nDATA ascii\n";
    for (int row = 0; row < 30; ++row)
      for (int column = 0; column < 40; ++column)
        text += fmt::format("{} {} {}\n", 0.05 * (column - 20), 0.05 * (row - 15), z);
    write(name, text);
  };
  scan("ahead.pcd", 3);
  scan("below.pcd", -3);
  const std::string next = next_of(info("ahead.pcd"));
  EXPECT_THAT(next, HasSubstr("insonify ping ahead.pcd --sonar oculus-m750d --pose=0,0,0,90,-90,0 -o first"));
  EXPECT_THAT(next, Not(HasSubstr("make-mission"))) << "its lines would not be level";
  EXPECT_THAT(next_of(info("below.pcd")), HasSubstr("make-mission"));
  succeed("ping ahead.pcd --sonar oculus-m750d --pose=0,0,0,90,-90,0 --no-picture -q -o ahead");
  EXPECT_GT(manifest_of("ahead")["sampling"]["visible"].get<int>(), 1000);
}

TEST_F(SurveyTest, info_says_how_far_a_survey_and_a_head_are_and_what_comes_next) {
  const auto info = [&](const std::string& file) { return json_of("info " + file); };
  const json mission = info("m.toml");
  EXPECT_EQ(mission["format"], "insonify mission");
  EXPECT_EQ(mission["scene"], "harbour.ply");
  EXPECT_EQ(mission["heads"][0]["pings"], 13);
  EXPECT_EQ(mission["heads"][1]["range_m"], "1:6");
  EXPECT_THAT(next_of(mission), HasSubstr("insonify survey m.toml --plan"));

  survey("run", "--shard 0/2");
  EXPECT_EQ(info("run")["state"], "unfinished");
  EXPECT_THAT(next_of(info("run")), HasSubstr("insonify survey MISSION -o run"));
  survey("run");
  const json done = info("run"), head = info("run/fls");
  EXPECT_EQ(done["state"], "done, not merged");
  EXPECT_EQ(done["heads"][0]["blocks_done"], 5);
  EXPECT_THAT(next_of(done), HasSubstr("insonify merge run"));
  EXPECT_EQ(head["format"], "insonify survey, one head of it");
  EXPECT_EQ(head["pings"], 13);
  EXPECT_EQ(head["blocks_done"], 5);
  EXPECT_THAT(next_of(head), HasSubstr("insonify merge run"));
  EXPECT_THAT(succeed("info run/fls/"), HasSubstr("next"));
  EXPECT_EQ(info("run/survey.toml")["format"], "insonify survey");
  succeed("merge -q run");
  EXPECT_EQ(info("run")["state"], "merged");
  EXPECT_THAT(next_of(info("run")), HasSubstr("insonify image run --view track"));
  EXPECT_EQ(info("run/fls")["pings"], 13);
  EXPECT_EQ(info("run/fls/run.toml")["format"], "insonify settings of a run");
}

TEST_F(FirstHour, info_tells_toml_files_and_folders_apart) {
  const auto format = [&](const std::string& file) { return info(file)["format"].get<std::string>(); };
  write("sea.toml", "[water]\ntemperature_c = 4\n[surface]\nheight_m = 0\n");
  write("own.toml", succeed("materials --toml"));
  write("sonar.toml", succeed("sonars p900-45 --toml"));
  EXPECT_EQ(format("sea.toml"), "insonify environment");
  EXPECT_EQ(format("own.toml"), "insonify materials");
  EXPECT_EQ(format("sonar.toml"), "insonify sonar");
  EXPECT_THAT(next_of(info("own.toml")), HasSubstr("--materials own.toml"));
  EXPECT_THAT(next_of(info("sonar.toml")), HasSubstr("insonify sonars sonar.toml"));
  std::filesystem::create_directory(path("empty"));
  expect_refused("info empty", 3, {"empty", "cube.h5, survey.toml or manifest.json"});
  write("odd.toml", "[water]\nwarmth = 4\n");
  expect_refused("info odd.toml", 3, {"odd.toml:2", "warmth"});
}

TEST_F(FirstHour, info_describes_a_run_of_scatterers_which_has_no_settings_of_a_ping) {
  write("one.csv", "range_m,azimuth_rad,elevation_rad,sigma_m2,xi_re,xi_im\n7,0,0,0.01,0.6,0.8\n");
  succeed("synthesize one.csv -o one --sonar p900-45 --range 4:10 --no-picture -q");
  const json run = info("one");
  EXPECT_EQ(run["format"], info("one/cube.h5")["format"]);
  EXPECT_THAT(next_of(run), HasSubstr("insonify image one"));
}

TEST_F(FirstHour, materials_lists_names_numbers_and_the_law) {
  const std::string all = succeed("materials");
  for (const char* text : {"sand ", "lambert_mu_db", "coherent_fraction", "relief_slope", "-16.6", "law: Lambert"})
    EXPECT_THAT(all, HasSubstr(text));
  const json sand = json_of("materials sand");
  ASSERT_EQ(sand.size(), 1U);
  EXPECT_EQ(sand[0]["label"], 6);
  EXPECT_NEAR(sand[0]["lambert_mu_db"].get<double>(), -16.6, 1e-9);
  write("own.toml", "schema = 1\n[[material]]\nname = \"kelp\"\nlambert_mu_db = -21\n");
  EXPECT_THAT(succeed("materials own.toml"), HasSubstr("kelp"));
  expect_refused("materials sandd", 2, {"'sandd' is unknown; did you mean 'sand'?"});
  EXPECT_EQ(json_of("materials").size(), 25U + 2 * 11 + 13);
}
