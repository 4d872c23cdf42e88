// SPDX-License-Identifier: BSD-3-Clause
// Soundings that are judged wrong: left out of products, or flagged in them; and soundings placed by a wrong profile.
#include <map>
#include <sstream>

#include <nlohmann/json.hpp>

#include "core/units.hpp"
#include "formats/gsf_decoder.hpp"
#include "formats/las_decoder.hpp"
#include "formats/ros_decoder.hpp"
#include "formats/tiff_decoder.hpp"
#include "store/cube.hpp"
#include "tool/mission_text.hpp"
#include "tool/tool_runner.hpp"

namespace {

double number(const std::map<std::string, std::string>& row, const char* name) { return std::stod(row.at(name)); }

/// Fails unless the bands of accepted soundings are those of the map without rejected ones, whose bands count them all.
void expect_rejected_apart(const insonify::decode::GeotiffContent& kept, const insonify::decode::GeotiffContent& all,
                           double rejected) {
  ASSERT_EQ(kept.bands.size() + 2, all.bands.size());
  EXPECT_GT(all.columns, kept.columns);
  const auto shift = [](double from, double to, double cell) {
    return static_cast<std::size_t>(std::lround((to - from) / cell));
  };
  const std::size_t left = shift(all.west, kept.west, kept.cell), down = shift(kept.north, all.north, kept.cell);
  double counted = 0, seen = 0;
  for (const float count : all.bands[kept.bands.size()]) counted += static_cast<double>(count);
  for (std::size_t row = 0; row < kept.rows; ++row)
    for (std::size_t column = 0; column < kept.columns; ++column)
      for (std::size_t k = 0; k < kept.bands.size(); ++k) {
        const float is = all.bands[k][(row + down) * all.columns + column + left],
                    was = kept.bands[k][row * kept.columns + column];
        EXPECT_THAT(is, testing::NanSensitiveFloatEq(was));
        seen += k == 2 ? static_cast<double>(is) : 0;
      }
  for (const float count : all.bands[2]) seen -= static_cast<double>(count);
  EXPECT_EQ(seen, 0);  // no accepted sounding lies beyond the smaller map
  EXPECT_EQ(counted, rejected);
}

}  // namespace

// A swath of the built-in river, whose bed ends 8 m to either side: the outer beams hear side lobes alone.
class JudgedExport : public ToolTest {
 protected:
  void SetUp() override {
    have("river.ply", "make-scene river --points 60000");
    write("line.toml", text_of({.scene = "river.ply",
                                .survey = "anchor = { latitude_deg = 54.1, longitude_deg = 7.9, heading_deg = 30 }",
                                .way = "[12, 0, -0.5], [15, 0, -0.5]",
                                .sonar = "em2040",
                                .range = "1:14",
                                .head = "set = [\"sonar.beams=200\"]\nevery_m = 1.5",
                                .more = "[ping]\nnoise = true"}));
    succeed("survey line.toml -q -o run");
  }
  nlohmann::json exported(const std::string& to, const std::string& more, const std::string& file) const {
    return nlohmann::json::parse(succeed("export run --json -q --to " + to + " " + more + " -o " + file));
  }
};

