// SPDX-License-Identifier: BSD-3-Clause
// Tests the options of water, surface, noise and motion: each does what it says, and a run can be fed back.
#include <nlohmann/json.hpp>

#include "acoustics/environment.hpp"
#include "returns/compare.hpp"
#include "store/cube.hpp"
#include "store/environment_file.hpp"
#include "store/sonar_file.hpp"
#include "support/test.hpp"
#include "tool/tool_runner.hpp"

using nlohmann::json;

namespace {

const std::string few_beams = " --sonar p900-45 --set sonar.beams=16 --range 2:12 --no-picture -q";
const std::string level_pose = " --pose=0,0,-3,0,10,0";

class EnvironmentRun : public ToolTest {
 protected:
  void SetUp() override {
    have("plain.ply", "make-scene wall --points 4000 --size 4,4");
    have("harbour.ply", "make-scene harbour --points 8000");
  }
  /// Relative L2 difference of two runs.
  double difference(const std::string& a, const std::string& b) const {
    const ComplexGrid x = ping_of(a).pressure.cast<std::complex<double>>(),
                      y = ping_of(b).pressure.cast<std::complex<double>>();
    return compare_images(x, y).relative_l2;
  }
  void over_harbour(const std::string& run, const std::string& more) const {
    succeed("ping harbour.ply -o " + run + few_beams + level_pose + more);
  }
};

std::vector<std::string> layer_names(const Ping& ping) {
  std::vector<std::string> names;
  for (const Layer& layer : ping.layers) names.push_back(layer.name);
  return names;
}

}  // namespace

// A sphere of 0.1 m, 5 m ahead of the head, and a smooth surface 2 m above both: the mixed path is half as long again as
// 4.9 m + sqrt(5^2 + 4^2) = 6.40 m, the twice bounced one 6.40 m. What comes directly stays as it is.
TEST_F(EnvironmentRun, multipath_adds_energy_behind_the_direct_echo_only) {
  have("ball.ply", "make-scene sphere --points 3000 --radius 0.1");
  const std::string look =
      "ping ball.ply --pose=0,0,0,0,0,0 --sonar p900-45 --set sonar.beams=16 --range 2:12 --no-picture -q "
      "--set sonar.elevation_width_deg=90 --set sonar.bin_size_m=0.0109 ";
  succeed(look + "--set water.depth_m=2 -o direct");
  succeed(look + "--multipath --set surface.height_m=2 --layers -o sea");
  const Ping direct = ping_of("direct"), sea = ping_of("sea");
  ASSERT_EQ(layer_names(sea), (std::vector<std::string>{"direct", "multipath"}));
  EXPECT_EQ((sea.layers[0].pressure - direct.pressure).abs().maxCoeff(), 0);
  Ping bounced = sea;
  bounced.pressure = sea.layers[1].pressure;
  const double beam_azimuth = mean_level_db(direct, 4.8, 5.2);
  EXPECT_GT(mean_level_db(bounced, 5.55, 5.85), beam_azimuth - 20);  // out one way, back the other
  EXPECT_GT(mean_level_db(bounced, 6.25, 6.55), beam_azimuth - 20);  // twice by the surface
  EXPECT_LT(mean_level_db(bounced, 2, 5.4), beam_azimuth - 80);
  EXPECT_LT(mean_level_db(bounced, 6.7, 12), beam_azimuth - 80);
}

TEST_F(EnvironmentRun, layers_in_the_cube_add_up_to_the_pressure) {
  over_harbour("out",
               " --noise --multipath --layers --set surface.height_m=0 --set surface.scattering_db=-30 "
               "--set volume.scattering_db=-60 --set bottom.height_m=-9 --set bottom.lambert_mu_db=-27");
  const Ping all = ping_of("out");
  EXPECT_EQ(layer_names(all),
            (std::vector<std::string>{"direct", "multipath", "volume", "surface", "bottom", "noise"}));
  ComplexGrid sum = ComplexGrid::Zero(all.pressure.rows(), all.pressure.cols());
  for (const Layer& layer : all.layers) {
    EXPECT_GT(layer.pressure.abs().maxCoeff(), 0) << layer.name;
    sum += layer.pressure.cast<std::complex<double>>();
  }
  EXPECT_LT(compare_images(all.pressure.cast<std::complex<double>>(), sum).relative_l2, 1e-6);
  EXPECT_EQ(json_of("info out")["layers"].size(), 6U);
  // Without --layers the same sum, and no layers.
  over_harbour("sum",
               " --noise --multipath --set surface.height_m=0 --set surface.scattering_db=-30 "
               "--set volume.scattering_db=-60 --set bottom.height_m=-9 --set bottom.lambert_mu_db=-27");
  EXPECT_TRUE(ping_of("sum").layers.empty());
  EXPECT_EQ((ping_of("sum").pressure - all.pressure).abs().maxCoeff(), 0);
}

