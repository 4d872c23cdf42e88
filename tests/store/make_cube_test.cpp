// SPDX-License-Identifier: BSD-3-Clause
#include "acoustics/environment.hpp"
#include "store/cube.hpp"
#include "support/heads.hpp"
#include "support/test.hpp"

TEST(MakeCube, says_what_head_water_and_options_say) {
  SonarHead head = small_head({.source_level_db = 207});
  head.name = "my-head";
  SimulationOptions options;
  options.seed = 18446744073709551557u;
  options.synthesis.tolerance = 3e-3;
  const Cube cube = make_cube(head, medium_of(Water{.temperature_c = 4}, 450e3), options);
  EXPECT_TRUE(cube.pings.empty());
  EXPECT_EQ(cube.sonar, "my-head");
  EXPECT_EQ(cube.centre_frequency, 450e3);
  EXPECT_EQ(cube.bandwidth, 20e3);
  EXPECT_EQ(cube.source_level_db, 207);
  EXPECT_EQ(cube.sound_speed, sound_speed(Water{.temperature_c = 4}));
  EXPECT_NEAR(cube.absorption_db_per_m, absorption_db_per_m(Water{.temperature_c = 4}, 450e3), 1e-15);
  EXPECT_EQ(cube.seed, 18446744073709551557u);
  EXPECT_EQ(cube.tolerance, 3e-3);
  EXPECT_EQ(cube.insonify_version.substr(0, 2), "0.");
}

TEST(MakeCube, refuses_a_head_without_beams_and_water_without_sound) {
  SonarHead head = small_head({});
  EXPECT_THROW(make_cube(head, Medium{0, {}}), Error);
  head.fan = {};
  EXPECT_THROW(make_cube(head, medium_of(Water{}, 450e3)), Error);
}
