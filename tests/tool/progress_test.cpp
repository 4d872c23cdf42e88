// SPDX-License-Identifier: BSD-3-Clause
// On a terminal the tool says how far it is and how long it will take.
#include <regex>

#include "tool/tool_runner.hpp"

using namespace insonify;

namespace {

class ProgressBar : public ToolTest {
 protected:
  /// Returns what a terminal shows of `insonify ARGUMENTS`.
  std::string shown(const std::string& arguments) const {
    const std::string command = "cd '" + folder_.string() + "' && script -qec '" INSONIFY_TOOL " " + arguments +
                                "' typescript > screen 2>&1 < /dev/null";
    EXPECT_EQ(std::system(command.c_str()), 0) << read("screen");
    return read("screen");
  }
};

}  // namespace

TEST_F(ProgressBar, names_the_stage_its_share_and_the_time_left) {
  have("plane.ply", "make-scene plane --points 8000 --size 10,10");
  const std::string screen = shown(
      "ping plane.ply --sonar p900-45 --pose=0,0,2,0,30,0 --range 1:12 --method direct --scatterers-per-cell 0 -j1 "
      "--no-picture -o slow");
  std::vector<int> percent;
  const std::regex line("pinging: synthesis ([0-9]+) %, ([0-9:]+) (s|min) left");
  for (std::sregex_iterator i(screen.begin(), screen.end(), line), end; i != end; ++i)
    percent.push_back(std::stoi((*i)[1]));
  ASSERT_GE(percent.size(), 2u) << screen.substr(0, 2000);
  EXPECT_TRUE(std::is_sorted(percent.begin(), percent.end()));
  EXPECT_GT(percent.back(), percent.front());
  // The line of what was written stands alone.
  EXPECT_THAT(screen, HasSubstr("\033[Kslow: "));
}

TEST_F(ProgressBar, of_info_says_what_is_read) {
  have("plane.ply", "make-scene plane --points 8000 --size 10,10");
  const std::string screen = shown("info plane.ply");
  EXPECT_THAT(screen, HasSubstr("] reading plane.ply"));
  EXPECT_LT(screen.rfind("reading plane.ply"), screen.find("points     8000")) << "the bar ends before the facts";
  EXPECT_EQ(run("info plane.ply").err, "");
}

TEST_F(ProgressBar, is_absent_where_nobody_looks_or_asks) {
  have("plane.ply", "make-scene plane --points 8000 --size 10,10");
  EXPECT_EQ(shown("prepare plane.ply -o quiet.ply -q").find('['), std::string::npos);
  EXPECT_EQ(run("prepare plane.ply -o piped.ply").err.find('['), std::string::npos);
}