TEST_F(EnvironmentRun, rough_sea_without_multipath_is_noted) {
  const ToolResult result =
      run("ping harbour.ply -o out --sonar p900-45 --set sonar.beams=16 --range 2:12 --no-picture" + level_pose +
          " --multipath --set surface.height_m=0 --set wind.speed_m_s=10");
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.err, HasSubstr("surface and bottom reflect no echo: waves of 0.56 m rms"));
  EXPECT_THAT(read("out/manifest.json"), HasSubstr("waves of 0.56 m rms"));
}

TEST_F(EnvironmentRun, wind_and_platform_raise_the_noise_by_the_closed_form) {
  const std::string away =
      "ping harbour.ply --pose=30,0,3,0,-90,0 --sonar micron --range 2:60 --no-picture -q --noise ";
  const auto level = [&](const std::string& more) {
    succeed(away + "--force -o out " + more);
    EXPECT_NEAR(mean_level_db(ping_of("out"), 2, 60), manifest_of("out")["sampling"]["noise_floor_db"].get<double>(),
                0.3);
    return manifest_of("out")["sampling"]["noise_floor_db"].get<double>();
  };
  const Pulse pulse = make_head(find_sonar("micron").spec, 1500).pulse;
  Environment still, windy, loud;
  windy.wind_speed = 30;
  loud.self_noise_db = 60;
  const double calm = level("");
  EXPECT_NEAR(level("--set wind.speed_m_s=30") - calm,
              element_noise_level_db(windy, pulse) - element_noise_level_db(still, pulse), 1e-9);
  EXPECT_NEAR(level("--set noise.self_db=60") - calm,
              element_noise_level_db(loud, pulse) - element_noise_level_db(still, pulse), 1e-9);
}

TEST_F(EnvironmentRun, trajectory_at_rest_gives_the_pressure_of_its_pose) {
  write("still.csv", "time_s,x_m,y_m,z_m,yaw_deg,pitch_deg,roll_deg\n0,0,0,-3,0,10,0\n10,0,0,-3,0,10,0\n");
  succeed("ping harbour.ply -o pose" + few_beams + level_pose);
  succeed("ping harbour.ply -o still --trajectory still.csv --time 0" + few_beams);
  EXPECT_EQ(read("still/cube.h5"), read("pose/cube.h5"));
  EXPECT_EQ(read("still/returns.pcd"), read("pose/returns.pcd"));
  // At another time only the time differs.
  succeed("ping harbour.ply -o late --trajectory still.csv --time 7.5" + few_beams);
  EXPECT_EQ(ping_of("late").time, 7.5);
  EXPECT_EQ((ping_of("late").pressure - ping_of("pose").pressure).abs().maxCoeff(), 0);
}

TEST_F(EnvironmentRun, noise_is_drawn_anew_for_each_time_and_number_of_a_ping) {
  write("still.csv", "time_s,x_m,y_m,z_m,yaw_deg,pitch_deg,roll_deg\n0,0,0,-3,0,10,0\n10,0,0,-3,0,10,0\n");
  const auto noisy = [&](const std::string& name, const std::string& options) {
    succeed("ping harbour.ply --noise --trajectory still.csv -o " + name + options + few_beams);
    return ping_of(name);
  };
  const Ping at_0 = noisy("at-0", " --time 0"), at_7 = noisy("at-7", " --time 7.5"),
             numbered = noisy("number", " --time 0 --ping 7500"), zero = noisy("zero", " --time 7.5 --ping 0");
  EXPECT_GT((at_7.pressure - at_0.pressure).abs().maxCoeff(), 0);
  EXPECT_EQ((numbered.pressure - at_7.pressure).abs().maxCoeff(), 0);
  EXPECT_EQ((zero.pressure - at_0.pressure).abs().maxCoeff(), 0);
  EXPECT_EQ(at_7.number, 7500);
}

