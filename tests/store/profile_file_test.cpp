// SPDX-License-Identifier: BSD-3-Clause
#include "sonar/water.hpp"
#include "store/csv_tables.hpp"
#include "support/test.hpp"

namespace {
void refuses_profile(const std::string& text, const std::string& what) {
  EXPECT_EQ(error_of_file(load_sound_speed_profile, "cast.csv", text), "content: cast.csv:" + what);
}
}  // namespace

TEST(ProfileFile, reads_depths_and_sound_speeds_in_any_order_of_columns) {
  const auto p =
      load_sound_speed_profile(own_file("p.csv", "# cast 7\nsound_speed, depth_m\n1510,-1\n\n# warm\n1500.5,2.5\n"));
  EXPECT_EQ(p.depth, (std::vector<double>{-1, 2.5}));
  EXPECT_EQ(p.sound_speed, (std::vector<double>{1510, 1500.5}));
}

TEST(ProfileFile, turns_temperature_and_salinity_into_sound_speed_at_their_depth) {
  const auto p = load_sound_speed_profile(own_file("p.csv", "salinity_psu,depth_m,temperature_c\n35,0,20\n0,50,4\n"));
  Water top, deep;
  top.temperature_c = 20;
  top.salinity_psu = 35;
  deep.temperature_c = 4;
  deep.salinity_psu = 0;
  deep.depth = 50;
  EXPECT_EQ(p.depth, (std::vector<double>{0, 50}));
  EXPECT_EQ(p.sound_speed, (std::vector<double>{sound_speed(top), sound_speed(deep)}));
}

TEST(ProfileFile, names_a_header_that_is_neither) {
  refuses_profile("depth_m,temperature_c\n", "1: missing column 'salinity_psu'");
  refuses_profile("depth_m\n", "1: missing column 'sound_speed'");
  refuses_profile("depth,sound_speed\n", "1: unknown column 'depth'; did you mean 'depth_m'?");
  refuses_profile("depth_m,sound_speed,salinity_psu\n",
                  "1: column 'salinity_psu' cannot be combined with 'sound_speed'");
  refuses_profile("depth_m,depth_m\n", "1: column 'depth_m' occurs twice");
  refuses_profile("", " has no header, must start with depth_m,sound_speed or depth_m,temperature_c,salinity_psu");
}

TEST(ProfileFile, names_line_column_value_and_rule) {
  const std::string speeds = "depth_m,sound_speed\n0,1500\n", water = "depth_m,temperature_c,salinity_psu\n";
  refuses_profile(speeds + "0,1500\n", "3: depth_m = 0 m, must be deeper than the previous line, 0 m");
  refuses_profile(speeds + "1,343\n", "3: sound_speed = 343 m/s, must be within 1300 and 1700 m/s");
  refuses_profile(speeds + "1,fast\n", "3: sound_speed = 'fast', must be a finite number");
  refuses_profile(speeds + "1\n", "3: has 1 fields, the header has 2");
  refuses_profile(water + "-1,10,35\n", "2: depth_m = -1 m, must be >= 0 (it is positive down)");
  refuses_profile(water + "1,290,35\n", "2: temperature_c = 290 deg C, must be within -4 and 100");
  refuses_profile(water + "1,10,-35\n", "2: salinity_psu = -35 psu, must be within 0 and 400");
  refuses_profile("depth_m,sound_speed\n", " has a header only, must have at least one entry");
}
