// SPDX-License-Identifier: BSD-3-Clause
// Tests the program: a real window on a virtual display, pictures without one, and bad input.
#include <hdf5.h>

#include "scene_io/load_scene.hpp"
#include "scene_io/save_cloud.hpp"
#include "store/cube.hpp"
#include "support/test.hpp"
#include "tool/tool_runner.hpp"
#include "view/test_pictures.hpp"
#include "viewer/desktop.hpp"
#include "viewer/three_targets.hpp"
#include "viewer/viewer_window_internal.hpp"

namespace {

class InsonifyView : public ToolTest {
 protected:
  void SetUp() override {
    std::filesystem::create_directories(path("out"));
    write_cube(path("out/cube.h5"), cube());
    write("out/manifest.json", "{}\n");
    save_scene(path("targets.ply"), made_.data.scene);
    write("out/run.toml", "schema = 1\ninsonify_version = \"0\"\n[scene]\npath = \"targets.ply\"\nunit = \"m\"\n");
  }
  Cube cube() const {
    Cube cube;
    cube.pings = made_.pings;
    cube.absorption_db_per_m = made_.pings.front().absorption_db_per_m;
    cube.sound_speed = 1500;
    cube.centre_frequency = 9e5, cube.bandwidth = 3e4;
    cube.source_level_db = 200;
    cube.sonar = "three-targets";
    return cube;
  }
  static bool is_png(const std::string& bytes) { return bytes.substr(1, 3) == "PNG"; }

  TargetData made_ = three_targets(2);
};

}  // namespace

TEST_F(InsonifyView, a_picture_of_a_run_needs_no_display) {
  const std::string out =
      succeed("view out --size 1000x700 --screenshot a.png --events 'select " + std::to_string(made_.port.pixel.beam) +
              " " + std::to_string(made_.port.pixel.bin) + "'");
  EXPECT_THAT(out, HasSubstr("iron"));
  EXPECT_THAT(out, HasSubstr("a.png"));
  EXPECT_TRUE(is_png(read("a.png")));
  const ReadPicture picture = read_png(path("a.png"));
  EXPECT_EQ(picture.width, 1000);
  EXPECT_EQ(picture.height, 700);
}

TEST_F(InsonifyView, a_beam_is_selected_at_its_loudest_sample) {
  const std::string out =
      succeed("view out --size 800x600 --screenshot a.png --beam " + std::to_string(made_.starboard.pixel.beam) +
              " --events 'key shift+Up; key shift+Down; screenshot b.png; select 0 0' -q");
  EXPECT_TRUE(is_png(read("b.png")));
  EXPECT_THAT(out, HasSubstr("beam 0, bin 0"));
}

TEST_F(InsonifyView, a_script_does_what_events_do) {
  write("look.txt", "key m  # next map\nselect 20 100\nscreenshot c.png\nquit\n");
  const std::string out = succeed("view out --script look.txt --screenshot d.png");
  EXPECT_THAT(out, HasSubstr("rubber"));
  EXPECT_TRUE(is_png(read("c.png")) && is_png(read("d.png")));
}

TEST_F(InsonifyView, inspects_a_scene_before_any_ping) {
  const std::string out = succeed(
      "view targets.ply --sonar p900-45 --pose=10,20,-3,30,0,0 --range 1:14 --size 800x600 --screenshot a.png --events "
      "'key Up; key "
      "p'");
  // Half a metre forward, 30 degrees to port: 0.433, 0.25.
  EXPECT_THAT(out, HasSubstr("--pose=10.433,20.25,-3,30,0,0"));
  EXPECT_TRUE(is_png(read("a.png")));
  // `ping` mounts the head, too: what is printed is the pose that was given.
  EXPECT_THAT(succeed("view targets.ply --sonar em2040 --pose=10,20,-3,30,0,0 --range 1:14 --size 800x600 --screenshot "
                      "b.png --events 'key p'"),
              HasSubstr("--pose=10,20,-3,30,0,0"));
}