// Two pings within a millisecond have one number, and with it one noise.
TEST_F(EnvironmentRun, time_between_two_milliseconds_has_a_note) {
  const auto notes = [&](const std::string& options) {
    succeed("ping harbour.ply --force -o timed" + options + few_beams + level_pose);
    return read_json("timed/manifest.json")["notes"].dump();
  };
  const auto shared = testing::HasSubstr("the ping has number 7500, its time in whole milliseconds");
  EXPECT_THAT(notes(" --time 7.5004"), shared);
  EXPECT_THAT(notes(" --time 7.5"), testing::Not(shared));
  EXPECT_THAT(notes(" --time 7.5004 --ping 7500"), testing::Not(shared));
}

TEST_F(EnvironmentRun, trajectory_is_the_pose_and_motion_between_its_entries) {
  write("way.csv", "time_s,x_m,y_m,z_m,yaw_deg,pitch_deg,roll_deg\n0,0,0,-3,0,10,0\n10,20,0,-3,40,10,0\n");
  write("straight.csv", "time_s,x_m,y_m,z_m,yaw_deg,pitch_deg,roll_deg\n0,-2,0,-3,0,10,0\n2,2,0,-3,0,10,0\n");
  succeed("ping harbour.ply -o moved --trajectory straight.csv --time 1" + few_beams);
  succeed("ping harbour.ply -o stated --velocity 2,0,0 --time 1" + few_beams + level_pose);
  EXPECT_LT(difference("moved", "stated"), 1e-6);
  EXPECT_EQ(manifest_of("moved")["motion"]["velocity_m_s"], json({2.0, 0.0, 0.0}));
  succeed("ping harbour.ply -o still --time 1" + few_beams + level_pose);
  EXPECT_FALSE(manifest_of("still").contains("motion"));
  EXPECT_GT(difference("moved", "still"), 0.1);
  succeed("ping harbour.ply -o turned --turn-rate 0,0,4 --time 1" + few_beams + level_pose);
  EXPECT_GT(difference("turned", "still"), 1e-4);
  succeed("ping harbour.ply -o way --trajectory way.csv --time 5" + few_beams);
  EXPECT_NEAR(ping_of("way").world_from_head(0, 3), 10, 1e-12);
  EXPECT_NEAR(manifest_of("way")["motion"]["turn_rate_deg_s"][2].get<double>(), 4, 0.3);
}

TEST_F(EnvironmentRun, profile_bends_rays_only_where_it_matters) {
  // The very speed of the plain water, at every depth.
  const std::string bins = " --set sonar.bin_size_m=0.0109";  // short enough for the slowest sound
  over_harbour("plain", bins);
  const double c = cube_of("plain").sound_speed;
  char line[200];
  std::snprintf(line, sizeof line, "depth_m,sound_speed\n0,%.17g\n20,%.17g\n", c, c);
  write("even.csv", line);
  over_harbour("even", bins + " --profile even.csv");
  EXPECT_LT(difference("even", "plain"), 1e-6);
  EXPECT_THAT(read("even/manifest.json"), HasSubstr("refraction is left out"));

  // A thermocline that has this speed at the head, 3 m deep.
  std::snprintf(line, sizeof line, "depth_m,sound_speed\n0,%.17g\n3,%.17g\n4,%.17g\n20,%.17g\n", c + 20, c, c - 20,
                c - 20);
  write("thermocline.csv", line);
  over_harbour("bent", bins + " --profile thermocline.csv --set surface.height_m=0 --without multipath");
  EXPECT_THAT(read("bent/manifest.json"), HasSubstr("the sound-speed profile bends rays"));
  EXPECT_GT(difference("bent", "plain"), 0.1);
}

TEST_F(EnvironmentRun, formulas_of_the_water_are_used) {
  const auto medium = [&](const std::string& more) {
    succeed("ping plain.ply --force -o out --pose=-5,0,0,0,0,0" + few_beams + more);
    return cube_of("out");
  };
  const Cube usual = medium(""), other = medium(" --set water.sound_speed_formula=mackenzie"),
             third = medium(" --set water.absorption_formula=fisher-simmons");
  EXPECT_NE(other.sound_speed, usual.sound_speed);
  EXPECT_NEAR(other.sound_speed, usual.sound_speed, 1);
  EXPECT_EQ(third.sound_speed, usual.sound_speed);
  EXPECT_NEAR(third.absorption_db_per_m / usual.absorption_db_per_m, 1, 0.2);
  EXPECT_NE(third.absorption_db_per_m, usual.absorption_db_per_m);
}

