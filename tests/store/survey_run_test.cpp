// SPDX-License-Identifier: BSD-3-Clause
// Blocks of a survey on disk, and cubes made of them.
#include "store/survey_run.hpp"

#include "store/concatenate_cube_files.hpp"
#include "store/cube.hpp"
#include "support/test.hpp"

namespace fs = std::filesystem;

namespace {

const SurveyRun small_run{"abc", {{"fls", 10, 4}}};

BlockFiles finished_block() {
  open_survey_run(own_path("run"), small_run);
  const BlockFiles files = block_files(own_path("run"), "fls", 1);
  own_file("run/fls/blocks/000001.h5", "cube");
  own_file("run/fls/blocks/000001.ply", "returns");
  own_file("run/fls/blocks/.000001.h5.tmp-17", "of a killed process");
  own_file("run/fls/blocks/000001.partial.h5", "of an interrupted one");
  finish_block(files, "abc", {{5, "said \"no\""}});
  return files;
}

Cube cube_of(float value, std::size_t pings, std::vector<std::string> layers, bool scan) {
  Cube cube;
  cube.sonar = "test";
  cube.sound_speed = 1500;
  cube.seed = 5;
  for (std::size_t p = 0; p < pings; ++p) {
    Ping ping;
    ping.number = static_cast<std::int64_t>(value) + static_cast<std::int64_t>(p);
    ping.time = 0.5 * static_cast<double>(ping.number);
    ping.world_from_head.translation().x() = ping.time;
    ping.fan = make_fan(3, radians(40), radians(1), radians(20));
    ping.gate = {1, 2, 0.1};
    ping.pressure = ComplexGridF::Constant(3, 10, static_cast<float>(ping.number));
    ping.unknown = Grid<std::uint8_t>::Constant(3, 10, 1);
    for (const auto& layer : layers) ping.layers.push_back({layer, ping.pressure});
    if (scan) ping.scan = ScanDirection{ping.number / 2, 0.25 * static_cast<double>(ping.number)};
    cube.pings.push_back(ping);
  }
  return cube;
}

}  // namespace

TEST(SurveyRun, is_a_folder_of_one_mission) {
  open_survey_run(own_path("run"), small_run);
  open_survey_run(own_path("run"), small_run);
  EXPECT_EQ(load_survey_run(own_path("run")).heads, small_run.heads);
  SurveyRun other = small_run;
  other.mission_sha256 = "abd";
  EXPECT_EQ(error_of([&] { open_survey_run(own_path("run"), other); }, ErrorKind::content),
            own_path("run") +
                ": holds a survey of another mission, or of this one with other inputs (SHA-256 abc, not abd);"
                " choose another folder");
  other = small_run;
  other.heads[0].pings_per_block = 8;
  EXPECT_EQ(error_of([&] { open_survey_run(own_path("run"), other); }, ErrorKind::argument),
            own_path("run") +
                ": blocks of head fls hold 4 pings, not 8 as asked for; leave the number out to go on, or"
                " choose another folder");
  fs::create_directory(own_path("mine"));
  own_file("mine/thesis.txt", "");
  EXPECT_THAT(error_of([] { open_survey_run(own_path("mine"), small_run); }, ErrorKind::file),
              HasSubstr("holds thesis.txt but no survey.toml, so it is no survey"));
  EXPECT_THAT(error_of([] { load_survey_run(own_path("mine")); }, ErrorKind::file),
              HasSubstr("not the folder of a survey"));
}

TEST(SurveyRun, marks_finished_blocks_with_their_digests_and_failures) {
  const BlockFiles files = finished_block();
  EXPECT_FALSE(find_mark(block_files(own_path("run"), "fls", 0), "abc"));
  const auto mark = find_mark(files, "abc");
  ASSERT_TRUE(mark);
  ASSERT_EQ(mark->failed.size(), 1U);
  EXPECT_EQ(mark->failed[0].number, 5);
  EXPECT_EQ(mark->failed[0].reason, "said \"no\"");
  require_unchanged(files, *mark);
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(files.folder)) names.insert(entry.path().filename().string());
  EXPECT_EQ(names, (std::set<std::string>{"000001.done", "000001.h5", "000001.ply"})) << "nothing is left over";
}

TEST(SurveyRun, takes_a_mark_that_is_not_whole_for_none) {
  const BlockFiles files = finished_block();
  const std::string whole = file_bytes(files.mark);
  ASSERT_TRUE(find_mark(files, "abc"));
  for (std::size_t kept = 0; kept < whole.size(); ++kept) {
    own_file("run/fls/blocks/000001.done", whole.substr(0, kept));
    EXPECT_FALSE(find_mark(files, "abc")) << kept << " bytes of " << whole.size();
  }
  own_file("run/fls/blocks/000001.done", std::string(whole.size(), '\0'));
  EXPECT_FALSE(find_mark(files, "abc"));
  own_file("run/fls/blocks/000001.done", std::string(16, '\0') + whole.substr(16));
  EXPECT_FALSE(find_mark(files, "abc"));
  EXPECT_THAT(stored_blocks(own_path("run"), small_run, small_run.heads[0]), testing::IsEmpty());
  own_file("run/fls/blocks/000001.done", whole);
  EXPECT_EQ(stored_blocks(own_path("run"), small_run, small_run.heads[0]).size(), 1U);
  EXPECT_THAT(error_of([] { all_blocks(own_path("run"), small_run, small_run.heads[0]); }, ErrorKind::content),
              HasSubstr("run: block 0 of head fls is not done"));
}