TEST_F(JudgedExport, leaves_rejected_soundings_out_or_flags_them) {
  const std::string keep = "--keep-rejected";
  const nlohmann::json kept = exported("csv", "", "kept.csv"), all = exported("csv", keep, "all.csv");
  const double rejected = kept["rejected"];
  EXPECT_GT(rejected, 5);
  EXPECT_EQ(all["rejected"], kept["rejected"]);
  EXPECT_EQ(static_cast<double>(all["soundings"]), static_cast<double>(kept["soundings"]) + rejected);

  // Demands that all rows that the shorter table lacks are flagged, and no others.
  double flagged = 0;
  for (const auto& row : rows_of(read("all.csv"))) flagged += row.at("reject") != "0";
  EXPECT_EQ(flagged, rejected);
  for (const auto& row : rows_of(read("kept.csv"))) {
    EXPECT_EQ(row.at("reject"), "0");
    EXPECT_LT(std::abs(number(row, "y_m")), 8.5);
  }

  exported("las", keep, "all.las"), exported("las", "", "kept.las");
  exported("las", keep + " --las-version 1.2", "old.las");
  for (const char* name : {"all.las", "old.las", "kept.las"}) {
    double withheld = 0;
    for (const decode::LasRow& row : decode::read_las(read(name))) {
      withheld += row.withheld;
      EXPECT_EQ(row.classification, std::string(name) == "old.las" ? 2U : 40U);
    }
    EXPECT_EQ(withheld, std::string(name) == "kept.las" ? 0 : rejected) << name;
  }

  exported("gsf", keep, "all.gsf"), exported("gsf", "", "kept.gsf");
  std::map<int, double> flags, without;
  for (const decode::GsfSwath& s : decode::read_gsf(read("all.gsf")).swaths)
    for (std::size_t b = 0; b < s.flags.size(); ++b) {
      flags[s.flags[b]] += 1;
      if (s.flags[b] == 9) {
        EXPECT_NE(s.arrays.at(4)[b], 0);  // its travel time is there
      }
    }
  for (const decode::GsfSwath& s : decode::read_gsf(read("kept.gsf")).swaths)
    for (const int flag : s.flags) without[flag] += 1;
  EXPECT_EQ(flags[9], rejected);
  EXPECT_EQ(flags[0], static_cast<double>(kept["soundings"]));
  EXPECT_EQ(without[9], 0);
  EXPECT_EQ(without[0], flags[0]);

  exported("mcap", keep, "all.mcap");
  double in_clouds = 0;
  const decode::McapContent log = decode::read_mcap(read("all.mcap"));
  for (const auto& message : log.messages) {
    if (message.topic != "/sonar/points") continue;
    std::string raw;
    for (const double byte : message.content.numbers.at("data")) raw.push_back(static_cast<char>(byte));
    for (std::size_t at = 36; at < raw.size(); at += 40) in_clouds += decode::Cursor(raw, at).unsigned_little(4) != 0;
  }
  EXPECT_EQ(in_clouds, rejected);

  exported("geotiff", "", "kept.tif"), exported("geotiff", keep, "all.tif");
  expect_rejected_apart(decode::read_geotiff(read("kept.tif")), decode::read_geotiff(read("all.tif")), rejected);
}

TEST_F(JudgedExport, leaves_out_what_is_faint_or_uncertain_on_request) {
  exported("csv", "", "all.csv"), exported("csv", "--min-level 130", "loud.csv");
  exported("csv", "--max-deviation 0.01005", "sure.csv");
  double loud = 0, sure = 0;
  const auto all = rows_of(read("all.csv"));
  for (const auto& row : all)
    loud += number(row, "level_db") >= 130,
        sure += number(row, "deviation_m") <= 0.01005;  // between steps of the table
  EXPECT_GT(loud, 0);
  EXPECT_GT(sure, 0);
  EXPECT_LT(loud, static_cast<double>(all.size()));
  EXPECT_LT(sure, static_cast<double>(all.size()));
  EXPECT_EQ(static_cast<double>(rows_of(read("loud.csv")).size()), loud);
  EXPECT_EQ(static_cast<double>(rows_of(read("sure.csv")).size()), sure);
  expect_refused("export run --to csv --max-deviation 0 -o no.csv", 2, {"--max-deviation"});
  expect_refused("export run --to png --keep-rejected -o no", 2, {"--to = png", "has no soundings", "gsf, las"});
}