TEST_F(EnvironmentRun, environment_file_means_the_same_as_set) {
  write("sea.toml",
        "[water]\ntemperature_c = 4\n[surface]\nheight_m = 0.5\nscattering_db = -35\n[wind]\nspeed_m_s = 6\n"
        "[volume]\nscattering_db = -65\n[noise]\nself_db = 40\n[bottom]\nheight_m = -9\n");
  over_harbour("file", " --noise --environment sea.toml");
  over_harbour("set",
               " --noise --set water.temperature_c=4 --set surface.height_m=0.5 --set surface.scattering_db=-35 --set "
               "wind.speed_m_s=6 --set volume.scattering_db=-65 --set noise.self_db=40 --set bottom.height_m=-9");
  EXPECT_EQ(read("file/cube.h5"), read("set/cube.h5"));
  over_harbour("over", " --noise --environment sea.toml --set wind.speed_m_s=20");  // --set has the last word
  EXPECT_THAT(read("over/run.toml"), HasSubstr("speed_m_s = 20.0"));
}

TEST_F(EnvironmentRun, run_toml_gives_back_sonar_and_environment) {
  write("ctd.csv", "depth_m,sound_speed\n0,1520\n4,1490.123456789\n20,1489\n");
  const std::string sea =
      " --noise --multipath --profile ctd.csv --set water.temperature_c=4 --set surface.height_m=0 "
      "--set surface.rms_height_m=0.0001 --set volume.scattering_db=-65 --set noise.self_db=40 "
      "--set bottom.height_m=-9 --set bottom.loss=0.02";
  succeed("ping harbour.ply -o first --set sonar.pulse=linear_fm --set sonar.pulse_length_s=0.0002" + few_beams +
          level_pose + sea);
  succeed(
      "ping harbour.ply -o again --noise --multipath --sonar first/run.toml --environment first/run.toml "
      "--no-picture -q" +
      level_pose);
  EXPECT_EQ(read("again/cube.h5"), read("first/cube.h5"));
  EXPECT_THAT(read("first/run.toml"), HasSubstr("pulse = \"linear_fm\""));
}

// A point 10 m ahead, a sweep of BT = 295: side lobes of -13.3 dB without a window, -42.7 dB with Hamming's. (Ripples of
// the sweep's own spectrum set a floor of some -20 log10(BT) - 3 dB, here -52 dB: a rule
// recalled from the literature of pulse compression; -31.9 dB were seen for BT = 29.5.)
TEST_F(EnvironmentRun, linear_fm_pulse_has_the_peak_of_the_burst_and_side_lobes) {
  write("one.csv", "range_m,azimuth_rad,elevation_rad,sigma_m2,xi_re,xi_im\n10,0,0,1,1,0\n");
  const std::string base =
      "synthesize one.csv --sonar p900-45 --set sonar.beams=1 --range 9:11 --set sonar.bin_size_m=0.001 --no-picture "
      "-q ";
  succeed(base + "-o burst");
  succeed(base + "-o sweep --set sonar.pulse=linear_fm --set sonar.pulse_length_s=0.01");
  succeed(base +
          "-o bare --set sonar.pulse=linear_fm --set sonar.pulse_length_s=0.01 --set sonar.replica_window=uniform");
  const auto highest_beyond = [&](const std::string& run, double gap) {
    const Ping p = ping_of(run);
    const Grid<float> level = level_db(p);
    double far = -1000;
    for (std::size_t n = 0; n < p.gate.bins(); ++n)
      if (std::abs(p.gate.centre(n) - 10) > gap) far = std::max(far, double(level(0, static_cast<int>(n))));
    return far - level.maxCoeff();
  };
  EXPECT_NEAR(level_db(ping_of("sweep")).maxCoeff(), level_db(ping_of("burst")).maxCoeff(), 0.3);
  EXPECT_LT(highest_beyond("burst", 0.08), -80);
  EXPECT_NEAR(highest_beyond("bare", 0.03), -13.3, 1.0);
  EXPECT_LT(highest_beyond("sweep", 0.06), -40);
}