TEST(SurveyRun, refuses_heads_that_no_mission_has) {
  open_survey_run(own_path("run"), small_run);
  const std::string good = file_bytes(own_path("run/survey.toml"));
  const auto refuse = [&](const std::string& from, const std::string& to, const std::string& said) {
    own_file("run/survey.toml", replaced(good, from, to));
    expect_error(ErrorKind::content, {"survey.toml:", said}, [] { load_survey_run(own_path("run")); });
  };
  refuse("pings = 10\n", "pings = 1e300\n", "pings = 1e+300, must be a whole number from 1 to 100000000");
  refuse("pings = 10\n", "pings = nan\n", "pings = nan, must be a whole number");
  refuse("pings = 10\n", "pings = 1.5\n", "pings = 1.5, must be a whole number");
  refuse("pings_per_block = 4", "pings_per_block = 0", "pings_per_block = 0, must be a whole number from 1");
  refuse("\"fls\"", "\"../../fls\"", "must be a name of its own, of letters, digits");
  refuse("[[head]]", "[[feet]]", "lists no [[head]]");
  own_file("run/survey.toml", good + "[[head]]\nname = \"fls\"\npings = 1\npings_per_block = 1\n");
  expect_error(ErrorKind::content, {"must be a name of its own"}, [] { load_survey_run(own_path("run")); });
}

// A list of 1e8 blocks would take 40 GB.
TEST(SurveyRun, costs_what_is_there_and_not_what_is_announced) {
  SurveyRun run = small_run;
  run.heads[0] = {"fls", 100000000, 1};
  open_survey_run(own_path("run"), run);
  EXPECT_THAT(stored_blocks(own_path("run"), run, run.heads[0]), testing::IsEmpty());
}

TEST(SurveyRun, sees_changed_files_and_marks_of_another_mission) {
  const BlockFiles files = finished_block();
  EXPECT_THAT(error_of([&] { find_mark(files, "xyz"); }, ErrorKind::content), HasSubstr("is of another mission"));
  own_file("run/fls/blocks/000001.ply", "Returns");
  EXPECT_THAT(error_of([&] { require_unchanged(files, *find_mark(files, "abc")); }, ErrorKind::content),
              HasSubstr("000001.ply: was changed since it was made"));
}

TEST(JoinCubes, refers_to_the_parts_or_copies_them) {
  for (const bool scan : {false, true}) {
    fs::create_directories(own_path("parts"));
    write_cube(own_path("parts/0.h5"), cube_of(0, 2, {"direct", "noise"}, scan));
    write_cube(own_path("parts/1.h5"), cube_of(2, 3, {"direct", "noise"}, scan));
    write_cube(own_path("once.h5"), cube_of(0, 5, {"direct", "noise"}, scan));
    for (const bool copy : {false, true}) {
      concatenate_cube_files(own_path("all.h5"), {own_path("parts/0.h5"), own_path("parts/1.h5")}, copy);
      const Cube all = read_cube(own_path("all.h5"));
      write_cube(own_path("again.h5"), all);
      EXPECT_EQ(file_bytes(own_path("again.h5")), file_bytes(own_path("once.h5"))) << "all that a cube holds";
    }
    fs::remove_all(own_path("parts"));
    EXPECT_EQ(read_cube(own_path("all.h5")).pings.size(), 5U) << "the copy stands alone";
  }
}

TEST(JoinCubes, gathers_the_notes_of_the_parts) {
  const auto noted = [](Cube cube, std::vector<PingNote> notes) {
    cube.notes = std::move(notes);
    return cube;
  };
  write_cube(own_path("0.h5"), cube_of(0, 2, {"direct"}, false));
  write_cube(own_path("1.h5"), noted(cube_of(2, 2, {"direct"}, false), {{"silent", "no surfel", 2, 2}}));
  write_cube(own_path("2.h5"),
             noted(cube_of(4, 1, {"direct"}, false), {{"backs", "97 %", 1, 4}, {"silent", "no", 1, 4}}));
  const std::vector<PingNote> expected = {{"silent", "no surfel", 3, 2}, {"backs", "97 %", 1, 4}};
  for (const bool copy : {false, true}) {
    concatenate_cube_files(own_path("all.h5"), {own_path("0.h5"), own_path("1.h5"), own_path("2.h5")}, copy);
    EXPECT_EQ(read_cube(own_path("all.h5")).notes, expected);
    concatenate_cube_files(own_path("all.h5"), {own_path("2.h5"), own_path("0.h5"), own_path("1.h5")}, copy);
    EXPECT_EQ(read_cube(own_path("all.h5")).notes, expected);
  }
}