TEST_F(InsonifyView, estimates_missing_normals_and_says_to_which_side) {
  std::string cloud;
  for (int i = 0; i < 40; ++i)
    for (int j = 0; j < 40; ++j)
      cloud += std::to_string(4 + 0.1 * i) + " " + std::to_string(-2 + 0.1 * j) + " " +
               std::to_string(0.01 * ((7 * i + 3 * j) % 5)) + "\n";
  write("bare.xyz", cloud);
  const ToolResult result =
      run("view bare.xyz --sonar p900-45 --pose=0,0,2,0,15,0 --range 1:12 --size 800x600 --screenshot a.png");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.err, HasSubstr("a raster of heights: its surface looks up"));
}

TEST_F(InsonifyView, a_run_whose_scene_is_gone_is_shown_without_it) {
  std::filesystem::remove(path("targets.ply"));
  const ToolResult result = run("view out --size 800x600 --screenshot a.png");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.err, HasSubstr("targets.ply: the scene of the run is missing"));
}

TEST_F(InsonifyView, shows_the_returns_of_a_run) {
  Soundings soundings;
  soundings.position = {made_.port.position, made_.far.position};
  soundings.level_db = {130, 125.5F};
  soundings.range = {6.05F, 12.05F};
  soundings.azimuth = {static_cast<float>(made_.port.azimuth), 0};
  soundings.elevation = {0, 0.01F};
  soundings.ping = {7, 8};
  soundings.beam = {static_cast<std::uint32_t>(made_.port.pixel.beam), 20};
  soundings.bin = {40, 100};
  soundings.true_elevation = {0, 0.01F};
  soundings.true_surfel = {3, 4};
  soundings.true_material = {0, 2};
  save_soundings(path("out/returns.ply"), soundings);
  const Soundings back = load_soundings(path("out/returns.ply"));
  const auto fields = [](const auto& x) {
    return std::tie(x.position, x.level_db, x.elevation, x.ping, x.bin, x.true_material);
  };
  EXPECT_EQ(fields(back), fields(soundings));
  succeed("view out --size 800x600 --screenshot a.png -q");
  succeed("view out --no-scene --size 800x600 --screenshot b.png -q");
  EXPECT_NE(read("a.png"), read("b.png"));
}

TEST_F(InsonifyView, help_lists_options_and_keys) {
  for (const char* ask : {"view --help", "view -h"}) {
    const std::string help = succeed(ask);
    for (const char* part : {"--screenshot", "--pose", "PageUp", "space", "Examples:", "Exit codes"})
      EXPECT_THAT(help, HasSubstr(part));
  }
  EXPECT_THAT(succeed("--help"), HasSubstr("view"));
}

// --- bad input

TEST_F(InsonifyView, without_a_display_it_says_what_to_do) {
  const std::string display = std::getenv("DISPLAY") ? std::getenv("DISPLAY") : "";
  unsetenv("DISPLAY");
  expect_refused("view out", 1, {"no display", "xvfb-run", "insonify image"});
  setenv("DISPLAY", ":999", 1);  // no server
  expect_refused("view out", 1, {"no display"});
  if (display.empty())
    unsetenv("DISPLAY");
  else
    setenv("DISPLAY", display.c_str(), 1);
}

TEST_F(InsonifyView, refuses_runs_that_are_not_whole) {
  const auto refused = [&](const std::string& arguments, int code, const std::vector<std::string>& parts) {
    expect_refused("view " + arguments + " --screenshot a.png", code, parts);
  };
  refused("nowhere", 4, {"nowhere", "no such run or scene"});
  std::filesystem::remove(path("out/manifest.json"));
  refused("out", 3, {"out", "no manifest.json", "unfinished"});
  std::filesystem::remove(path("out/cube.h5"));
  refused("out", 3, {"out", "holds no cube.h5"});
  write("out/cube.h5", "this is no HDF5 file");
  refused("out/cube.h5", 3, {"cube.h5"});
}

