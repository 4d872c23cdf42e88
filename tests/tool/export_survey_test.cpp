// SPDX-License-Identifier: BSD-3-Clause
// Products of a whole survey, read by the decoders of tests/formats.
#include <nlohmann/json.hpp>

#include "core/geodesy.hpp"
#include "formats/gsf_decoder.hpp"
#include "formats/las_decoder.hpp"
#include "formats/ros_decoder.hpp"
#include "formats/tiff_decoder.hpp"
#include "store/cube.hpp"
#include "tool/mission_text.hpp"
#include "tool/tool_runner.hpp"

// A survey of two blocks over a level bed: each product has all its pings, at the position and time that the mission gives.
class ExportSurvey : public ToolTest {
 protected:
  static constexpr double bed_depth = 4;
  void SetUp() override {
    write("bed.obj", "v -3 -14 -4\nv 3 -14 -4\nv 3 14 -4\nv -3 14 -4\nf 1 2 3\nf 1 3 4\n");
    write("line.toml", text_of({.survey = "anchor = { latitude_deg = 54.1, longitude_deg = 7.9, heading_deg = 30 }\n"
                                          "start_utc = \"2026-05-01T08:30:00Z\"",
                                .way = "[-1, 0, 0], [1, 0, 0]",
                                .sonar = "r2sonic-2024",
                                .range = "2:8",
                                .head = "set = [\"sonar.beams=33\", \"sonar.field_of_view_deg=90\"]\nevery_m = 0.5",
                                .more = "[[leg]]\nname = \"first\"\nto_s = 1\n[[leg]]\nname = \"second\"\n"
                                        "[ping]\nnoise = true\nsplit = true"}));
    succeed("survey line.toml -q --pings-per-block 3 -o run");
  }
};