// Sound slows down by 1 m/s in every metre from 1500 m/s at the surface; a constant 1499 m/s bends a level bed into a smile.
TEST_F(JudgedExport, by_a_wrong_profile_smile_as_rays_say) {
  write("bed.obj", "v -3 -40 -20\nv 3 -40 -20\nv 3 40 -20\nv -3 40 -20\nf 1 2 3\nf 1 3 4\n");
  write("sea.toml", "[surface]\nheight_m = 0\n[profile]\ndepth_m = [0, 60]\nsound_speed = [1500, 1440]\n");
  write("true.csv", "depth_m,sound_speed\n0,1500\n60,1440\n");
  write("wrong.csv", "depth_m,sound_speed\n0,1499\n60,1499\n");
  write("line.toml", text_of({.survey = "environment = \"sea.toml\"\n"
                                        "anchor = { latitude_deg = 54.1, longitude_deg = 7.9, heading_deg = 0 }",
                              .way = "[-0.5, 0, -1], [0.5, 0, -1]",
                              .sonar = "r2sonic-2024",
                              .range = "15:40",
                              .head = "set = [\"sonar.beams=61\", \"sonar.field_of_view_deg=110\"]\nevery_m = 2",
                              .more = "[ping]\nnoise = true"}));
  succeed("survey line.toml -q -o run2");
  const auto products = [&](const std::string& to, const std::string& name, const std::string& more) {
    succeed("export run2 -q --to " + to + " " + more + " -o " + name);
    return read(name);
  };
  const std::string by_true = " --processing-profile true.csv", by_wrong = " --processing-profile wrong.csv";
  const std::string straight = products("csv", "default.csv", ""),
                    wrong = products("csv", "wrong_soundings.csv", by_wrong);
  EXPECT_EQ("# processing profile: true.csv\n" + straight, products("csv", "true_soundings.csv", by_true));
  EXPECT_THAT(wrong, testing::StartsWith("# processing profile: wrong.csv\nping,"));
  for (const char* to : {"gsf", "las", "geotiff"})
    EXPECT_THAT(products(to, std::string("wrong.") + to, by_wrong), HasSubstr("processing profile"));
  EXPECT_THAT(read("wrong.gsf"), HasSubstr("wrong.csv"));
  EXPECT_EQ(decode::read_mcap(products("mcap", "wrong.mcap", by_wrong)).metadata["/sonar/points"]["processing_profile"],
            "wrong.csv");

  succeed("merge -q run2");
  const Cube cube = cube_of("run2/r2sonic-2024");
  const auto in_truth = rows_of(straight), placed = rows_of(wrong);
  ASSERT_EQ(in_truth.size(), placed.size());
  ASSERT_GT(placed.size(), 50U);
  double low = 0, high = 0;
  for (std::size_t i = 0; i < placed.size(); ++i) {
    const double theta = cube.pings[0].fan.azimuth[static_cast<std::size_t>(number(placed[i], "beam"))];
    const double c = 1499, time = number(placed[i], "range_m") / c;
    // A gradient of -1/s lets tan(theta / 2) fall by exp(-t), the ray is an arc; at constant speed it is straight.
    const double end = 2 * std::atan(std::tan(0.5 * theta) * std::exp(-time));
    const double bent = -1 - (theta == 0 ? c * (1 - std::exp(-time)) : c * (1 - std::sin(end) / std::sin(theta)));
    EXPECT_NEAR(number(in_truth[i], "z_m"), bent, 2e-4);
    EXPECT_NEAR(number(placed[i], "z_m"), -1 - c * time * std::cos(theta), 2e-4);
    EXPECT_NEAR(number(placed[i], "y_m"), c * time * std::sin(theta), 2e-4);
    low = std::min(low, number(placed[i], "z_m") - bent), high = std::max(high, number(placed[i], "z_m") - bent);
  }
  EXPECT_GT(high, 0.05);  // up at the edges
  EXPECT_LT(low, -0.1);   // down in the middle
  expect_refused("export run2 --to csv --processing-profile none.csv -o no.csv", 4, {"none.csv"});
}
