// SPDX-License-Identifier: BSD-3-Clause
// Surveys whose installation is assumed wrongly, or that have a tide: what tables, GSF and pictures make of them.
#include <nlohmann/json.hpp>

#include "core/pose.hpp"
#include "core/units.hpp"
#include "formats/gsf_decoder.hpp"
#include "tool/gsf_rays.hpp"
#include "tool/mission_text.hpp"
#include "tool/tool_runner.hpp"

namespace {

const std::string steady_head =
    "name = \"swath\"\nset = [\"sonar.beams=17\", \"sonar.field_of_view_deg=80\"]\nrate_hz = 4\n";

/// Positions of soundings of a table, by ping and beam.
std::map<std::pair<int, int>, Eigen::Vector3d> places_of(const std::string& csv) {
  std::map<std::pair<int, int>, Eigen::Vector3d> places;
  for (const auto& row : rows_of(csv))
    places[{std::stoi(row.at("ping")), std::stoi(row.at("beam"))}] = {
        std::stod(row.at("x_m")), std::stod(row.at("y_m")), std::stod(row.at("z_m"))};
  return places;
}

}  // namespace

class InstallationRun : public ToolTest {
 protected:
  void SetUp() override {
    write("bed.obj", "v -6 -14 -6\nv 6 -14 -6\nv 6 14 -6\nv -6 14 -6\nf 1 2 3\nf 1 3 4\n");
    write("true.toml", mission("", ""));
    have("true", "survey true.toml -q");
  }
  /// A mission along x at 2 m/s, 1 m below the datum.
  static std::string mission(const std::string& head, const std::string& more, const std::string& way = "") {
    return text_of({.survey = "anchor = { latitude_deg = 54.1, longitude_deg = 7.9, heading_deg = 30 }",
                    .way = "[-1, 0, -1], [1, 0, -1]",
                    .speed = "2" + way,
                    .sonar = "em2040",
                    .range = "3:12",
                    .head = steady_head + head,
                    .more = more + "\n[ping]\nsplit = true"});
  }
  std::string exported(const std::string& run, const std::string& to, const std::string& more = "") const {
    succeed("export " + run + " -q --force --to " + to + " -o product." + to + " " + more);
    return read("product." + to);
  }
};

// The echoes are those of the true head: what it is believed to be turns and moves them as a whole.
TEST_F(InstallationRun, errors_move_soundings_of_the_same_echoes) {
  write("wrong.toml", mission("latency_s = 0.1\ndraught_m = 0.5\n[head.assumed]\nroll_deg = 2\nheading_deg = 3\n"
                              "offset_m = [0.4, 0, 0]\nlatency_s = 0\ndraught_m = 0.8\n",
                              ""));
  succeed("survey wrong.toml -q -o wrong");
  const auto truth = places_of(exported("true", "csv")), wrong = places_of(exported("wrong", "csv"));
  const Pose down = pose_from_yaw_pitch_roll({0, 0, 0}, 0, radians(90), 0);
  const Pose assumed = pose_from_yaw_pitch_roll({0.4, 0, 0}, radians(-3), 0, radians(2)) * down;
  ASSERT_EQ(truth.size(), wrong.size());
  ASSERT_GT(truth.size(), 50U);
  for (const auto& [which, place] : truth) {
    const Eigen::Vector3d ship(-1 + 0.5 * which.first, 0, -1);
    const Eigen::Vector3d in_head = down.inverse() * (place - ship);
    const Eigen::Vector3d believed = ship + Eigen::Vector3d(-0.1 * 2, 0, -0.3) + assumed * in_head;
    EXPECT_LT((wrong.at(which) - believed).norm(), 3e-3) << which.first << ' ' << which.second;
  }
  const decode::GsfContent gsf = decode::read_gsf(exported("wrong", "gsf"));
  EXPECT_NEAR(std::stod(gsf.parameter.at("APPLIED_TRANSDUCER_ROLL_OFFSET")), 2, 0.01);
  EXPECT_NEAR(std::stod(gsf.parameter.at("APPLIED_TRANSDUCER_HEADING_OFFSET")), 3, 0.01);
  EXPECT_LT(largest_difference(gsf), 0.01) << "a reader places the same soundings from angles and times";
  for (const decode::GsfSwath& s : gsf.swaths) {
    EXPECT_NEAR(s.roll_deg, 0, 0.011) << "the ship's, which is known";
    EXPECT_NEAR(s.depth_corrector, 1.3, 0.006);
  }
}

