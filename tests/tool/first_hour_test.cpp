// SPDX-License-Identifier: BSD-3-Clause
// Tests what a new user meets: default ranges, notes with a remedy, missions to begin with, and heights of soundings
// against the scene.
#include <fmt/format.h>

#include "files/sha256.hpp"
#include "tool/first_hour_fixture.hpp"
#include "view/grey_file.hpp"
#include "view/test_pictures.hpp"

using nlohmann::json;

TEST_F(FirstHour, a_ping_without_a_range_ends_where_the_scene_does) {
  have_plane();
  // The farthest corner of the plane, x from 0 to 8 and y from -4 to 4 m, is sqrt(8^2 + 4^2 + 2^2) = 9.17 m away; 1 % more in two digits.
  const std::string head = "--sonar oculus-m750d --set sonar.beams=16 --no-picture -q ";
  succeed("ping plane.ply --pose=0,0,2,0,20,0 " + head + "-o near");
  EXPECT_EQ(info("near")["min_range_m"], 0.1);
  EXPECT_NEAR(info("near")["max_range_m"].get<double>(), 9.3, 1e-9);
  succeed("ping plane.ply --pose=0,0,2,0,20,0 --range 0.1:9.3 " + head + "-o asked");
  EXPECT_EQ(insonify::sha256_of_file(path("near/cube.h5")), insonify::sha256_of_file(path("asked/cube.h5")));
  // A run again has its range, wherever the head is then.
  succeed("ping --run near/run.toml --no-picture -q -o again");
  EXPECT_EQ(insonify::sha256_of_file(path("near/cube.h5")), insonify::sha256_of_file(path("again/cube.h5")));
  succeed("ping --run near/run.toml --pose=2,0,2,0,20,0 --no-picture -q -o moved");
  EXPECT_NEAR(info("moved")["max_range_m"].get<double>(), 9.3, 1e-9);
  // A range that is set stands, and no range is longer than the sonar's own.
  succeed("ping plane.ply --pose=0,0,2,0,20,0 --set sonar.max_range_m=12 " + head + "-o set");
  EXPECT_EQ(info("set")["max_range_m"], 12.0);
  succeed("ping plane.ply --pose=-46,0,2,0,2,0 --sonar p900-45 --set sonar.beams=8 --no-picture -q -o far");
  EXPECT_NEAR(info("far")["max_range_m"].get<double>(), 55, 1e-9);
  // Sound by way of the surface, 10 m above the bed, has sqrt(80 + 18^2) = 20.1 m to the corner.
  succeed("ping plane.ply --pose=0,0,2,0,20,0 --set surface.height_m=10 " + head + "-o sea");
  EXPECT_NEAR(info("sea")["max_range_m"].get<double>(), 21, 1e-9);
  // Plan and tiles take the same.
  succeed("prepare plane.ply -q -o plane.tiles");
  succeed("ping plane.tiles --pose=0,0,2,0,20,0 " + head + "-o tiles");
  EXPECT_NEAR(info("tiles")["max_range_m"].get<double>(), 9.3, 1e-9);
}

TEST_F(FirstHour, notes_say_what_is_wrong_with_range_and_pose_and_what_to_do) {
  have_plane();
  EXPECT_EQ(notes("--pose=0,0,2,0,20,0 --range 2:12"), "");
  EXPECT_THAT(notes("--pose=0,0,2,0,20,0 --range 2:40"),
              testing::AllOf(HasSubstr("ends at 40 m, but the scene reaches only to 9.1"),
                             HasSubstr("range 2:9.3 holds the whole")));
  EXPECT_THAT(
      notes("--pose=-46,0,2,0,2,0 --range 1:80"),
      testing::AllOf(HasSubstr("ends at 80 m, but p900-45 hears only to 60 m"), HasSubstr("--range 1:60 stays")));
  EXPECT_THAT(notes("--pose=4,0,-2,0,-20,0 --range 2:9"), HasSubstr("the head is 2 m behind the nearest surface"));
  EXPECT_THAT(notes("--pose=4,0,0.001,0,20,0 --range 2:9"), HasSubstr("the head is within the surface"));
  // Beside the edge of the scan, and lower than it, the head is behind nothing.
  EXPECT_THAT(notes("--pose=-4,0,-0.5,0,0,0 --range 2:13"), Not(HasSubstr("behind")));
  EXPECT_EQ(manifest_of("noted")["notes"].size(), 1U);  // of the silent ping: the plane has its back to the head
}

