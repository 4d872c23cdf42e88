// SPDX-License-Identifier: BSD-3-Clause
// insonify image and merge, from echoes at known places to the pixels of the PNG.
#include "returns/quantise.hpp"
#include "store/cube.hpp"
#include "support/test.hpp"
#include "tool/tool_runner.hpp"
#include "view/drawn_cells_internal.hpp"
#include "view/fan_layout_internal.hpp"
#include "view/test_pictures.hpp"

namespace fs = std::filesystem;

namespace {

constexpr double min_range = 3, max_range = 12, window_db = 60, max_db = 215;

struct Target {
  double bearing_deg, range;  // positive to starboard
};
constexpr Target port_near{-15, 4.5}, ahead{0, 7.5}, starboard_far{15, 10.5};

/// Level of a colour, by the nearest entry of the map.
double level_of(const Rgb& colour) {
  static const ColourTable table = colour_table("viridis", "test");
  std::size_t best = 0;
  for (std::size_t i = 1; i < table.size(); ++i)
    if (colour_difference(colour, table[i]) < colour_difference(colour, table[best])) best = i;
  return max_db - window_db + (static_cast<double>(best) + 0.5) * window_db / 256;
}

class Pictures : public ToolTest {
 protected:
  /// A run of 64 beams over 45 degrees with an echo at each target.
  void synthesize(const std::string& run, const std::vector<Target>& targets, const std::string& more = "") const {
    std::string csv = "range_m,azimuth_rad,elevation_rad,sigma_m2,xi_re,xi_im\n";
    for (const Target& t : targets)
      csv += std::to_string(t.range) + "," + std::to_string(-radians(t.bearing_deg)) + ",0,0.01,1,0\n";
    write(run + ".csv", csv);
    succeed("synthesize " + run + ".csv --sonar p900-45 --set sonar.beams=64 --set sonar.bandwidth_hz=10000 --range " +
            "3:12 --no-picture -q -o " + run + " " + more);
  }
  Grid<float> levels(const std::string& run) const {
    const Cube cube = read_cube(path(run + "/cube.h5"));
    return apply_tvg(level_db(cube.pings[0]), cube.pings[0].gate, {40, cube.absorption_db_per_m});
  }
  static std::string scale() {
    return " --colormap viridis --max " + std::to_string(max_db) + " --window " + std::to_string(window_db) + " -q ";
  }
  /// The brightest pixel within a part of the picture, by level.
  static Point2 brightest(const ReadPicture& png, Box part) {
    Point2 best;
    double highest = -1e9;
    for (int y = static_cast<int>(part.bottom * png.height); y < part.top * png.height; ++y)
      for (int x = static_cast<int>(part.left * png.width); x < part.right * png.width; ++x) {
        const Rgb c = png.at(x, y);
        const double yellow = c[0] + c[1] - 2.0 * c[2];  // the upper end of viridis, not black, grey or white
        if (yellow > highest) highest = yellow, best = {x + 0.5, y + 0.5};
      }
    return best;
  }
};

}  // namespace

// At each of the three echoes, and a bin and a beam beside it, where the level is some dB lower.
TEST_F(Pictures, of_a_fan_show_the_cubes_own_levels_at_the_echoes_places) {
  synthesize("out", {port_near, ahead, starboard_far});
  succeed("image out -o fan.png --size 800x600 --title T" + scale());
  const ReadPicture png = read_png(path("fan.png"));
  const Cube cube = cube_of("out");
  const BeamFan& fan = cube.pings[0].fan;
  const RangeGate& gate = cube.pings[0].gate;
  const Grid<float> level = levels("out");

  PictureOptions options;
  options.width = 800, options.height = 600;
  options.title = "T";
  options.max_db = max_db, options.window_db = window_db;
  const BeamCells cells = order_beams({fan, gate, level, ""});
  const double outer = gate.min_range + static_cast<double>(gate.bins()) * gate.bin_size;
  const FanLayout layout = lay_out_fan({cells.low(), cells.high(), gate.min_range, outer}, options,
                                       colour_scale(level, options, "test"), "dB re 1 µPa at 1 m, range compensated");
  for (const Target& target : {port_near, ahead, starboard_far})
    for (const auto& [beams_off, bins_off] : {std::pair{0, 0}, {0, 1}, {1, 0}}) {
      const auto bin = static_cast<std::size_t>((target.range - gate.min_range) / gate.bin_size) + bins_off;
      std::size_t beam = 0;
      for (std::size_t b = 1; b < fan.beams(); ++b)
        if (std::abs(-degrees(fan.azimuth[b]) - target.bearing_deg) <
            std::abs(-degrees(fan.azimuth[beam]) - target.bearing_deg))
          beam = b;
      beam += beams_off;
      const Point2 at = layout.at(-fan.azimuth[beam] + radians(0.15), gate.centre(bin));
      const double expected = level(static_cast<Eigen::Index>(beam), static_cast<Eigen::Index>(bin));
      ASSERT_GT(expected, max_db - window_db + 1) << "a probe below the window shows nothing";
      EXPECT_NEAR(level_of(png.at(at.x, at.y)), expected, 1.01 * window_db / 256)
          << target.bearing_deg << ", " << beams_off << ", " << bins_off;
    }
}