TEST_F(InstallationRun, another_sound_speed_at_the_head_widens_the_swath_of_a_level_bed) {
  write("slow.toml", mission("[head.assumed]\nsound_speed_m_s = 1480\n", ""));
  succeed("survey slow.toml -q -o slow");
  const decode::GsfContent gsf = decode::read_gsf(exported("slow", "gsf"));
  const double c = decode::read_gsf(exported("true", "gsf")).profile.front().second;
  std::size_t outer = 0;
  for (const decode::GsfSwath& s : gsf.swaths)
    for (std::size_t b = 0; b < s.flags.size(); ++b) {
      if (s.flags[b] != 0) continue;
      const double angle = radians(s.arrays.at(5)[b]), sine = std::sin(angle) * c / 1480;
      // The bed is 5 m below the head: echo and beam come from where c steers the array.
      const double time = 2 * 5 / std::sqrt(1 - sine * sine) / c;
      EXPECT_NEAR(s.arrays.at(4)[b] * 1480 / 2, time * 1480 / 2, 0.02) << b;
      EXPECT_NEAR(s.arrays.at(1)[b] - 1, time * 1480 / 2 * std::cos(angle), 0.02) << b;
      outer += angle > radians(30);
    }
  EXPECT_GT(outer, 10U);
  EXPECT_NEAR(gsf.profile.front().second, 1480, 0.011);
}

TEST_F(InstallationRun, an_assumed_profile_places_soundings_as_the_option_does) {
  write("late.csv", "depth_m,sound_speed\n0,1480\n3,1500\n");
  write("late.toml", mission("[head.assumed]\nprofile = \"late.csv\"\n", "[water]\nlevel_m = 0"));
  write("level.toml", mission("", "[water]\nlevel_m = 0"));
  succeed("survey late.toml -q -o late");
  succeed("survey level.toml -q -o level");
  EXPECT_EQ(exported("late", "csv"), exported("level", "csv", "--processing-profile late.csv"));
  EXPECT_NE(exported("late", "csv"), exported("level", "csv"));
}

TEST_F(InstallationRun, a_tide_moves_the_water_of_each_ping_and_a_ship_on_it) {
  write("tide.csv", "time_s,height_m\n-1,0\n0.5,0.75\n2,0.6\n");
  write("tide.toml", mission("", "[tide]\nfile = \"tide.csv\"", "\nheights_from = \"water\""));
  succeed("survey tide.toml -q -o tide");
  const std::string reduced = exported("tide", "csv");
  for (const auto& [which, place] : places_of(reduced)) EXPECT_NEAR(place.z(), -6, 0.05);
  const decode::GsfContent gsf = decode::read_gsf(exported("tide", "gsf"));
  const double heights[] = {0.5, 0.625, 0.75, 0.725};  // at 0, 0.25, 0.5 and 0.75 s
  ASSERT_EQ(gsf.swaths.size(), 4U);
  EXPECT_LT(largest_difference(gsf), 0.02);
  for (std::size_t p = 0; p < 4; ++p) {
    EXPECT_NEAR(gsf.swaths[p].tide, -heights[p], 0.0051) << p;
    EXPECT_NEAR(gsf.swaths[p].depth_corrector, 1, 0.0051) << "the head rises with the water";
    EXPECT_NEAR(gsf.swaths[p].height - gsf.swaths[p].separation, heights[p] - 1, 0.002);
  }
  // Without reduction depths count from the water; with a tide that is 0.2 m too high, the bed is 0.2 m too high.
  const decode::GsfContent none = decode::read_gsf(exported("tide", "gsf", "--tide none"));
  for (std::size_t p = 0; p < 4; ++p) {
    EXPECT_EQ(none.swaths[p].tide, 0);
    std::size_t found = 0;
    for (std::size_t b = 0; b < none.swaths[p].flags.size(); ++b) {
      if (none.swaths[p].flags[b] != 0) continue;
      ++found;
      EXPECT_NEAR(none.swaths[p].arrays.at(1)[b], 6 + heights[p], 0.05) << p;
    }
    EXPECT_GT(found, 10U);
  }
  EXPECT_EQ(none.parameter.at("TIDE_COMPENSATED"), "NO");
  write("high.csv", "time_s,height_m\n-1,0.2\n0.5,0.95\n2,0.8\n");
  const auto places = places_of(reduced), high = places_of(exported("tide", "csv", "--tide high.csv"));
  for (const auto& [which, place] : places)
    EXPECT_LT((high.at(which) - place - Eigen::Vector3d(0, 0, 0.2)).norm(), 2e-4);
  expect_refused("export true --to csv -o x.csv --tide high.csv", 2, {"does not say where its water level is"});
}

TEST_F(InstallationRun, image_takes_the_folder_of_a_survey_and_draws_its_depths) {
  const nlohmann::json depths = json_of("image true --view bathymetry -o depths.png");
  EXPECT_GT(depths.at("soundings"), 50);
  EXPECT_GT(read("depths.png").size(), 5000U);
  succeed("image true -q -o fan.png");
  succeed("image true -q --head swath --view waterfall -o waterfall.png");
  expect_refused("image true --head other -o x.png", 2, {"--head = 'other' must name a head of true", "swath"});
  expect_refused("image true --view bathymetry --cell 0 -o x.png", 2, {"--cell = 0 m, must be > 0"});
}
