// SPDX-License-Identifier: BSD-3-Clause
// Bad input gets one line that names the file or argument, the value and the remedy, the right exit code, and leaves
// nothing behind.
#include "run/run_settings.hpp"
#include "scene/surface_rays.hpp"
#include "scene_io/load_scene.hpp"
#include "support/test.hpp"
#include "tool/tool_runner.hpp"

namespace {

const std::string bad_head = " --sonar p900-45 --pose=0,0,3,0,15,0 --range 2:10 -o out";

class BadInput : public ToolTest {
 protected:
  void SetUp() override { have("plane.ply", "make-scene plane --points 2000 --size 12,12"); }
};

}  // namespace

TEST_F(BadInput, missing_file) {
  expect_refused("ping nowhere.pcd" + bad_head, 4, {"nowhere.pcd"});
  expect_refused("info nowhere.ply", 4, {"nowhere.ply"});
  expect_refused("prepare nowhere.ply -o x.ply", 4, {"nowhere.ply"});
  expect_refused("synthesize nowhere.csv --sonar p900-45 -o out", 4, {"nowhere.csv"});
  expect_refused("image nowhere -o x.png", 4, {"nowhere"});
}

TEST_F(BadInput, text_file_named_pcd) {
  write("notes.pcd", "These are my notes about the reef.\nNothing else.\n");
  expect_refused("ping notes.pcd" + bad_head, 3, {"notes.pcd", "PCD"});
}

TEST_F(BadInput, ply_cut_off_in_the_middle) {
  const std::string whole = read("plane.ply");
  write("half.ply", whole.substr(0, whole.size() / 2));
  expect_refused("ping half.ply" + bad_head, 3, {"half.ply", "cut off"});
}

TEST_F(BadInput, unknown_sonar_and_unknown_sonar_key) {
  expect_refused("ping plane.ply --sonar p900-54 --pose=0,0,3,0,15,0 -o out", 2, {"p900-54", "p900-45"});
  write("mine.toml", "schema = 1\nname = \"mine\"\ncentre_freqency_hz = 9e5\n");
  expect_refused("ping plane.ply --sonar mine.toml --pose=0,0,3,0,15,0 -o out", 3,
                 {"mine.toml:3", "centre_freqency_hz", "did you mean 'centre_frequency_hz'"});
  expect_refused("ping plane.ply" + bad_head + " --set sonar.beems=3", 2, {"beems", "beams"});
  expect_refused("ping plane.ply" + bad_head + " --set water.salt=3", 2, {"salt", "salinity_psu"});
  expect_refused("ping plane.ply" + bad_head + " --set beams", 2, {"--set", "section.key=value"});
}

TEST_F(BadInput, pose_with_five_numbers) {
  expect_refused("ping plane.ply --sonar p900-45 --pose=0,0,3,0,15 -o out", 2,
                 {"--pose", "0,0,3,0,15", "has 5 numbers, must have 6"});
  expect_refused("ping plane.ply --sonar p900-45 --pose=0,0,x,0,15,0 -o out", 2, {"'x' is not a number"});
}

TEST_F(BadInput, max_range_below_min_range) {
  expect_refused("ping plane.ply --sonar p900-45 --pose=0,0,3,0,15,0 --range 9:2 -o out", 2,
                 {"--range", "9:2", "max range 2 m must be above min range 9 m"});
  expect_refused("ping plane.ply --sonar p900-45 --pose=0,0,3,0,15,0 --range 0:2 -o out", 2,
                 {"min range 0 m must be > 0"});
  expect_refused("ping plane.ply --sonar p900-45 --pose=0,0,3,0,15,0 --range 5 -o out", 2, {"min:max"});
}

TEST_F(BadInput, empty_cloud) {
  write("empty.pcd",
        "# .PCD v0.7\nVERSION 0.7\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 0\nHEIGHT 1\n"
        "VIEWPOINT 0 0 0 1 0 0 0\nPOINTS 0\nDATA ascii\n");
  expect_refused("ping empty.pcd" + bad_head, 3, {"empty.pcd"});
}

