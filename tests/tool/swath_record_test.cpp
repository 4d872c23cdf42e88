// SPDX-License-Identifier: BSD-3-Clause
// Recorded swaths through the whole tool: what info says, pictures, the viewer, and comparisons with runs.
#include "formats/gsf_record.hpp"
#include "support/test.hpp"
#include "tool/tool_runner.hpp"

using namespace insonify::tool;

namespace {

/// Files of write_swaths.py, and lines of a multibeam over a level bed at z = -10 that were surveyed and exported.
class SwathRecordRun : public ToolTest {
 protected:
  bool wrote() const { return std::system(("/usr/bin/python3 " INSONIFY_WRITE_SWATHS " " + path("")).c_str()) == 0; }
  void have_swath(const std::string& name, int seed, const std::string& more = "") const {
    write("bed.obj", "v -24 -24 -10\nv 24 -24 -10\nv 24 24 -10\nv -24 24 -10\nf 1 2 3\nf 1 3 4\n");
    write(
        name + ".toml",
        "schema = 1\n[survey]\nscene = \"bed.obj\"\nstart_utc = \"2026-05-01T08:30:00Z\"\nseed = " +
            std::to_string(seed) +
            "\nanchor = { latitude_deg = 54, longitude_deg = 8, heading_deg = 40 }\n[trajectory]\nwaypoints_m = [[-2, "
            "0, 0], [2, 0, 0]]\nspeed_m_s = 1\n" +
            more +
            "[[head]]\nsonar = \"em2040\"\nname = \"swath\"\nset = [\"sonar.beams=32\", "
            "\"sonar.field_of_view_deg=90\"]\nrange = \"6:20\"\nrate_hz = 2\n[ping]\nsplit = true\nnoise = true\n");
    succeed("survey " + name + ".toml -q -o " + name);
    succeed("merge " + name + " -q");
    succeed("export " + name + " --to gsf -q -o " + name + ".gsf");
  }
};

}  // namespace

TEST_F(SwathRecordRun, info_says_what_swaths_are) {
  if (!wrote()) GTEST_SKIP() << "/usr/bin/python3 is not there";
  const nlohmann::json k = json_of("info swath.kmall");
  EXPECT_EQ(k["format"], "KMALL");
  EXPECT_EQ(k["sonar"], "EM 2040");
  EXPECT_EQ(k["pings"], 2);
  EXPECT_EQ(k["soundings"], 6);
  EXPECT_EQ(k["rejected"], 2);
  EXPECT_EQ(k["depth_m"], (std::vector<double>{20.75, 23.75}));
  EXPECT_EQ(k["across_m"], (std::vector<double>{-15.5, 14.5}));
  EXPECT_EQ(k["vertical_deviation_m"], 0.25);
  EXPECT_EQ(k["records"]["#SPO"], 1);
  const nlohmann::json x = json_of("info angles.xtf");
  EXPECT_EQ(x["format"], "R2Sonic XTF by writer");
  EXPECT_EQ(x["soundings"], 4);
  EXPECT_EQ(x["first_utc"], "2017-07-14T02:40:00.250Z");
  EXPECT_EQ(x["levels"], "dB re 1 uPa");
  const nlohmann::json g = json_of("info old.gsf");
  EXPECT_EQ(g["format"], "GSF 2.09");
  EXPECT_EQ(g["levels"], "dB re unknown");
  EXPECT_EQ(g["depth_m"], (std::vector<double>{20, 20}));
}

TEST_F(SwathRecordRun, pictures_and_the_viewer_show_soundings) {
  if (!wrote()) GTEST_SKIP() << "/usr/bin/python3 is not there";
  succeed("image swath.kmall --ping 1 -o swath.png -q");
  succeed("image angles.xtf -o angles.png -q");
  EXPECT_FALSE(read("swath.png") == read("angles.png"));
  expect_refused("image angles.xtf --ping 1 -o x.png", 2, {"--ping = 1, must be below 1"});
  expect_refused("export old.gsf --to csv -o x", 3, {"is a recording of a sonar"});
  for (const char* name : {"swath.kmall", "angles.xtf", "old.gsf"})
    EXPECT_EQ(
        std::system(
            (INSONIFY_VIEWER " " + path(name) + " --screenshot " + path("v.png") + " --force -q >/dev/null").c_str()),
        0)
        << name;
  EXPECT_NE(std::system((INSONIFY_VIEWER " " + path("old.gsf") + " --head PORT --screenshot " + path("v.png") +
                         " --force 2>/dev/null")
                            .c_str()),
            0);
}

// Two seeds over one bed differ as their predicted deviations say, in level not at all, and cover the same angles.
TEST_F(SwathRecordRun, compares_two_swaths_by_angle_and_in_cells) {
  have_swath("one", 1), have_swath("two", 2);
  const nlohmann::json i = json_of("info one.gsf");
  EXPECT_NEAR(i["depth_m"][0].get<double>(), 10, 0.2);
  EXPECT_NEAR(i["across_m"][1].get<double>(), 10, 0.6);
  const nlohmann::json r = json_of("compare one.gsf two.gsf --cell 1 --angles 15 -o compared");
  EXPECT_EQ(r["a"]["kind"], "GSF 3.11");
  EXPECT_EQ(r["a"]["pings"], 8);
  ASSERT_EQ(r["angles"].size(), 6U);
  for (const nlohmann::json& band : r["angles"]) {
    EXPECT_NEAR(band["level_difference_db"].get<double>(), 0, 3);
    EXPECT_NEAR(band["a"]["per_ping_and_degree"].get<double>(), band["b"]["per_ping_and_degree"].get<double>(), 0.05);
  }
  const nlohmann::json& cells = r["cells"];
  EXPECT_GT(cells["cells_compared"], 40);
  EXPECT_NEAR(cells["bias_m"].get<double>(), 0, 0.02);
  EXPECT_NEAR(cells["normalised_deviation"].get<double>(), 1, 0.3);
  EXPECT_EQ(nlohmann::json::parse(read("compared/compare.json")), r);
  EXPECT_THAT(succeed("compare one.gsf two.gsf --cell 1"), HasSubstr("hold two soundings of both"));
  // A run is compared by the soundings of its GSF, so the result is that of the file.
  nlohmann::json of_run = json_of("compare one two.gsf --cell 1 --angles 15");
  EXPECT_EQ(of_run["a"]["file"], "one");
  of_run["a"]["file"] = "one.gsf";
  EXPECT_EQ(of_run, r);
  EXPECT_EQ(json_of("compare one.gsf two --cell 1 --angles 15")["cells"], r["cells"]);
  write("plain.csv", "x,y,z\n");
  expect_refused("compare plain.csv two.gsf", 2, {"plain.csv: is neither a swath nor a run, and two.gsf is a swath"});
  expect_refused("compare one.gsf two.gsf --angles 0", 2, {"--angles"});
}