TEST_F(FirstHour, a_silent_ping_says_which_pose_is_not) {
  have_plane();
  const std::string note = notes("--pose=0,0,2,180,0,0 --range 2:9");
  EXPECT_THAT(note, HasSubstr("the ping is silent"));
  const std::size_t begin = note.find("--pose=");
  ASSERT_NE(begin, note.npos) << note;
  const std::string remedy = note.substr(begin, note.find(' ', begin) - begin);
  EXPECT_THAT(remedy, testing::StartsWith("--pose=0,0,2,"));
  EXPECT_THAT(notes(remedy + " --range 2:9"), Not(HasSubstr("silent")));
  EXPECT_GT(manifest_of("noted")["sampling"]["scatterers"].get<int>(), 0);
  // Out of range it takes another range too, and what has its back to the head is no matter of the pose's angles.
  EXPECT_THAT(notes("--pose=-16,0,2,0,0,0 --range 2:9"),
              testing::AllOf(testing::ContainsRegex("--pose=-16,0,2,-?0[.0-9]*,5.7[0-9]*,0 looks at the scene"),
                             HasSubstr("with --range 2:25")));
  // No range beyond the 60 m of the sonar is proposed.
  EXPECT_THAT(notes("--pose=-57,0,2,0,0,0 --range 2:9"), HasSubstr("with --range 2:60"));
  EXPECT_THAT(notes("--pose=-80,0,2,0,0,0 --range 2:9"),
              testing::AllOf(HasSubstr("move the head nearer too"), HasSubstr("p900-45 hears to 60 m"),
                             Not(HasSubstr("--range"))));
  EXPECT_THAT(notes("--pose=4,0,-2,0,-40,0 --range 2:9"), HasSubstr("face away from the head"));
}

TEST_F(FirstHour, fan_png_is_as_high_as_its_fan) {
  have_plane();
  succeed("ping plane.ply --sonar oculus-m750d --set sonar.beams=32 --pose=0,0,2,0,20,0 -q -o wide");
  const ReadPicture picture = read_png(path("wide/fan.png"));
  EXPECT_EQ(picture.width, 1400);
  EXPECT_LT(picture.height, 960);
  succeed("image wide -q -o default.png");
  EXPECT_EQ(read("default.png"), read("wide/fan.png"));
  succeed("image wide -q --size 1400x1050 -o whole.png");
  EXPECT_EQ(read_png(path("whole.png")).height, 1050);
}

TEST_F(FirstHour, a_mission_to_begin_with_reaches_to_the_end_of_the_scene_and_has_soundings) {
  have_plane();
  succeed("make-mission lawnmower --scene plane.ply --sonar em2040 --centre 4,0,5 --size 4,0 -q -o m.toml");
  const std::string mission = read("m.toml");
  EXPECT_THAT(mission, HasSubstr("range = \"0.5:8.9\""));  // from x = 2 to the corner: sqrt(6^2 + 4^2 + 5^2) = 8.77
  EXPECT_THAT(mission, HasSubstr("split = true"));
  EXPECT_THAT(mission, HasSubstr("noise = true"));
  // A metre above it, its beams meet the bed within 2.5 m.
  succeed("make-mission lawnmower --scene plane.ply --sonar em2040 --centre 4,0,1 --size 4,0 -q -o low.toml");
  EXPECT_THAT(read("low.toml"), HasSubstr("range = \"0.5:2.6\""));
  succeed("make-mission lawnmower --scene plane.ply --sonar p900-45 --centre 4,0,5 --size 4,0 -q -o ahead.toml");
  EXPECT_THAT(read("ahead.toml"), Not(HasSubstr("[ping]")));
  succeed("make-mission orbit --scene plane.ply --labels -q -o labels.toml");
  EXPECT_THAT(read("labels.toml"), HasSubstr("[ping]\nkeep = [\"labels\"]"));
  succeed("make-mission lawnmower --scene plane.ply --sonar em2040 --centre 4,0,5 --size 4,0 --labels -q -o both.toml");
  EXPECT_THAT(read("both.toml"), HasSubstr("keep = [\"contributors\"]")) << "its soundings need samples";
  EXPECT_THAT(run("make-mission lawnmower --scene later.ply -o later.toml").err, HasSubstr("does not exist yet"));
}