TEST_F(BadInput, cloud_in_millimetres) {
  std::string text;
  for (int i = 0; i < 40; ++i)
    for (int j = 0; j < 40; ++j) text += std::to_string(300 * i) + " " + std::to_string(300 * j - 6000) + " 0\n";
  write("millimetres.xyz", text);
  expect_refused("ping millimetres.xyz" + bad_head, 3, {"millimetres.xyz", "--unit mm"});
  succeed("ping millimetres.xyz --unit mm -q" + bad_head);
}

TEST_F(BadInput, existing_run) {
  succeed("ping plane.ply -q" + bad_head);
  const std::string cube = read("out/cube.h5");
  expect_refused("ping plane.ply --seed 5" + bad_head, 4, {"out", "--force"});
  EXPECT_EQ(read("out/cube.h5"), cube);
  succeed("ping plane.ply --seed 5 --force -q" + bad_head);
  EXPECT_NE(read("out/cube.h5"), cube);
}

TEST_F(BadInput, existing_file_of_prepare_and_make_scene) {
  expect_refused("make-scene plane -o plane.ply", 4, {"plane.ply", "--force"});
  expect_refused("prepare plane.ply -o plane.ply", 4, {"plane.ply", "is the input"});
  write("old.ply", "old");
  expect_refused("prepare plane.ply -o old.ply", 4, {"old.ply", "--force"});
}

TEST_F(BadInput, impossible_values) {
  expect_refused("ping plane.ply" + bad_head + " --set sonar.bandwidth_hz=0", 2, {"bandwidth_hz = 0 Hz"});
  expect_refused("ping plane.ply" + bad_head + " --set sonar.bin_size_m=1", 2,
                 {"bin_size_m = 1 m would under-sample the pulse"});
  expect_refused("ping plane.ply" + bad_head + " --set water.salinity_psu=-3", 2, {"salinity_psu = -3 psu"});
  expect_refused("ping plane.ply" + bad_head + " --tolerance 0", 2, {"tolerance = 0"});
  expect_refused("ping plane.ply" + bad_head + " --material stel", 2, {"stel", "did you mean 'steel'"});
  expect_refused("ping plane.ply" + bad_head + " --unit furlong", 2, {"furlong", "m, mm, cm, km, ft"});
  expect_refused("make-scene habour -o x.ply", 2, {"habour", "harbour"});
  expect_refused("make-scene plane --points 0 -o x.ply", 2, {"points"});
}

TEST_F(BadInput, settings_out_of_range_name_their_option) {
  const std::string ping = "ping plane.ply" + bad_head;
  const auto expect_line = [&](const std::string& options, const std::string& line) {
    const ToolResult result = run(ping + " " + options);
    EXPECT_EQ(result.exit_code, 2) << options;
    EXPECT_EQ(result.err, "insonify: " + line + "\n");
  };
  expect_line("--detail-width -1", "--detail-width = -1, must be within 0 and 4");
  expect_line("--all-bins-above 1 --threshold nan", "--threshold = nan, must be a number");
  expect_line("--method incoherent --split",
              "--split: must be left out with method incoherent: an expected intensity has no phase; use gridded");
  expect_line("--method incoherent --keep elements",
              "--keep elements: must be left out with method incoherent: an expected intensity has no pressures at "
              "elements; use gridded");
  expect_line("--with surface", "--with surface: surface cannot be forced in: surface.scattering_db is not given");
  expect_line("--mesh-spacing -1", "--mesh-spacing = -1 m, must be 0 or more, and finite");
  expect_refused(ping + " --velocity 100,0,0", 2, {"--velocity = 100 m/s", "a hundredth of the sound speed"});

  // No setting that is a number has a value far out of its range that is refused by another name.
  insonify::Run requested;
  int refused = 0;
  for (const RunSetting& setting : all_settings(requested))
    if (std::holds_alternative<double*>(setting.value) || std::holds_alternative<int*>(setting.value)) {
      const bool whole = std::holds_alternative<int*>(setting.value);
      const ToolResult result = run("plan plane.ply --sonar p900-45 --pose=0,0,3,0,15,0 --range 2:10 " +
                                    std::string(setting.option) + (whole ? " -1000000" : " -1e300"));
      if (result.exit_code == 0) continue;
      ++refused;
      EXPECT_EQ(result.exit_code, 2) << setting.option;
      EXPECT_THAT(result.err, testing::StartsWith(std::string("insonify: ") + setting.option)) << setting.option;
    }
  EXPECT_GE(refused, 15);
}

