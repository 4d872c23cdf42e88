// SPDX-License-Identifier: BSD-3-Clause
// Tests what merge joins beside the cubes: returns, contributors, insonification.
#include <cmath>

#include <nlohmann/json.hpp>

#include "scene_io/load_scene.hpp"
#include "store/contributor_file.hpp"
#include "store/cube.hpp"
#include "tool/tool_runner.hpp"

using namespace insonify;

namespace {

class MergedRuns : public ToolTest {
 protected:
  void SetUp() override { have("pier.ply", "make-scene harbour --points 12000"); }
  void ping(const std::string& name, const std::string& options) const {
    succeed("ping pier.ply --sonar p900-45 --set sonar.beams=16 --range 2:15 --no-picture -q -o " + name + " " +
            options);
  }

  /// A column of float32 or uint32 of a binary PLY, as its header places it.
  std::vector<double> column(const std::string& file, const std::string& name) const {
    const std::string bytes = read(file);
    std::istringstream header(bytes.substr(0, bytes.find("end_header\n")));
    std::size_t rows = 0, stride = 0, offset = 0;
    bool real = true;
    for (std::string line; std::getline(header, line);) {
      std::istringstream words(line);
      std::string first, second, third;
      words >> first >> second >> third;
      if (first == "element") rows = std::stoul(third);
      if (first != "property") continue;
      if (third == name) offset = stride, real = second == "float";
      stride += second == "double" ? 8 : second == "ushort" ? 2 : 4;
    }
    std::vector<double> values(rows);
    const char* row = bytes.data() + bytes.find("end_header\n") + 11 + offset;
    for (std::size_t i = 0; i < rows; ++i, row += stride) {
      float number = 0;
      std::uint32_t count = 0;
      std::memcpy(&number, row, 4);
      std::memcpy(&count, row, 4);
      values[i] = real ? static_cast<double>(number) : count;
    }
    return values;
  }
};

}  // namespace

TEST_F(MergedRuns, keep_returns_contributors_and_insonification) {
  const std::string keep = " --keep contributors,insonification";
  ping("late", "--pose=0,0,-3,0,10,0 --time 2" + keep);
  ping("early", "--pose=0,1,-3,10,10,0 --time 1" + keep);
  const auto manifest = json_of("merge late early -o both");
  const Cube cube = cube_of("both");
  ASSERT_EQ(cube.pings.size(), 2u);

  // Returns: all of both, under the numbers of the merged pings, in their order.
  const Soundings early = load_soundings(path("early/returns.ply")), late = load_soundings(path("late/returns.ply")),
                  both = load_soundings(path("both/returns.ply"));
  ASSERT_GT(early.size(), 5u);
  ASSERT_EQ(both.size(), early.size() + late.size());
  EXPECT_EQ(manifest["returns"], both.size());
  EXPECT_EQ(both.position.front(), early.position.front());
  EXPECT_EQ(both.position.back(), late.position.back());
  EXPECT_EQ(both.ping.front(), static_cast<std::uint32_t>(cube.pings[0].number));
  EXPECT_EQ(both.ping.back(), static_cast<std::uint32_t>(cube.pings[1].number));
  EXPECT_THAT(read("both/returns.pcd"), HasSubstr("\nPOINTS " + std::to_string(both.size()) + "\n"));

  EXPECT_EQ(read("both/contributors/000000.h5"), read("early/contributors.h5"));
  EXPECT_EQ(read("both/contributors/000001.h5"), read("late/contributors.h5"));
  EXPECT_THAT(succeed("info --verify both"), HasSubstr("8 files match the manifest"));
  write("both/contributors/000001.h5", read("early/contributors.h5"));
  expect_refused("info --verify both", 3, {"contributors/000001.h5 was changed"});

  // Insonification: hits add up, levels are the highest, ranges the least.
  const std::string map = "/insonification.ply";
  const auto sum = column("both" + map, "scalar_hits"), first = column("early" + map, "scalar_hits"),
             second = column("late" + map, "scalar_hits");
  const auto level = column("both" + map, "scalar_level_db"), level1 = column("early" + map, "scalar_level_db"),
             level2 = column("late" + map, "scalar_level_db");
  const auto range = column("both" + map, "scalar_range"), range1 = column("early" + map, "scalar_range"),
             range2 = column("late" + map, "scalar_range");
  ASSERT_EQ(sum.size(), load_scene(path("pier.ply")).scene.size());
  std::size_t twice = 0, once = 0;
  for (std::size_t i = 0; i < sum.size(); ++i) {
    ASSERT_EQ(sum[i], first[i] + second[i]) << i;
    twice += sum[i] == 2, once += sum[i] == 1;
    if (sum[i] == 0) {
      ASSERT_TRUE(std::isnan(level[i])) << i;
    } else {
      ASSERT_EQ(level[i], std::fmax(level1[i], level2[i])) << i;
      ASSERT_EQ(range[i], std::fmin(range1[i], range2[i])) << i;
    }
  }
  EXPECT_GT(twice, 20u);
  EXPECT_GT(once, 20u);
  EXPECT_EQ(load_scene(path("both/insonification.pcd")).scene.size(), sum.size());
}

// Pings of one number are numbered anew, in their order in time, and so are their returns.
TEST_F(MergedRuns, of_one_number_are_numbered_anew) {
  ping("late", "--pose=0,0,-3,0,10,0 --time 2 --ping 7");
  ping("early", "--pose=0,1,-3,10,10,0 --time 1 --ping 7");
  succeed("merge late early -o both");
  EXPECT_EQ(read_cube(path("both/cube.h5")).pings[1].number, 1);
  const Soundings both = load_soundings(path("both/returns.ply"));
  EXPECT_EQ(both.ping.front(), 0u);
  EXPECT_EQ(both.ping.back(), 1u);
}

TEST_F(MergedRuns, leave_out_what_not_all_have_and_say_so) {
  ping("with", "--pose=0,0,-3,0,10,0 --time 1 --keep contributors,insonification");
  ping("without", "--pose=0,0,-3,0,10,0 --time 2");
  const ToolResult result = run("merge with without -o both");
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.err, HasSubstr("labels are left out"));
  EXPECT_THAT(result.err, HasSubstr("contributors.h5 is left out: without has none"));
  EXPECT_THAT(result.err, HasSubstr("insonification.ply is left out: without has none"));
  EXPECT_TRUE(std::filesystem::exists(path("both/returns.ply")));
  EXPECT_FALSE(std::filesystem::exists(path("both/contributors")));

  // Another scene: its surfels are others.
  succeed("make-scene harbour --points 12000 --seed 2 -o other.ply -q");
  succeed(
      "ping other.ply --sonar p900-45 --set sonar.beams=16 --range 2:15 --no-picture -q -o elsewhere "
      "--pose=0,0,-3,0,10,0 --keep insonification");
  ping("there", "--pose=0,0,-3,0,10,0 --keep insonification");
  EXPECT_THAT(run("merge there elsewhere -o two").err, HasSubstr("the runs are of different scenes"));
  EXPECT_FALSE(std::filesystem::exists(path("two/insonification.ply")));
}

TEST_F(MergedRuns, refuse_a_damaged_companion) {
  ping("whole", "--pose=0,0,-3,0,10,0 --time 1 --keep insonification");
  succeed("ping --run whole/run.toml --no-picture -q -o cut");
  std::filesystem::resize_file(path("cut/insonification.ply"), 4000);
  expect_refused("merge whole cut -o both", 3, {"cut/insonification.ply"});
}
