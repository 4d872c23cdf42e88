// SPDX-License-Identifier: BSD-3-Clause
// insonify image: grey values, layers and gains.
#include "returns/ping.hpp"
#include "store/cube.hpp"
#include "support/test.hpp"
#include "tool/tool_runner.hpp"

namespace fs = std::filesystem;

namespace {

class ImageVerb : public ToolTest {
 protected:
  void SetUp() override {
    have("plane.ply", "make-scene plane --points 4000 --size 12,12");
    have("out",
         "ping plane.ply --sonar p900-45 --set sonar.beams=24 --pose=0,0,3,0,15,0 --range 4:8 --noise --layers "
         "--no-picture");
  }
  /// The pixels of a binary PGM of the run, row by row from the farthest bin, starboard right.
  std::vector<int> pixels(const std::string& name, std::size_t width, std::size_t height, int bits) const {
    const std::string bytes = read(name);
    const std::string header =
        "P5\n" + std::to_string(width) + " " + std::to_string(height) + "\n" + (bits == 8 ? "255" : "65535") + "\n";
    EXPECT_EQ(bytes.substr(0, header.size()), header);
    std::vector<int> values;
    for (std::size_t i = header.size(); i < bytes.size(); i += bits == 8 ? 1 : 2) {
      int value = static_cast<unsigned char>(bytes[i]);
      if (bits == 16) value = 256 * value + static_cast<unsigned char>(bytes[i + 1]);
      values.push_back(value);
    }
    return values;
  }
};

}  // namespace

// E58 with the window given, computed here from the cube: 24 beams, port first in the cube's order of rising azimuth.
TEST_F(ImageVerb, grey_values_are_the_levels_of_the_cube) {
  const Ping ping = ping_of("out");
  const Grid<float> level = level_db(ping);
  const std::size_t beams = ping.fan.beams(), bins = ping.gate.bins();
  const double top = std::ceil(level.maxCoeff()), window = 60;
  for (const int bits : {8, 16}) {
    succeed("image out --view grey --raw --window 60 --max " + std::to_string(top) + " --bits " + std::to_string(bits) +
            " -o grey.pgm --force -q");
    const std::vector<int> grey = pixels("grey.pgm", beams, bins, bits);
    ASSERT_EQ(grey.size(), beams * bins);
    const double full = bits == 8 ? 255 : 65535;
    std::size_t wrong = 0, at_work = 0;
    for (std::size_t row = 0; row < bins; ++row)
      for (std::size_t column = 0; column < beams; ++column) {
        const std::size_t beam = ping.fan.azimuth[0] < ping.fan.azimuth[1] ? beams - 1 - column : column;
        const double l = level(static_cast<int>(beam), static_cast<int>(bins - 1 - row));
        const double expected = std::clamp((l - top + window) / window * full, 0.0, full);
        const double value = grey[row * beams + column];
        wrong += std::abs(value - expected) > 0.5 + 1e-2;  // to the nearest
        at_work += value > 0 && value < full;
      }
    EXPECT_EQ(wrong, 0U) << bits;
    EXPECT_GT(at_work, beams * bins / 4);
  }
}

// 20 dB per decade instead of 40: 20 log10(r) less, so a grey picture whose brightest level shows which it was.
TEST_F(ImageVerb, tvg_gives_back_what_it_says) {
  const Cube cube = cube_of("out");
  const std::size_t beams = 24, bins = cube.pings[0].gate.bins();
  const auto grey = [&](const std::string& tvg) {
    succeed("image out --view grey --bits 16 --max 220 --window 200 --tvg " + tvg + " -o tvg.pgm --force -q");
    return pixels("tvg.pgm", beams, bins, 16);
  };
  const std::vector<int> forty = grey("40"), twenty = grey("20");
  const double step = 200.0 / 65535;
  for (const std::size_t bin : {std::size_t{10}, bins / 2, bins - 10}) {
    const std::size_t at = (bins - 1 - bin) * beams + 12;
    EXPECT_NEAR((forty[at] - twenty[at]) * step, 20 * std::log10(cube.pings[0].gate.centre(bin)), 2 * step);
  }
}

TEST_F(ImageVerb, a_layer_can_be_drawn_alone) {
  succeed("image out --view grey --max 200 --window 200 -o all.pgm -q");
  succeed("image out --view grey --max 200 --window 200 --layer direct -o direct.pgm -q");
  succeed("image out --view grey --max 200 --window 200 --layer noise -o noise.pgm -q");
  EXPECT_NE(read("direct.pgm"), read("noise.pgm"));
  EXPECT_NE(read("all.pgm"), read("noise.pgm"));
  succeed("image out --layer noise --size 400x300 -o noise.png -q");
  EXPECT_EQ(read("noise.png").substr(1, 3), "PNG");
}