TEST_F(InsonifyView, refuses_options_that_make_no_sense) {
  const auto refused = [&](const std::string& arguments, int code, const std::vector<std::string>& parts) {
    expect_refused("view " + arguments + " --screenshot a.png", code, parts);
  };
  refused("out --ping 2", 2, {"--ping = 2", "must be below 2"});
  refused("out --beam 41", 2, {"--beam = 41", "below 41"});
  refused("out --beam much", 2, {"--beam", "much"});
  refused("out --size 100x100", 2, {"100 x 100", "800 x 600"});
  refused("out --window 0", 2, {"--window = 0"});
  refused("out --colormap mauve", 2, {"mauve", "viridis"});
  refused("out --events 'jump up'", 2, {"no event is called 'jump'"});
  refused("out --events 'select 41 0'", 2, {"beam = 41", "below 41"});
  refused("out --script nowhere.txt", 4, {"nowhere.txt"});
  refused("out --sonar p900-45", 2, {"leave --sonar and --pose out"});
  refused("targets.ply --pose=0,0,0,0,0,0", 2, {"--sonar must be given"});
  refused("targets.ply --sonar p900-45", 2, {"--pose must be given"});
  refused("targets.ply --sonar p900-45 --pose=1,2", 2, {"--pose"});
  expect_refused("view", 2, {"TARGET"});
  write("there.png", "mine");
  expect_refused("view out --screenshot there.png", 4, {"there.png", "--force"});
  EXPECT_EQ(read("there.png"), "mine");
}

// --- a real window

TEST_F(InsonifyView, opens_a_window_that_answers_clicks_and_keys) {
  const VirtualDisplay display;
  if (display.name().empty()) GTEST_SKIP() << "Xvfb is not installed: apps/install_packages.sh --tests";
  // Drawn off-screen, the window shows where the targets are.
  ViewerOptions options;
  options.width = 1000, options.height = 700;
  Point2 at[2];
  {
    made_.data.title = "three-targets";
    ViewerWindow window(made_.data, options, ViewerScreen::off_screen);
    window.draw();
    at[0] = window.pixel_of(made_.port.pixel);
    at[1] = window.pixel_of(made_.starboard.pixel);
  }
  DesktopProgram program(display, {"env", "-C", path("."), INSONIFY_TOOL, "view", "out", "--size", "1000x700"},
                         path("said.txt"));
  ASSERT_TRUE(program.has_window("insonify-view")) << program.output_with("insonify");
  const auto click = [&](Point2 p) {
    program.click(static_cast<int>(std::lround(p.x)), 699 - static_cast<int>(std::lround(p.y)));
  };
  // A window exists shortly before it accepts input.
  for (int i = 0; i < 30 && program.output_with("iron", 1).empty(); ++i) click(at[0]);
  EXPECT_THAT(program.output_with("iron"), HasSubstr("-26.00° (port)"));
  program.type("Right");  // the second ping
  click(at[1]);
  const std::string said = program.output_with("wood");
  EXPECT_THAT(said, HasSubstr("+26.00° (starboard)"));
  EXPECT_THAT(said, HasSubstr("Ping 8"));
  program.type("j");
  EXPECT_THAT(program.output_with("insonify-view-1.png"), HasSubstr("insonify-view-1.png"));
  EXPECT_TRUE(is_png(read("insonify-view-1.png")));
  program.type("q");
  EXPECT_EQ(program.wait_for_end(), 0) << program.output_with("");
}

TEST_F(InsonifyView, ends_well_when_its_window_is_closed) {
  const VirtualDisplay display;
  if (display.name().empty()) GTEST_SKIP() << "Xvfb is not installed: apps/install_packages.sh --tests";
  DesktopProgram program(display, {"env", "-C", path("."), INSONIFY_TOOL, "view", "out", "--size", "800x600"},
                         path("said.txt"));
  ASSERT_TRUE(program.has_window("insonify-view")) << program.output_with("insonify");
  program.type("space");
  program.close_window();
  EXPECT_EQ(program.wait_for_end(), 0) << program.output_with("");
}
