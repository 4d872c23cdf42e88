// SPDX-License-Identifier: BSD-3-Clause
// A run.toml makes the same bytes again: every setting is in it and is read back, and the command line overrides it.
#include "run/requested_simulation.hpp"
#include "run/run_settings.hpp"
#include "store/cube.hpp"
#include "support/test.hpp"
#include "tool/tool_runner.hpp"
using namespace insonify;

namespace {

/// Gives a setting a value that is allowed and is not its default.
void change(const RunSetting& setting) {
  const auto other_word = [&](const std::string& word) {
    for (const std::string& candidate : setting.rules.words)
      if (candidate != word) return candidate;
    // Texts whose numbers are read where the row is set; the file holds them in their usual form.
    constexpr std::pair<std::string_view, const char*> numbers[] = {
        {"unit", "us-ft"}, {"z", "down"}, {"up", "y"}, {"nodata", "-9999,0.1"}, {"classes", "2,9"}};
    for (const auto& [key, text] : numbers)
      if (setting.key == key) return std::string(text);
    return std::string("other \"word\" \\");
  };
  const auto change_value = [&](auto value) {
    using Value = decltype(value);
    if constexpr (std::is_same_v<Value, std::string*>)
      *value = other_word(*value);
    else if constexpr (std::is_same_v<Value, double*>)
      *value += 0.1;
    else if constexpr (std::is_same_v<Value, int*>)
      *value += setting.rules.within && *value == setting.rules.within->second ? -1 : 1;
    else if constexpr (std::is_same_v<Value, std::uint64_t*>)
      *value = ~std::uint64_t{0};
    else if constexpr (std::is_same_v<Value, bool*>)
      *value = !*value;
    else if constexpr (std::is_same_v<Value, std::vector<std::string>*>)
      *value = {other_word(""), other_word("")};
    else if constexpr (std::is_same_v<Value, Shown<std::string>>)
      value.value.set(other_word(*value.value.get()));
    else if constexpr (std::is_same_v<Value, Shown<int>>)
      value.value.set(*value.value.get() + 1);
    else if constexpr (std::is_same_v<Value, Shown<bool>>)
      value.value.set(!*value.value.get());
    else if constexpr (std::is_same_v<Value, NumberList>)
      value.numbers.set(std::vector<double>(value.count, 0.1));
    else
      FAIL() << "no value that run.toml holds";
  };
  std::visit(change_value, setting.value);
}

class RunAgain : public ToolTest {
 protected:
  void SetUp() override {
    have("harbour.ply", "make-scene harbour --points 6000");
    write("track.csv",
          "time_s,x_m,y_m,z_m,yaw_deg,pitch_deg,roll_deg\n0,0,0,-3,0,10,0\n1,1,0.3,-3,20,10,2\n2,2,0,-3,0,9,0\n");
    write("ctd.csv", "depth_m,sound_speed\n0,1520\n4,1490.123456789\n20,1489\n");
    write("sea.toml", "[surface]\nheight_m = 0\nrms_height_m = 0.001\n[volume]\nscattering_db = -65\n");
  }
  void expect_same(const std::string& run, const std::string& other) const {
    for (const auto& entry : std::filesystem::directory_iterator(path(run))) {
      const std::string name = "/" + entry.path().filename().string();
      if (name != "/run.toml" && name != "/manifest.json") {
        EXPECT_TRUE(read(run + name) == read(other + name)) << other << name;
      }
    }
  }
};

const std::string pose = " --pose=0,0,-3,0,10,0";
const std::string again_head = "ping harbour.ply --no-picture -q --sonar p900-45 --set sonar.beams=16";
const std::string gate = " --range 2:9";

}  // namespace

TEST(RunSettings, every_setting_of_a_ping_reads_back) {
  insonify::Run given, defaults;
  const auto settings = all_settings(given), usual = all_settings(defaults);
  for (const RunSetting& setting : settings) change(setting);
  const std::string path = testing::TempDir() + "insonify_every_setting.toml";
  std::ofstream(path) << "schema = 1\ninsonify_version = \"1\"\n"
                      << settings_as_toml(settings) << "\n[sonar]\nbeams = 1\n";
  insonify::Run read = load_ping_settings(path);
  const auto back = all_settings(read);
  ASSERT_GE(back.size(), 30U);
  for (std::size_t i = 0; i < back.size(); ++i) {
    EXPECT_EQ(settings_as_toml({back[i]}), settings_as_toml({settings[i]}));
    EXPECT_NE(settings_as_toml({back[i]}), settings_as_toml({usual[i]})) << "not changed";
  }
  std::filesystem::remove(path);
}