// A mission along x, 2 m above the plane.
std::string line_over_plane(double begin, double end, double speed, const std::string& head) {
  return fmt::format(R"(schema = 1
[survey]
scene = "plane.ply"
[trajectory]
waypoints_m = [[{0}, 0, 2], [{1}, 0, 2]]
speed_m_s = {2}
[[head]]
name = "fls"
sonar = "p900-45"
pitch_deg = -20
{3}
[ping]
scatterers_per_cell = 0
)",
                     begin, end, speed, head);
}

TEST_F(FirstHour, a_survey_notes_silent_pings_and_a_range_far_beyond_the_scene) {
  have_plane();
  write("m.toml", line_over_plane(-4, 16, 1, "set = [\"sonar.beams=8\"]\nrange = \"2:55\"\nevery_m = 4"));
  const ToolResult result = run("survey m.toml -o run");
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.err, HasSubstr("head fls: the range ends at 55 m, but the scene reaches only to 12.8 m"));
  EXPECT_THAT(result.err, HasSubstr("1 of 5 pings are silent"));
}

// A ping of each head, and more only if they are a twentieth of the survey at most.
TEST_F(FirstHour, a_plan_takes_a_twentieth_of_its_survey) {
  have_plane();
  const auto plan = [&](double every) {
    const std::string head = fmt::format("set = [\"sonar.beams=32\"]\nrange = \"2:9\"\nevery_m = {}", every);
    write("m.toml", line_over_plane(0, 8, 0.05, head));
    return json_of("survey m.toml --plan -j1");
  };
  const json few = plan(2);
  EXPECT_EQ(few["heads"][0]["pings"], 4);
  EXPECT_EQ(few["heads"][0]["pings_tried"], 1);
  const json many = plan(0.001);
  EXPECT_EQ(many["heads"][0]["pings"], 8000);
  EXPECT_EQ(many["heads"][0]["pings_tried"], 5);
  EXPECT_LT(many["cpu_seconds_to_plan"].get<double>(), 0.05 * 3600 * many["hours"].get<double>());
}

TEST_F(FirstHour, help_of_ping_stands_in_groups) {
  const std::string help = succeed("ping --help");
  std::size_t last = 0;
  for (const auto& [title, option] :
       std::initializer_list<std::pair<const char*, const char*>>{{"\nScene:\n", "--viewpoint"},
                                                                  {"\nSonar and water:\n", "--range"},
                                                                  {"\nAccuracy:\n", "--accuracy-db"},
                                                                  {"\nOutput:\n", "--keep "},
                                                                  {"\nHead:\n", "--pose"},
                                                                  {"\nSound:\n", "--multipath"},
                                                                  {"\nDetections:\n", "--threshold"}}) {
    const std::size_t at = help.find(title);
    ASSERT_NE(at, help.npos) << title;
    EXPECT_GT(at, last) << title;
    const std::size_t end = help.find("\n\n", at + 1), named = help.find(std::string("  ") + option, at);
    EXPECT_LT(named, end) << option << " is not under " << title;
    last = at;
  }
}

