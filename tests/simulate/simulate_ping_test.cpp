// SPDX-License-Identifier: BSD-3-Clause
#include "simulate/simulate_ping.hpp"

#include "returns/compare.hpp"
#include "scene/built_in_scenes.hpp"
#include "support/heads.hpp"
#include "support/simulate_event.hpp"
#include "support/test.hpp"

namespace insonify::simulate_ping_tests {

const SonarHead head = small_head({.max_range = 20});

SimulatedPing ping_harbour(const SimulationOptions& options, const Eigen::Vector3d& shift = Eigen::Vector3d::Zero()) {
  SceneCloud scene = make_built_in_scene("harbour", {.points = 30000});
  scene.origin += shift;
  const Water water;
  return simulate_ping(scene, head, pose_from_yaw_pitch_roll(Eigen::Vector3d(0, 0, -3) + shift, 0, radians(10), 0),
                       {water}, options);
}

/// Pings a flat bottom 3 m below a head at y, looking 15 degrees down.
SimulatedPing ping_plane(double y, const SimulationOptions& options) {
  const SceneCloud scene = make_built_in_scene("plane", {.points = 100000, .size = {30, 30}});
  const Water water;
  return simulate_ping(scene, head, pose_from_yaw_pitch_roll({0, y, 3}, 0, radians(15), 0), {water}, options);
}

ComplexGrid image(const SimulatedPing& p) { return p.ping.pressure.cast<std::complex<double>>(); }

TEST(SimulatePing, hears_the_harbour) {
  const SimulatedPing p = ping_harbour({.detection = {.false_alarm_rate = 1}});
  EXPECT_GT(p.report.sampling.visible, 1000U);
  EXPECT_GT(p.report.sampling.scatterers, p.report.sampling.visible);
  EXPECT_GT(p.soundings.size(), 1000U);
  EXPECT_TRUE(p.ping.pressure.isFinite().all());
  EXPECT_GT(p.ping.pressure.abs().maxCoeff(), 0);
}

// World and head moved together by whole metres: the same relative geometry to the last bit of double.
TEST(SimulatePing, does_not_change_when_world_and_head_move_together) {
  const SimulatedPing here = ping_harbour({}), far = ping_harbour({}, {1e6, -2e6, 300});
  EXPECT_EQ(here.report.sampling.scatterers, far.report.sampling.scatterers);
  EXPECT_LT(compare_images(image(far), image(here)).relative_l2, 1e-9);
}

TEST(SimulatePing, gridded_and_direct_agree_on_a_scene) {
  const SimulatedPing fast = ping_harbour(
      {.sampling = {.scatterers_per_cell = 0}, .synthesis = {.tolerance = 1e-6, .true_delays = Choice::never}});
  const SimulatedPing slow =
      ping_harbour({.sampling = {.scatterers_per_cell = 0}, .synthesis = {.method = SynthesisMethod::direct}});
  EXPECT_LT(compare_images(image(fast), image(slow)).relative_l2, 1e-6);
}

// A sounding lies on the tangent plane of the surface it came from: within half a bin and the pulse's length.
TEST(SimulatePing, returns_points_that_lie_on_the_scene) {
  const SceneCloud scene = make_built_in_scene("plane", {.points = 200000, .size = {30, 30}});
  const Water water;
  const SimulatedPing p = simulate_ping(scene, head, pose_from_yaw_pitch_roll({0, 0, 3}, 0, radians(15), 0), {water},
                                        {.detection = {.false_alarm_rate = 1}});
  ASSERT_GT(p.soundings.size(), 500U);
  std::vector<double> off;
  for (std::size_t i = 0; i < p.soundings.size(); ++i)
    if (p.soundings.true_surfel[i] != Soundings::none) off.push_back(std::abs(p.soundings.position[i].z()));
  ASSERT_GT(off.size(), 500U);
  std::nth_element(off.begin(), off.begin() + static_cast<std::ptrdiff_t>(off.size() / 2), off.end());
  EXPECT_LT(off[off.size() / 2], head.gate.bin_size);
  EXPECT_LT(*std::max_element(off.begin(), off.end()), 3 * head.gate.bin_size);
}

// Noise adds to the echoes and is what an empty sea holds: thermal level in the band less the array's directivity.
TEST(SimulatePing, adds_noise_of_the_right_level_on_request) {
  const SceneCloud scene = make_built_in_scene("plane", {.points = 1000, .size = {5, 5}});
  const Water water;
  const auto ping = [&](bool noise) {
    return simulate_ping(scene, head, pose_from_yaw_pitch_roll({0, 0, 100}, 0, radians(-90), 0), {water},
                         {.effects = {.noise = noise}});
  };
  const SimulatedPing p = ping(true);
  EXPECT_NEAR(mean_level_db(p.ping, 2, 20), p.report.noise_floor_db, 0.4);
  EXPECT_EQ(p.soundings.size(), 0U);
}

// Cells of open water that exceed the noise floor by -ln(rate): nobody knows that there is nothing. The floor is that
// of the mean beam, within some tenths of a decibel, which at 10^-4 change the rate by a fifth.
TEST(SimulatePing, of_open_water_gives_false_alarms_at_the_stated_rate) {
  const SceneCloud scene = make_built_in_scene("plane", {.points = 1000, .size = {5, 5}});
  const auto ping = [&](std::int64_t number, double above_db) {
    const Pose up = pose_from_yaw_pitch_roll({0, 0, 100}, 0, radians(-90), 0);
    return simulate_event(scene, head, {.world_from_head = up, .number = number}, {},
                          {.effects = {.noise = true}, .detection = {.all_bins = true, .above_db = above_db}});
  };
  const double floor_db = ping(0, 200).report.noise_floor_db;
  for (const double rate : {1e-2, 1e-3, 1e-4}) {
    const int pings = rate < 5e-4 ? 12 : 3;
    double found = 0, cells = 0;
    for (int number = 0; number < pings; ++number) {
      const SimulatedPing p = ping(number, floor_db + db_from_power(-std::log(rate)));
      found += static_cast<double>(p.soundings.size());
      cells += static_cast<double>(p.ping.pressure.size());
      for (const std::uint32_t surfel : p.soundings.true_surfel) EXPECT_EQ(surfel, Soundings::none);
    }
    const double expected = rate * cells;
    EXPECT_NEAR(found / expected, 1, 0.25 + 4 / std::sqrt(expected)) << rate << ": " << found << " of " << expected;
  }
}

TEST(SimulatePing, of_an_empty_view_is_silent_and_finite) {
  const SceneCloud scene = make_built_in_scene("plane", {.points = 1000, .size = {5, 5}});
  const Water water;
  const SimulatedPing p =
      simulate_ping(scene, head, pose_from_yaw_pitch_roll({0, 0, 100}, 0, radians(-90), 0), {water});
  EXPECT_EQ(p.report.sampling.scatterers, 0U);
  EXPECT_EQ(p.ping.pressure.abs().maxCoeff(), 0);
  EXPECT_EQ(p.soundings.size(), 0U);
}

// Same place, same seed: same speckle in every ping. A move of half an aperture sideways decorrelates it.
TEST(SimulatePing, locks_speckle_to_the_scene) {
  const ComplexGrid still = image(ping_plane(0, {}));
  EXPECT_EQ(compare_images(image(ping_plane(0, {})), still).relative_l2, 0);
  EXPECT_GT(compare_images(image(ping_plane(1e-5, {})), still).correlation, 0.999);  // a hundredth of a wavelength
  EXPECT_LT(compare_images(image(ping_plane(0.1, {})), still).correlation, 0.2);
}

}  // namespace insonify::simulate_ping_tests