TEST_F(Pictures, of_many_pings_come_from_merged_runs) {
  synthesize("a", {{0, 9.5}});
  synthesize("b", {{0, 6.5}});
  synthesize("c", {{0, 4}});
  EXPECT_THAT(succeed("merge a b c -o all"), HasSubstr("all: 3 pings of 3 runs"));
  EXPECT_EQ(read("all/run.toml"), read("a/run.toml"));
  EXPECT_THAT(read("all/manifest.json"), HasSubstr("follow in the order given"));
  const Cube all = cube_of("all");
  ASSERT_EQ(all.pings.size(), 3U);
  EXPECT_EQ(all.pings[2].number, 2);
  EXPECT_TRUE((all.pings[1].pressure == ping_of("b").pressure).all());

  // Newest on top: c, near; oldest below: a, far.
  succeed("image all --view waterfall -o w.png --size 500x400" + scale());
  const ReadPicture png = read_png(path("w.png"));
  const Point2 newest = brightest(png, {0.12, 0.8, 0.68, 0.92}), oldest = brightest(png, {0.12, 0.8, 0.13, 0.34});
  const Point2 middle = brightest(png, {0.12, 0.8, 0.44, 0.58});
  EXPECT_LT(newest.x, middle.x - 20);
  EXPECT_LT(middle.x, oldest.x - 20);
  // 9.5, 6.5 and 4 m: 3 m and 2.5 m apart.
  EXPECT_NEAR((oldest.x - middle.x) / (middle.x - newest.x), 3 / 2.5, 0.05);
  succeed("image all --view waterfall --beam max -o m.png --dark --size 640x480 -q");
  succeed("image all --view spectrum --ping 2 -o s.png --size 640x480 -q");
  succeed("image all --view panels --ping 1 -o p.png --size 640x480 -q");
  for (const std::string name : {"m.png", "s.png", "p.png"}) EXPECT_EQ(read_png(path(name)).width, 640) << name;
}

TEST_F(Pictures, of_a_series_have_one_scale_and_one_file_per_ping) {
  synthesize("a", {{0, 9.5}});
  synthesize("b", {{0, 6.5}}, "--set sonar.source_level_db=200");
  succeed("merge a b -o all -q");
  const ToolResult result = run("image all --animate -o frames --size 300x240");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(result.out, "frames/fan_000000.png\nframes/fan_000001.png\n");
  EXPECT_THAT(result.err, HasSubstr("ffmpeg -framerate 10 -i frames/fan_%06d.png"));
  // 20 dB weaker: alone it would be as bright as the other one.
  succeed("image all --ping 1 -o alone.png --size 300x240 -q");
  EXPECT_NE(read("alone.png"), read("frames/fan_000001.png"));
  succeed("image all --ping 0 -o first.png --size 300x240 -q");
  EXPECT_EQ(read("first.png"), read("frames/fan_000000.png"));

  expect_refused("image all --animate -o frames", 4, {"frames: exists already", "--force"});
  write("frames/note.txt", "mine");
  expect_refused("image all --animate -o frames --force", 4,
                 {"frames: holds what no run of insonify wrote", "note.txt"});
  EXPECT_EQ(read("frames/note.txt"), "mine");
  fs::remove(path("frames/note.txt"));
  succeed("image a --animate -o frames --size 300x240 --force -q");
  EXPECT_FALSE(fs::exists(path("frames/fan_000001.png")));
}

TEST_F(Pictures, take_names_from_a_file) {
  synthesize("out", {ahead});
  write("names.csv", "bearing_deg,range_m,text\n10,6,Wreck\n");
  write("bad.csv", "bearing_deg,range_m,text\n10,six,Wreck\n");
  succeed("image out -o plain.png --size 500x400 -q");
  succeed("image out -o named.png --size 500x400 --annotate names.csv -q");
  succeed("image out -o found.png --size 500x400 --annotate -q");
  succeed("image out -o one.png --size 500x400 --annotate 1 -q");
  EXPECT_NE(read("plain.png"), read("named.png"));
  EXPECT_NE(read("plain.png"), read("found.png"));
  expect_refused("image out -o x.png --annotate bad.csv", 3, {"bad.csv:2: range_m = 'six'"});
}

TEST_F(Pictures, of_runs_that_do_not_match_are_not_merged) {
  synthesize("a", {ahead});
  synthesize("b", {ahead}, "--set sonar.bin_size_m=0.02");
  expect_refused("merge a b -o all", 3, {"b: has ranges 3 to 12 m in bins of 0.02 m, not 3 to 12 m"});
  expect_refused("merge a none -o all", 4, {"none: no such run directory"});
  expect_refused("merge a -o b", 4, {"b: exists already"});
  expect_refused("merge -o all", 2, {"RUN"});
  expect_refused("merge a", 2, {"--output"});
}
