// SPDX-License-Identifier: BSD-3-Clause
// Tests what every verb prints: with --json one JSON value and nothing else, with -q no line of what was written.
#include <set>

#include <nlohmann/json.hpp>

#include "tool/tool_runner.hpp"
#include "tool/verbs_in_help.hpp"

using namespace insonify;

namespace {

/// Verbs that make files, with a command for each; OUT stands for the file or folder to make.
struct MakingCommand {
  const char *verb, *arguments, *key;  ///< key: that the JSON must hold
};
constexpr MakingCommand making_commands[] = {
    {"make-scene", "plane --points 500 --size 6,4 -o OUT.ply", "surfels"},
    {"make-object", "tyre -o OUT.ply", "triangles"},
    {"make-mission", "lawnmower --scene plane.ply -o OUT.toml", "output"},
    {"prepare", "plane.ply -o OUT.ply", "surfels"},
    {"prepare", "plane.ply -o OUT.tiles", "tiles"},
    {"ping", "plane.ply --sonar p900-45 --pose=0,0,2,0,30,0 --range 2:5 --no-picture -o OUT", "peak_level_db"},
    {"synthesize", "points.csv --sonar p900-45 --range 1:4 --no-picture -o OUT", "peak_level_db"},
    {"image", "run --view grey -o OUT.png", "view"},
    {"image", "run --view rect --animate -o OUT", "view"},
    {"export", "run -o OUT", "grids"},
    {"export", "run --to csv -o OUT.csv", "soundings"},
    {"merge", "run -o OUT", "pings"}};

/// Verbs whose result is what they print.
constexpr const char* saying_commands[] = {
    "info plane.ply",          "make-object",
    "make-object tyre --list", "sonars",
    "sonars p900-45",          "plan plane.ply --sonar p900-45 --pose=0,0,2,0,30,0 --range 2:5",
    "beampattern p900-45"};

class EveryVerb : public ToolTest {
 protected:
  void SetUp() override {
    have("plane.ply", "make-scene plane --points 500 --size 6,4");
    write("points.csv", "range_m,azimuth_rad,elevation_rad,sigma_m2,xi_re,xi_im\n2,0.1,0,0.05,1,0\n");
    have("run", "ping plane.ply --sonar p900-45 --pose=0,0,2,0,30,0 --range 2:5 --no-picture");
  }
  static std::string line(const MakingCommand& command, const std::string& output) {
    std::string text = std::string(command.verb) + " " + command.arguments;
    return text.replace(text.find("OUT"), 3, output);
  }
};

}  // namespace

TEST_F(EveryVerb, prints_json_and_nothing_else) {
  int number = 0;
  for (const MakingCommand& command : making_commands) {
    const std::string text = line(command, "json" + std::to_string(number++)) + " --json";
    const auto json = nlohmann::json::parse(succeed(text), nullptr, false);
    ASSERT_TRUE(json.is_object()) << text;
    EXPECT_TRUE(json.contains(command.key)) << text << " lacks " << command.key;
  }
  for (const char* command : saying_commands)
    EXPECT_FALSE(nlohmann::json::parse(succeed(std::string(command) + " --json"), nullptr, false).is_discarded())
        << command;
}

TEST_F(EveryVerb, is_quiet_when_asked) {
  int number = 0;
  for (const MakingCommand& command : making_commands) {
    const std::string output = "quiet" + std::to_string(number++);
    const ToolResult result = run(line(command, output) + " -q");
    EXPECT_EQ(result.exit_code, 0) << command.arguments;
    EXPECT_EQ(result.out + result.err, "") << command.arguments;
  }
  for (const char* command : saying_commands) EXPECT_NE(succeed(std::string(command) + " -q"), "") << command;
}

TEST_F(EveryVerb, takes_json_and_quiet) {
  const std::set<std::string> others = {"view", "completion", "man"};  // a program of its own, and texts for programs
  for (const std::string& verb : verbs_in(succeed("--help"))) {
    if (others.contains(verb)) continue;
    const std::string help = succeed(verb + " --help");
    EXPECT_THAT(help, HasSubstr("--json")) << verb;
    EXPECT_THAT(help, HasSubstr("--quiet")) << verb;
  }
}