// The settings of a simulator are its own options: a row that is bound to a copy would leave them as they are.
TEST(RunSettings, rows_set_the_options_of_the_simulator) {
  const auto set = [](const char* key, const char* value) {
    const std::string path = testing::TempDir() + "insonify_one_setting.toml";
    std::ofstream(path) << "schema = 1\ninsonify_version = \"1\"\n[ping]\n" << key << " = " << value << "\n";
    return load_ping_settings(path);
  };
  EXPECT_EQ(requested_simulation(set("detail_width", "0.5")).sampling.detail_width, 0.5);
  EXPECT_EQ(requested_simulation(set("multipath", "true")).effects.multipath, Choice::always);
  EXPECT_EQ(requested_simulation(set("absorption_order", "1")).effects.absorption_order, 1);
  EXPECT_EQ(requested_simulation(set("amplitude", "\"coherent\"")).amplitude, SurfaceAmplitude::coherent);
  EXPECT_EQ(requested_simulation(set("all_bins_above", "60.5")).detection.above_db, 60.5);
  EXPECT_TRUE(requested_simulation(set("keep", "[\"labels\"]")).outputs.labels);
  EXPECT_EQ(requested_simulation(set("keep", "[\"labels\"]")).outputs.display_bins, usual_display_bins);
}

// Numbers in files are text, as insonify writes them, or a list.
TEST(RunSettings, lists_of_numbers_are_text_or_a_list) {
  const std::string path = testing::TempDir() + "insonify_lists.toml";
  const auto pose_of_file = [&](const std::string& pose) {
    std::ofstream(path) << "schema = 1\ninsonify_version = \"1\"\n[ping]\npose = " << pose << "\n";
    return load_ping_settings(path).placement.pose;
  };
  const GivenPose expected{1, 2.5, -3, 0, 10, 0};
  EXPECT_EQ(pose_of_file("\"1, 2.50,-3,0,10,0\""), expected);
  EXPECT_EQ(pose_of_file("[1, 2.5, -3, 0, 10, 0]"), expected);
  EXPECT_EQ(pose_of_file("\"\""), std::nullopt);
  for (const char* wrong : {"\"1,2\"", "[1, 2]", "[1, 2, 3, 4, 5, \"6\"]", "\"a,0,0,0,0,0\"", "7", "true"})
    EXPECT_THAT(error_of([&] { pose_of_file(wrong); }, ErrorKind::content),
                testing::AllOf(HasSubstr(path + ":4: ping.pose = "),
                               HasSubstr("must be x,y,z,yaw,pitch,roll in metres and degrees")))
        << wrong;
  std::filesystem::remove(path);
}

TEST_F(RunAgain, the_same_bytes_for_all_kinds_of_options) {
  const std::vector<std::string> sets{
      pose + " --sampling rays --rays-per-beam 16 --seed 12345678901234567890 --amplitude random-phase",
      pose + " --method element-exact --keep elements --scatterers-per-cell 1 --range 8.7:9 --set sonar.beams=5",
      pose + " --keep contributors,mask,paths,insonification --contributors 2 --layers --threshold 8",
      pose + " --with outer-azimuths --with absorption-slope --without occlusion --all-bins-above 60.5",
      " --trajectory track.csv --time 0.75 --absorption-order 1 --material-field material",
      pose + " --velocity=1,0.5,0 --turn-rate=0,0,30 --method incoherent",
      pose +
          " --multipath --noise --layers --environment sea.toml --profile ctd.csv --set bottom.height_m=-9 "
          "--set bottom.lambert_mu_db=-23.7 --set wind.speed_m_s=7.3 --set water.temperature_c=4.7"};
  for (const std::string& options : sets) {
    succeed(again_head + (options.find("--range") == options.npos ? gate : "") + options + " -o first --force");
    succeed("ping --run first/run.toml -o again --force --no-picture -q");
    expect_same("first", "again");
  }
}