TEST_F(ImageVerb, bad_input_gets_one_line) {
  expect_refused("image out --view grey -o grey.jpg", 2, {"grey.jpg", ".png or .pgm"});
  expect_refused("image out --view grey --bits 12 -o grey.png", 2, {"--bits", "12"});
  expect_refused("image out --view grey --tvg much -o grey.png", 2, {"--tvg", "much"});
  expect_refused("image out --tvg nan -o x.png", 2, {"--tvg", "nan", "is not a number"});
  expect_refused("image out --tvg 1e4 -o x.png", 2, {"--tvg = 10000 dB, must be within -1000 and 1000"});
  expect_refused("image out --tvg 30 --raw -o x.png", 2, {"--tvg", "--raw"});
  expect_refused("image out --window 0 -o x.png", 2, {"--window = 0 dB", "must be > 0"});
  expect_refused("image out --window inf -o x.png", 2, {"--window = inf dB"});
  expect_refused("image out --max bright -o x.png", 2, {"--max = 'bright' is not a number"});
  expect_refused("image out --layer multipath -o x.png", 2, {"--layer = 'multipath'", "it has direct, noise"});
  expect_refused("image out --view sonogram -o x.png", 2, {"--view", "sonogram"});
  expect_refused("image out --ping 3 -o x.png", 2, {"--ping = 3", "must be below 1"});
  expect_refused("image out --beam 24 -o x.png", 2, {"--beam = 24", "must be below 24"});
  expect_refused("image out --beam=-1 -o x.png", 2, {"--beam = -1", "from 0"});
  expect_refused("image out --beam 2.5 -o x.png", 2, {"--beam = 2.5", "from 0"});
  expect_refused("image out --beam all -o x.png", 2, {"--beam = 'all'", "not a number"});
  expect_refused("image out --size 200x240 -o x.png", 2, {"200 x 240 pixels", "must be 240 to 8192"});
  expect_refused("image out --size 9000x80 -o x.png", 2, {"9000"});
  expect_refused("image out --view panels --size 480x360 -o x.png", 2, {"480 x 360", "at least 640 x 480"});
  expect_refused("image out --annotate some -o x.png", 2, {"--annotate = 'some' is not a number"});
  expect_refused("image out --annotate 0 -o x.png", 2, {"--annotate = 0", "1 to 1000, or a .csv file"});
  expect_refused("image out --annotate none.csv -o x.png", 4, {"none.csv", "no such file"});
  expect_refused("image out --view ascan --annotate -o x.png", 2, {"--annotate goes with", "not ascan"});
  expect_refused("image out --view waterfall -o x.png", 3, {"out: holds one ping", "insonify merge"});
  expect_refused("image out --view waterfall --animate -o frames", 2, {"--animate", "waterfall"});
  expect_refused("image out -o nowhere/x.png", 4, {"nowhere/x.png"});
}

TEST_F(ImageVerb, existing_files_are_replaced_with_force_alone) {
  write("x.png", "mine");
  expect_refused("image out -o x.png", 4, {"x.png: exists already", "--force"});
  EXPECT_EQ(read("x.png"), "mine");
  succeed("image out -o x.png --size 400x300 --force -q");
  EXPECT_EQ(read("x.png").substr(1, 3), "PNG");
  expect_refused("image out --animate -o x.png --force", 4, {"x.png: is not a folder of an earlier run"});
}

TEST_F(ImageVerb, runs_that_are_none_are_told_apart) {
  expect_refused("image nowhere -o x.png", 4, {"nowhere: no such run directory or cube"});
  fs::create_directory(path("empty"));
  expect_refused("image empty -o x.png", 3, {"empty: holds no cube.h5"});
  write("plain.h5", "not HDF5");
  expect_refused("image plain.h5 -o x.png", 3, {"plain.h5: is not an HDF5 file"});

  // A cube of which the end was never written.
  fs::create_directory(path("half"));
  const std::string cube = read("out/cube.h5");
  write("half/cube.h5", cube.substr(0, cube.size() / 2));
  expect_refused("image half -o x.png", 3, {"half/cube.h5: is damaged or cut short"});

  // The eight bytes of the attribute follow its name and type.
  std::string other = cube;
  const std::size_t value = other.rfind(std::string("\x01\0\0\0\0\0\0\0", 8), other.find("schema") + 64);
  ASSERT_NE(value, std::string::npos);
  other[value] = 7;
  write("other.h5", other);
  expect_refused("image other.h5 -o x.png", 3, {"other.h5: has cube schema 7, this version reads schema 1"});
}