TEST_F(BadInput, settings_of_files_out_of_range_name_line_and_key) {
  succeed("make-mission lawnmower --scene plane.ply --range 2:10 -o mission.toml -q");
  write("mission.toml", read("mission.toml") + "[ping]\nnoise = true\ndetail_width = -1\n");
  const std::string text = read("mission.toml");
  const auto line = std::to_string(std::count(text.begin(), text.end(), '\n'));
  expect_refused("survey mission.toml -o run", 3,
                 {"mission.toml:" + line + ": ping.detail_width = -1, must be within 0 and 4"});
  succeed("ping plane.ply -q" + bad_head);
  write("bad.toml", replaced(read("out/run.toml"), "\ntolerance = 0.0001", "\ntolerance = 2"));
  expect_refused("ping --run bad.toml -o again", 3, {"bad.toml:", ": tolerance = 2, must be above 0 and below 1"});
}

TEST_F(BadInput, numbers_that_must_be_above_0_say_so) {
  expect_refused("prepare plane.ply --thin -1 -o x.ply", 2, {"--thin: -1 must be above 0"});
  expect_refused("make-scene plane --points 0 -o x.ply", 2, {"--points: 0 must be above 0"});
  expect_refused("make-scene plane --size 0,1 -o x.ply", 2, {"--size = 0,1 m, both lengths must be above 0"});
  expect_refused("view plane.ply --sonar p900-45 --pose=0,0,3,0,15,0 --size 100x100 --screenshot x.png", 2,
                 {"--size = 100x100", "800 x 600"});
}

TEST_F(BadInput, wrong_words) {
  expect_refused("pong plane.ply", 2, {"--help"});
  expect_refused("ping plane.ply" + bad_head + " --colour red", 2, {"--colour"});
  expect_refused("ping", 2, {"--help"});
  expect_refused("ping plane.ply" + bad_head + " -j 100000", 2, {"--threads", "100000", "not in range", "0", "1024"});
}

TEST_F(BadInput, csv_with_a_bad_number_names_its_line) {
  write("bad.csv", "range_m,azimuth_rad,elevation_rad,sigma_m2,xi_re,xi_im\n5,0,0,1,1,0\n6,0,zero,1,1,0\n");
  expect_refused("synthesize bad.csv --sonar p900-45 -o out", 3, {"bad.csv:3", "zero"});
}

TEST_F(BadInput, help_is_no_error) {
  for (const std::string verb : {"", "info", "prepare", "make-scene", "sonars", "ping", "image", "synthesize"}) {
    const ToolResult result = run(verb + " --help");
    EXPECT_EQ(result.exit_code, 0) << verb;
    EXPECT_EQ(result.err, "") << verb;
    EXPECT_THAT(result.out, HasSubstr("insonify")) << verb;
  }
  const ToolResult version = run("--version"), all = run("--version --verbose");
  EXPECT_EQ(version.exit_code, 0);
  EXPECT_TRUE(all.out.starts_with(version.out + "built with ")) << all.out;
  for (const char* part : {"Embree", "GDAL", "Python", "VTK"}) EXPECT_THAT(all.out, HasSubstr(part));
  EXPECT_EQ(all.out.find("without Embree") == all.out.npos, SurfaceRays::available());
  EXPECT_EQ(all.out.find("without LASzip") == all.out.npos, scene_extensions().find(".laz") != std::string::npos);
  expect_refused("--verbose", 2, {"--verbose requires --version"});
}