TEST_F(RunAgain, options_beside_it_override_it) {
  succeed(again_head + gate + pose + " --noise --seed 7 --keep mask --without occlusion -o first");
  succeed(
      "ping --run first/run.toml --noise=false --seed 8 --keep paths --without motion --range 6:8 -o other "
      "--no-picture -q");
  succeed(again_head + pose + " --seed 8 --keep paths --without motion --range 6:8 -o expected");
  expect_same("expected", "other");
  // A trajectory takes the place of a pose and its motion, and a pose that of a trajectory.
  succeed(again_head + gate + pose + " --velocity=1,0,0 --world ned -o moving");
  succeed("ping --run moving/run.toml --trajectory track.csv --time 1.5 -o track --no-picture -q");
  succeed("ping --run track/run.toml" + pose + " -o still --no-picture -q");
  succeed(again_head + gate + pose + " --time 1.5 -o still2");
  expect_same("still2", "still");
}

TEST_F(RunAgain, files_are_found_from_the_run) {
  succeed(again_head + gate + " --trajectory track.csv -o first");
  std::filesystem::create_directory(path("site"));
  for (const char* name : {"harbour.ply", "track.csv", "first"})
    std::filesystem::rename(path(name), path(std::string("site/") + name));
  succeed("ping --run site/first/run.toml -o again --no-picture -q");
  expect_same("site/first", "again");
  succeed("plan --run site/first/run.toml -q");
}

TEST_F(RunAgain, refuses_what_is_no_setting) {
  const std::string version = "insonify_version = \"1\"\n";
  const auto refused = [&](const std::string& text, const std::vector<std::string>& parts) {
    write("run.toml", version + text);
    expect_refused("ping --run run.toml -o again", 3, parts);
  };
  refused("[ping]\nnoize = true\n", {"run.toml:3: unknown key 'ping.noize'; did you mean 'ping.noise'?"});
  refused("tolerence = 1\n[ping]\n", {"run.toml:2: unknown key 'tolerence'; did you mean 'tolerance'?"});
  refused("[ping]\nlevel_error_db = 0.5\n", {"run.toml:3: unknown key 'ping.level_error_db'"});
  refused("[ping]\nsampling = \"ray\"\n", {"run.toml:3: ping.sampling = \"ray\", must be one of surfels, rays"});
  refused("[ping]\ncontributors = 300\n",
          {"run.toml:3: ping.contributors = 300, must be a whole number within 1 and 255"});
  refused("[ping]\nkeep = [\"mask\", 1]\n",
          {"run.toml:3: ping.keep = [\"mask\", 1], must be a list, each one of elements"});
  refused("[ping]\nnoise = 1\n", {"run.toml:3: ping.noise = 1, must be true or false"});
  refused("seed = -1\n[ping]\n", {"run.toml:2: seed = -1, must be an integer from 0"});
  refused("scatterers = \"rays.csv\"\n", {"run.toml: is not the run.toml of a ping"});
  expect_refused("ping --run absent.toml -o again", 4, {"absent.toml"});
  expect_refused("ping -o again", 2, {"SCENE is required"});
}

TEST_F(RunAgain, head_stands_on_the_vehicle_as_its_file_or_the_option_says) {
  const std::string swath = "ping harbour.ply --no-picture -q --sonar em2040 --set sonar.beams=16 --range 2:9";
  succeed(swath + " --pose=0,0,-3,0,0,0 -o down");
  succeed(swath + " --pose=0,0,-3,0,90,0 --mount=0,0,0,0,0,0 -o turned");
  succeed("ping --run down/run.toml --no-picture -q -o again");
  expect_same("down", "turned");
  expect_same("down", "again");

  succeed(again_head + gate + " --pose=1,2,-3,90,0,0 --mount=1,0,0.5,0,10,0 --turn-rate=0,0,90 -o offset");
  const insonify::Ping ping = ping_of("offset");
  EXPECT_TRUE(ping.world_from_head.isApprox(
      insonify::pose_from_yaw_pitch_roll({1, 3, -2.5}, insonify::radians(90), insonify::radians(10), 0), 1e-12));
  expect_refused(again_head + gate + " --pose=0,0,-3,0,10,0 --mount=1,0 -o bad", 2,
                 {"--mount", "x,y,z,yaw,pitch,roll"});
}
