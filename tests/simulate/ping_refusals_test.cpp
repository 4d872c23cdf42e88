// SPDX-License-Identifier: BSD-3-Clause
// Tests levels at the limits of numbers, values in units other than SI, and refusals of a ping.
#include "acoustics/sound_speed_profile.hpp"
#include "support/checked_ping.hpp"
#include "support/point_targets.hpp"

namespace insonify::ping_refusals {

SonarSpec loud_sonar(double source_level_db) {
  SonarSpec s = nine_beams();
  s.source_level_db = source_level_db;
  return s;
}

// A ping refuses whatever its scene, its materials or its water refuse.
TEST(PingRefusals, of_scenes_and_water_that_cannot_be) {
  const auto refused = [](auto&& damage, const std::vector<std::string>& parts) {
    SceneCloud scene = plate(5, 2, 3);
    damage(scene);
    expect_error(ErrorKind::content, parts, [&] { ping_of(scene); });
  };
  const float nan = std::numeric_limits<float>::quiet_NaN();
  refused([&](SceneCloud& s) { s.point[4].x() = nan; }, {"scene.point[4]", "nan", "must be finite"});
  refused([&](SceneCloud& s) { s.normal[3].setZero(); }, {"scene.normal[3]", "(0, 0, 0)", "must be a unit vector"});
  refused([&](SceneCloud& s) { s.area[8] = nan; }, {"scene.area[8] = nan m^2", "finite"});
  refused([](SceneCloud& s) { s.materials = {{"odd", -0.1}}; }, {"lambert_mu", "'odd'", ">= 0"});
  expect_error(ErrorKind::argument, {"depth = -5 m"}, [] {
    ping_of(plate(5, 1, 3), {}, nine_beams(), {10, 35, -5, 8});
  });
}

TEST(PingRefusals, of_bandwidth_of_twice_the_centre_frequency) {
  SonarSpec s = nine_beams();
  s.bandwidth = 900e3;
  expect_error(ErrorKind::argument, {"bandwidth_hz = 900000 Hz", "below twice centre_frequency_hz"},
               [&] { make_head(s, 1500); });
  SonarHead head = nine_beam_head();
  head.pulse.bandwidth = 900e3;
  expect_error(ErrorKind::argument, {"PingSimulator", "bandwidth = 900000 Hz", "below twice the centre frequency"},
               [&] { simulate_ping(plate(5, 1, 3), head, Pose::Identity(), {}); });
}

TEST(PingRefusals, of_head_that_is_not_valid_named_by_the_call_that_got_it) {
  const auto refused = [](auto&& damage, const std::vector<std::string>& parts) {
    SonarHead head = nine_beam_head();
    damage(head);
    expect_error(ErrorKind::argument, parts, [&] { simulate_ping(plate(5, 1, 3), head, Pose::Identity(), {}); });
  };
  refused([](SonarHead& h) { h.pulse.bandwidth = 0; }, {"PingSimulator", "bandwidth = 0 Hz"});
  refused([](SonarHead& h) { h.pulse.centre_frequency = -1; }, {"PingSimulator", "centre_frequency = -1 Hz"});
  refused([](SonarHead& h) { h.array.shading.clear(); }, {"PingSimulator", "no elements"});
  refused([](SonarHead& h) { h.gate.min_range = 0; }, {"PingSimulator", "min_range = 0 m"});
  refused([](SonarHead& h) { h.gate.bin_size = not_a_number; }, {"PingSimulator", "bin_size = nan m"});
}

TEST(PingLevels, scale_with_the_source_level_and_stay_finite) {
  const SceneCloud scene = plate(5, 2, 10);
  const double reference = pressure_level_db(image(ping_of(scene)).abs().maxCoeff());
  for (const double level : {-400.0, -50.0, 0.0, 260.0}) {
    const SimulatedPing p = ping_of(scene, {}, loud_sonar(level));
    EXPECT_TRUE(all_finite(p)) << level;
    EXPECT_NEAR(pressure_level_db(image(p).abs().maxCoeff()) - reference, level - 220, 1e-3) << level;
  }
  for (const double level : {260.5, 400.0, -500.0, infinity, not_a_number})
    expect_error(ErrorKind::argument, {"source_level_db", "dB", "within -400 and 260"},
                 [&] { make_head(loud_sonar(level), 1500); });
}

// complex<float> ends at 3.4e38: what does not fit is refused, not stored as inf.
TEST(PingRefusals, of_pressure_beyond_single_precision) {
  SonarHead head = nine_beam_head();
  for (const double level : {900.0, 3000.0, 7000.0}) {
    head.pulse.source_level_db = level;
    expect_error(ErrorKind::argument, {"source_level_db"},
                 [&] { simulate_ping(plate(5, 1, 3), head, Pose::Identity(), {}); });
  }
  head.pulse.source_level_db = 260;
  SceneCloud scene = plate(5, 1, 3);
  for (float& area : scene.area) area = 3e38F;
  scene.materials[0].lambert_mu = 1e30;
  expect_error(ErrorKind::content, {"PingSimulator", "Pa", "single precision"},
               [&] { simulate_ping(scene, head, Pose::Identity(), {}, {.sampling = {.scatterers_per_cell = 0}}); });
}

TEST(PingLevels, of_silence_are_the_floor) {
  const SimulatedPing p = ping_of(SceneCloud{});
  EXPECT_TRUE((level_db(p.ping) == -200).all());
  EXPECT_TRUE((level_db(p.ping, -300) == -300).all());
  EXPECT_TRUE((range_compensated_level_db(p.ping, 0.3) == -200).all());
  EXPECT_EQ(mean_level_db(p.ping, 2, 3), -infinity);
  EXPECT_EQ(mean_level_db(p.ping, 200, 300), -infinity);
}

TEST(PingLevels, of_other_surfels_do_not_change_beside_a_silent_material) {
  SceneCloud scene = plate(5, 2, 12);
  scene.materials = {{"sand", 0.002}, {"silent", 0}};
  for (std::size_t i = 0; i < scene.size(); i += 2) scene.material[i] = 1;
  std::vector<std::uint32_t> loud;
  for (std::uint32_t i = 1; i < scene.size(); i += 2) loud.push_back(i);
  const ComplexGrid with = image(ping_of(scene)), without = image(ping_of(subset(scene, loud)));
  EXPECT_GT(without.abs().maxCoeff(), 0);
  EXPECT_LT(relative_l2(with, without), 1e-12);
}

// Kilohertz for hertz, kilometres a second for metres, degrees for radians: refused, naming value, unit and rule.
TEST(PingRefusals, of_values_in_other_units_with_the_unit_wanted) {
  SonarSpec kilohertz = nine_beams();
  kilohertz.centre_frequency /= 1000;
  expect_error(ErrorKind::argument, {"bandwidth_hz", "20000 Hz"}, [&] { make_head(kilohertz, 1500); });
  kilohertz.bandwidth /= 1000;
  expect_error(ErrorKind::argument, {"bandwidth_hz = 20 Hz"}, [&] { make_head(kilohertz, 1500); });
  BeamFan degrees_fan = make_fan(3, radians(40), radians(4), radians(20));
  for (double& azimuth : degrees_fan.azimuth) azimuth = degrees(azimuth);
  expect_error(ErrorKind::argument, {"azimuth[0]", "rad"}, [&] { require_valid(degrees_fan, "test"); });
  expect_error(ErrorKind::argument, {"1.5 m/s", "1300"}, [] { require_valid(SoundSpeedProfile{{0}, {1.5}}, "test"); });
  EXPECT_FALSE(validity_notes({.depth = 20000}, 900e3).empty());  // metres, typed for a depth of 20 km
}

TEST(PingRefusals, of_image_that_no_memory_holds_with_its_size) {
  SonarSpec s = nine_beams();
  s.beams = 65536;
  s.bin_size = 1e-5;
  expect_error(ErrorKind::argument, {"65536 beams x 1100000 bins", "GiB", "2^28"}, [&] { make_head(s, 1500); });
  s.bin_size = 1e-9;
  expect_error(ErrorKind::argument, {"bin_size = 1e-09 m", "more than 2^24 bins"}, [&] { make_head(s, 1500); });
  s.beams = 65537;
  expect_error(ErrorKind::argument, {"beams = 65537", "within 1 and 65536"}, [&] { make_head(s, 1500); });
  SonarHead head = nine_beam_head();
  head.fan = make_fan(40000, 1, 0.1, 0.1);
  head.array = {head.array.spacing, uniform_shading(16384)};
  expect_error(ErrorKind::argument, {"40000 beams x 16384 elements", "GiB", "2^28"},
               [&] { simulate_ping(plate(5, 1, 3), head, Pose::Identity(), {}); });
}

TEST(PingRefusals, of_more_scatterers_than_memory_holds_with_their_number) {
  // 90 000 surfels in 4096 parts each.
  expect_error(ErrorKind::argument, {"90000 surfels", "368640000 scatterers", "2^28", "scatterers_per_cell"},
               [] { ping_of(plate(8, 4, 300), {.sampling = {.scatterers_per_cell = 1e12, .occlusion = false}}); });
}

}  // namespace insonify::ping_refusals