TEST_F(FirstHour, min_level_leaves_out_the_labels_of_black_pixels_alone) {
  have("harbour.ply", "make-scene harbour --points 30000");
  have("labelled",
       "ping harbour.ply --sonar p900-45 --set sonar.beams=48 --pose=0,0,-3,0,10,0 --range 2:15 --keep contributors "
       "--no-picture");
  const auto counts = [&](const std::string& set) {
    const GreyPicture image = load_grey_png(path(set + "/polar/images/000_000000.png")),
                      mask = load_grey_png(path(set + "/polar/masks/000_000000.png"));
    std::array<std::size_t, 3> n{};  // black pixels of a surface, other pixels of a surface, of shadow
    for (Eigen::Index i = 0; i < mask.value.size(); ++i) {
      const auto value = mask.value.data()[i];
      if (value == 1) ++n[2];
      if (value > 1) ++n[image.value.data()[i] == 0 ? 0 : 1];
    }
    return n;
  };
  // In a window of 20 dB much of the speckle is black.
  succeed("dataset labelled -q --window 150:170 -o all");
  succeed("dataset labelled -q --window 150:170 --min-level black -o bright");
  succeed("dataset labelled -q --window 150:170 --min-level 150 -o number");
  const auto all = counts("all"), bright = counts("bright");
  EXPECT_GT(all[0], 100U);
  EXPECT_EQ(bright[0], 0U);
  EXPECT_EQ(bright[1], all[1]);
  EXPECT_EQ(bright[2], all[2]);
  EXPECT_EQ(read("number/polar/masks/000_000000.png"), read("bright/polar/masks/000_000000.png"));
  EXPECT_THAT(read("bright/README.md"), HasSubstr("surfaces in pixels below 150 dB"));
  expect_refused("dataset labelled --min-level dark -o refused", 2, {"--min-level", "dark"});

  const auto samples = [&](const std::string& options) {
    succeed("image labelled --view labels -q --force -o labels.png " + options);
    std::size_t nothing = 0;
    const json palette = read_json("labels.json");
    for (const json& c : palette["classes"])
      if (c["value"] == 0) nothing = c["samples"].get<std::size_t>();
    return nothing;
  };
  EXPECT_GT(samples("--min-level black --max 170 --window 20"), samples("") + 100);
  expect_refused("image labelled --min-level black -o fan.png", 2, {"--min-level goes with --view labels"});
}

TEST_F(FirstHour, soundings_are_compared_with_their_scene) {
  have("grid.ply", "make-scene plane --size 8,8 --points 60000");
  // Alternately 0.03 and 0.07 m above the plane in cells of half a metre: bias 0.05, deviation 0.02; one is 2 m above.
  std::string rows = "beam,z_m,x_m,method,y_m\n";
  for (int row = -6; row < 6; ++row)
    for (int column = -6; column < 6; ++column)
      rows += "1," + std::to_string((row + column) % 2 == 0 ? 0.03 : 0.07) + "," + std::to_string(0.5 * column + 4.25) +
              ",phase," + std::to_string(0.5 * row + 0.25) + "\n";
  write("soundings.csv", rows);
  const json r = json_of("compare soundings.csv grid.ply --cell 0.5");
  EXPECT_EQ(r["soundings"], 144);
  EXPECT_EQ(r["cells_compared"], 144);
  EXPECT_NEAR(r["bias_m"].get<double>(), 0.05, 1e-4);
  EXPECT_NEAR(r["deviation_m"].get<double>(), 0.02, 2e-4);
  EXPECT_EQ(r["beyond_half_metre"], 0);
  write("soundings.csv", rows + "1,2,4.25,phase,0.25\n");
  const json off = json_of("compare soundings.csv grid.ply --cell 0.5");
  EXPECT_EQ(off["beyond_half_metre"], 1);
  EXPECT_NEAR(off["largest_m"].get<double>(), (2 + 0.03) / 2, 1e-3);
  EXPECT_THAT(succeed("compare soundings.csv grid.ply --cell 0.5"), HasSubstr("bias"));
  write("soundings.csv", "x_m,y_m\n1,2\n");
  expect_refused("compare soundings.csv grid.ply", 3, {"soundings.csv:1", "no column z_m"});
}
