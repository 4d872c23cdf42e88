// SPDX-License-Identifier: BSD-3-Clause
// Bad environments, ways and pulses: one line with what was said, the value, its unit and the rule; nothing left
// behind.
#include "support/test.hpp"
#include "tool/tool_runner.hpp"

namespace {

const std::string here = " --sonar p900-45 --pose=0,0,3,0,15,0 --range 2:10 -o out";
const std::string nowhere = " --sonar p900-45 --range 2:10 -o out";

class BadEnvironment : public ToolTest {
 protected:
  void SetUp() override { have("plane.ply", "make-scene plane --points 2000 --size 12,12"); }
  void refuse(const std::string& more, const std::vector<std::string>& parts, int exit_code = 2) const {
    expect_refused("ping plane.ply" + here + " " + more, exit_code, parts);
  }
  void refuse_file(const std::string& text, const std::vector<std::string>& parts) const {
    write("sea.toml", text);
    refuse("--environment sea.toml", parts, 3);
  }
  void refuse_profile(const std::string& text, const std::vector<std::string>& parts) const {
    write("ctd.csv", text);
    refuse("--profile ctd.csv", parts, 3);
  }
};

}  // namespace

TEST_F(BadEnvironment, set_out_of_range) {
  refuse("--set surface.height_m=high", {"surface.height_m = \"high\"", "must be a number"});
  refuse("--set bottom.lambert_mu_db=3", {"bottom.lambert_mu", "1/sr", "within 0 and 1/pi"});
  refuse("--set wind.speed_m_s=-3", {"wind_speed = -3 m/s", "within 0 and 100"});
  refuse("--set surface.height_m=-5 --set bottom.height_m=0", {"bottom.height = 0 m", "must be below surface.height"});
  refuse("--set water.sound_speed_formula=medwin", {"medwin", "unesco, mackenzie, leroy"});
  refuse("--set wind.sped_m_s=3", {"wind.sped_m_s", "did you mean 'wind.speed_m_s'?"});
  refuse("--set weather.rain=1", {"unknown key 'weather.rain'"});
  refuse("--set profile.sound_speed=1500", {"profile.sound_speed", "set as a whole", "--profile"});
  refuse("--scan-noise -0.1", {"--scan-noise = -0.1 m", "must be 0 or more, and finite"});
  refuse("--scan-noise rough", {"--scan-noise", "rough", "metres"});
}

TEST_F(BadEnvironment, file_of_the_environment) {
  expect_refused("ping plane.ply" + here + " --environment nowhere.toml", 4, {"nowhere.toml"});
  refuse_file("[wind]\nspeed_m_s = 200\n", {"sea.toml", "wind_speed = 200 m/s", "within 0 and 100"});
  refuse_file("[wind\n", {"sea.toml:1"});
  refuse_file("[profile]\ndepth_m = [0, 1]\nsound_speed = [1500]\n", {"sea.toml", "profile"});
}

TEST_F(BadEnvironment, profile) {
  expect_refused("ping plane.ply" + here + " --profile nowhere.csv", 4, {"nowhere.csv"});
  refuse_profile("depth_m,sound_speed\n0,1500\n0,1490\n", {"ctd.csv:3", "depth_m = 0 m", "must be deeper"});
  refuse_profile("depth,speed\n0,1500\n", {"ctd.csv:1"});
}

TEST_F(BadEnvironment, multipath_without_a_boundary_or_out_of_the_water) {
  refuse("--multipath", {"--multipath", "neither surface nor bottom", "--set surface.height_m=0"});
  refuse("--multipath --set surface.height_m=1", {"surface", "1 m"});
  refuse("--multipath --set bottom.height_m=4", {"bottom", "4 m"});
  refuse("--set surface.height_m=1 --set surface.scattering_db=-30", {"surface", "1 m"});
}

TEST_F(BadEnvironment, way_of_the_head) {
  refuse("--velocity 1,2", {"--velocity = '1,2'", "has 2 numbers, must have 3", "vx,vy,vz in m/s"});
  refuse("--velocity 1,2,nan", {"--velocity", "'nan' is not a number"});
  refuse("--velocity 20,0,0", {"velocity", "20", "hundredth of the sound speed"});
  refuse("--turn-rate 0,0,x", {"--turn-rate", "'x' is not a number", "deg/s"});
  refuse("--turn-rate 0,0,9000", {"turn_rate", "100 rad/s"});
  refuse("--time inf", {"--time = inf s", "must be finite"});
  refuse("--time noon", {"--time", "noon"});
  expect_refused("ping plane.ply" + nowhere, 2, {"give either --pose or --trajectory"});

  write("way.csv", "time_s,x_m,y_m,z_m,yaw_deg,pitch_deg,roll_deg\n0,0,0,3,0,15,0\n10,1,0,3,0,15,0\n");
  refuse("--trajectory way.csv", {"give either --pose or --trajectory"});
  const auto refuse_trajectory = [&](const std::string& more, int code, const std::vector<std::string>& parts) {
    expect_refused("ping plane.ply" + nowhere + " " + more, code, parts);
  };
  refuse_trajectory("--trajectory way.csv --time 11", 2, {"time = 11 s", "0", "10"});
  refuse_trajectory("--trajectory way.csv --velocity 1,0,0", 2,
                    {"--velocity and --turn-rate follow from --trajectory"});
  refuse_trajectory("--trajectory way.csv --world ned", 2, {"--world ned", "z-up"});
  refuse_trajectory("--trajectory nowhere.csv", 4, {"nowhere.csv"});
  write("back.csv", "time_s,x_m,y_m,z_m,yaw_deg,pitch_deg,roll_deg\n5,0,0,3,0,15,0\n1,1,0,3,0,15,0\n");
  refuse_trajectory("--trajectory back.csv", 3, {"back.csv:3", "time_s = 1 s", "must be later"});
  write("one.csv", "time_s,x_m,y_m,z_m,yaw_deg,pitch_deg,roll_deg\n5,0,0,3,0,15,0\n");
  refuse_trajectory("--trajectory one.csv", 3, {"one.csv", "1 entries", "at least two"});
}

TEST_F(BadEnvironment, pulse_and_array) {
  refuse("--set sonar.pulse=linear_fm", {"pulse = linear_fm", "must come with pulse_length_s"});
  refuse("--set sonar.elevations_deg=0,95", {"elevations_deg", "within -90 and 90"});
  refuse("--set sonar.shading=hann", {"shading = \"hann\"", "must be one of taylor, uniform, hamming, chebyshev"});
}

TEST_F(BadEnvironment, numbers_and_words_of_options) {
  refuse("--absorption-order 3", {"--absorption-order", "3"});
  refuse("--absorption-order one", {"--absorption-order", "one"});
  refuse("--material-field colour", {"colour"}, 3);
  refuse("--layers=maybe", {"--layers"});
}