TEST_F(ExportSurvey, has_all_pings_in_every_product) {
  for (const char* to : {"gsf", "las", "csv", "geotiff", "mcap", "png"})
    succeed("export run -q --to " + std::string(to) + " -o product." + to);
  succeed("merge -q run");
  succeed("export run -q -o vtk");

  const decode::GsfContent gsf = decode::read_gsf(read("product.gsf"));
  ASSERT_EQ(gsf.swaths.size(), 4U);
  const Anchor anchor{54.1, 7.9, 30};
  std::size_t soundings = 0;
  for (std::size_t p = 0; p < 4; ++p) {
    const decode::GsfSwath& s = gsf.swaths[p];
    EXPECT_NEAR(s.time, 1777624200 + 0.5 * static_cast<double>(p), 1e-6);
    EXPECT_NEAR(s.heading_deg, 30, 0.011);
    if (p > 0) {
      EXPECT_NEAR(s.speed_knots, 1 / 0.514444, 0.02);
    }
    const GeoPosition head = geo_from_world(anchor, {-1 + 0.5 * static_cast<double>(p), 0, 0});
    EXPECT_NEAR(s.latitude_deg, degrees(head.latitude), 0.6e-7);
    EXPECT_NEAR(s.longitude_deg, degrees(head.longitude), 0.6e-7);
    for (std::size_t b = 0; b < s.flags.size(); ++b)
      if (s.flags[b] == 0) {
        ++soundings;
        EXPECT_NEAR(s.arrays.at(1)[b], bed_depth, 0.1);
        EXPECT_NEAR(s.arrays.at(2)[b],
                    bed_depth * std::tan(radians(s.arrays.at(5)[b])) * (2 * b < s.flags.size() ? -1 : 1), 0.1);
      }
  }
  EXPECT_GT(soundings, 4 * 31U);

  const std::vector<decode::LasRow> las = decode::read_las(read("product.las"));
  EXPECT_EQ(las.size(), soundings);
  EXPECT_EQ(decode::Cursor(read("product.las"), 90).unsigned_little(2), 121U);  // 1 May
  EXPECT_EQ(decode::Cursor(read("product.las"), 92).unsigned_little(2), 2026U);
  for (const decode::LasRow& row : las) {
    EXPECT_NEAR(row.position[2], -bed_depth, 0.1);
    EXPECT_EQ(row.source, row.ping < 2 ? 1U : 2U);
    EXPECT_EQ(row.returns, 1U);
    const Eigen::Vector3d world =
        world_from_geo(anchor, geo_position_of(UtmPosition{row.position[0], row.position[1]}, {32, true}));
    EXPECT_NEAR(row.scan_angle_deg, degrees(std::atan2(-world.y(), bed_depth)), 1);  // positive to starboard
  }
  succeed("export run -q --to las --las-version 1.2 --per-beam 3 -o old.las");
  const std::vector<decode::LasRow> old = decode::read_las(read("old.las"));
  EXPECT_GE(old.size(), las.size());
  for (const decode::LasRow& row : old) EXPECT_LE(row.return_number, row.returns);
  const std::string csv = read("product.csv");
  EXPECT_EQ(static_cast<std::size_t>(std::count(csv.begin(), csv.end(), '\n')), soundings + 1);
  EXPECT_THAT(csv, HasSubstr("latitude_deg"));
  const decode::GeotiffContent map = decode::read_geotiff(read("product.geotiff"));
  double counted = 0;
  for (std::size_t i = 0; i < map.bands[2].size(); ++i) {
    counted += static_cast<double>(map.bands[2][i]);
    if (map.bands[2][i] > 0) {
      EXPECT_NEAR(map.bands[0][i], -bed_depth, 0.1);
    }
  }
  EXPECT_EQ(counted, static_cast<double>(soundings));
  EXPECT_EQ(decode::read_mcap(read("product.mcap")).messages.size(), 4 * 5U + 1);  // with a fix of each ping
  EXPECT_EQ(manifest_of("product.png")["pings"].size(), 4U);
  EXPECT_TRUE(std::filesystem::exists(path("product.png/fan_000003.png")));
  EXPECT_TRUE(std::filesystem::exists(path("vtk/fan_000003.vts")));
  EXPECT_TRUE(std::filesystem::exists(path("vtk/returns.vtp")));
}

// Without --head each head has a file of its own; nothing is written if one of them would replace another file.
TEST_F(ExportSurvey, gives_a_file_for_each_head) {
  write("two.toml", replaced(read("line.toml"), "[[leg]]\nname = \"first\"",
                             "[[head]]\nname = \"other\"\nsonar = \"em2040\"\nrange = \"2:8\"\nroll_deg = 20\nset = "
                             "[\"sonar.beams=17\", \"sonar.field_of_view_deg=60\"]\nevery_m = 1\n[[leg]]\nname = "
                             "\"first\""));
  succeed("survey two.toml -q -o two");
  write("s-other.csv", "mine");
  expect_refused("export two --to csv -o s.csv", 4, {"s-other.csv: exists already"});
  EXPECT_FALSE(std::filesystem::exists(path("s-r2sonic-2024.csv")));
  for (const std::string to : {"csv", "gsf", "las", "geotiff"}) {
    succeed("export two -q --force --to " + to + " -o s." + to);
    EXPECT_FALSE(std::filesystem::exists(path("s." + to)));
    for (const std::string head : {"r2sonic-2024", "other"}) {
      succeed("export two -q --force --head " + head + " --to " + to + " -o one");
      EXPECT_TRUE(read("s-" + head + "." + to) == read("one")) << head << " " << to;
    }
  }
  EXPECT_EQ(decode::read_gsf(read("s-other.gsf")).swaths.at(0).sensor, 149);
  EXPECT_EQ(decode::read_gsf(read("s-r2sonic-2024.gsf")).swaths.at(0).sensor, 152);
  succeed("export two -q -o vtk/");
  EXPECT_TRUE(std::filesystem::exists(path("vtk-other/fan.pvd")));
}