// The first part has one water, which its attributes say; the second has another in each ping.
TEST(JoinCubes, keeps_the_water_of_each_ping) {
  const auto in_water = [](Cube cube, std::size_t from) {
    for (std::size_t p = 0; p < cube.pings.size(); ++p) {
      const double deeper = static_cast<double>(std::max(from + p, std::size_t{1}) - 1);
      cube.pings[p].sound_speed = 1500 - deeper, cube.pings[p].absorption_db_per_m = 0.1 + 0.01 * deeper;
    }
    cube.sound_speed = cube.pings[0].sound_speed, cube.absorption_db_per_m = cube.pings[0].absorption_db_per_m;
    return cube;
  };
  write_cube(own_path("0.h5"), in_water(cube_of(0, 2, {}, false), 0));
  write_cube(own_path("1.h5"), in_water(cube_of(2, 3, {}, false), 2));
  write_cube(own_path("once.h5"), in_water(cube_of(0, 5, {}, false), 0));
  for (const bool copy : {false, true}) {
    concatenate_cube_files(own_path("all.h5"), {own_path("0.h5"), own_path("1.h5")}, copy);
    const Cube all = read_cube(own_path("all.h5"));
    EXPECT_EQ(all.pings[1].sound_speed, 1500);
    EXPECT_EQ(all.pings[4].sound_speed, 1497);
    EXPECT_EQ(all.pings[4].absorption_db_per_m, 0.1 + 0.01 * 3);
    write_cube(own_path("again.h5"), all);
    EXPECT_EQ(file_bytes(own_path("again.h5")), file_bytes(own_path("once.h5")));
  }
}

// The first part is of a head at rest.
TEST(JoinCubes, keeps_the_motion_of_each_ping) {
  const auto going = [](Cube cube, std::size_t from) {
    for (std::size_t p = from < 2 ? 2 - from : 0; p < cube.pings.size(); ++p)
      cube.pings[p].motion = {{1, -2, 0.25 * static_cast<double>(from + p)}, {0.5, 0, -0.125}};
    return cube;
  };
  write_cube(own_path("0.h5"), cube_of(0, 2, {}, false));
  write_cube(own_path("1.h5"), going(cube_of(2, 3, {}, false), 2));
  write_cube(own_path("once.h5"), going(cube_of(0, 5, {}, false), 0));
  for (const bool copy : {false, true}) {
    concatenate_cube_files(own_path("all.h5"), {own_path("0.h5"), own_path("1.h5")}, copy);
    const Cube all = read_cube(own_path("all.h5"));
    EXPECT_TRUE(all.pings[1].motion.none());
    EXPECT_EQ(all.pings[4].motion.velocity, Eigen::Vector3d(1, -2, 1));
    EXPECT_EQ(all.pings[4].motion.turn_rate, Eigen::Vector3d(0.5, 0, -0.125));
    write_cube(own_path("again.h5"), all);
    EXPECT_EQ(file_bytes(own_path("again.h5")), file_bytes(own_path("once.h5")));
  }
}

TEST(JoinCubes, may_be_moved_with_its_parts_but_not_without) {
  fs::create_directories(own_path("run/parts"));
  write_cube(own_path("run/parts/0.h5"), cube_of(0, 2, {}, false));
  concatenate_cube_files(own_path("run/all.h5"), {own_path("run/parts/0.h5")});
  fs::rename(own_path("run"), own_path("moved"));
  EXPECT_EQ(read_cube(own_path("moved/all.h5")).pings[1].pressure(0, 0), 1.0F);
  fs::remove(own_path("moved/parts/0.h5"));
  EXPECT_EQ(error_of([] { read_cube(own_path("moved/all.h5")); }, ErrorKind::content),
            own_path("moved/all.h5") + ": /pressure: its part parts/0.h5 is missing");
}

TEST(JoinCubes, keeps_layers_that_all_have_and_refuses_other_sonars) {
  write_cube(own_path("0.h5"), cube_of(0, 1, {"direct", "noise"}, false));
  write_cube(own_path("1.h5"), cube_of(1, 1, {"direct"}, false));
  Cube other = cube_of(1, 1, {}, false);
  other.sonar = "other";
  write_cube(own_path("2.h5"), other);
  concatenate_cube_files(own_path("all.h5"), {own_path("0.h5"), own_path("1.h5")});
  for (const Ping& ping : read_cube(own_path("all.h5")).pings) EXPECT_EQ(ping.layers.size(), 1U);
  EXPECT_THAT(error_of(
                  [] {
                    concatenate_cube_files(own_path("x.h5"), {own_path("0.h5"), own_path("2.h5")});
                  },
                  ErrorKind::content),
              HasSubstr("2.h5: is of sonar other with 3 beams and 10 bins, not test with 3 and 10 as in"));
  EXPECT_THAT(error_of([] { concatenate_cube_files(own_path("x.h5"), {}); }),
              HasSubstr("no parts, must be at least one"));
  EXPECT_FALSE(file_exists(own_path("x.h5")));
}
