// SPDX-License-Identifier: BSD-3-Clause
#include "returns/detect_soundings.hpp"

#include "support/test.hpp"

namespace {

/// A fan of 5 beams, 10 degrees apart, 100 bins of 10 cm, and two scatterers: ahead at 3.05 m, 10 degrees to port
/// and 20 degrees down at 6.05 m.
struct Scene {
  Ping ping;
  Scatterers scatterers;
  Echoes echoes;

  Scene() {
    ping.number = 7;
    ping.fan = make_fan(5, radians(50), radians(10), radians(40));
    ping.gate = {0.5, 10.5, 0.1};
    ping.pressure = ComplexGridF::Zero(5, 100);
    add(3.05, 0, 0, 4);
    add(6.05, radians(10), radians(-20), 9);
    mark(2, 25, 100);
    mark(3, 55, 100);
  }
  void add(double range, double azimuth, double elevation, std::uint16_t material) {
    scatterers.range.push_back(range), scatterers.azimuth.push_back(azimuth), scatterers.elevation.push_back(elevation);
    scatterers.material.push_back(material), scatterers.id.push_back(std::uint64_t{range > 4 ? 61U : 30U} << 32 | 5),
        scatterers.surfel.push_back(0);
    scatterers.cos_incidence.push_back(1), scatterers.projected_area.push_back(1);
    echoes.delay.push_back(2 * range / 1500), echoes.u.push_back(std::cos(elevation) * std::sin(azimuth)),
        echoes.amplitude.emplace_back(1, 0);
  }
  /// Adds a pulse of three bins with its peak at `level` dB.
  void mark(int beam, int bin, double level) {
    const auto peak = static_cast<float>(std::sqrt(2) * 1e-6 * amplitude_from_db(level));
    ping.pressure(beam, bin) = peak;
    ping.pressure(beam, bin - 1) = ping.pressure(beam, bin + 1) = 0.3F * peak;
  }
  Soundings detect(DetectionOptions options = {.noise_floor_db = 40}) {
    return detect_soundings(ping, scatterers, echoes, options);
  }
};

}  // namespace

TEST(DetectSoundings, puts_one_point_on_each_target) {
  Scene scene;
  scene.ping.world_from_head = pose_from_yaw_pitch_roll({100, 0, -5}, radians(90), 0, 0);
  const Soundings s = scene.detect();
  ASSERT_EQ(s.size(), 2U);
  EXPECT_EQ(s.beam[0], 2U);
  EXPECT_EQ(s.bin[0], 25U);
  EXPECT_EQ(s.ping[0], 7U);
  EXPECT_EQ(s.true_material[0], 4U);
  EXPECT_NEAR(s.level_db[0], 100, 1e-3);
  EXPECT_LT((s.position[0] - Eigen::Vector3d(100, 3.05, -5)).norm(), 1e-9);  // head looks along +y
  EXPECT_EQ(s.beam[1], 3U);
  EXPECT_EQ(s.true_material[1], 9U);
  EXPECT_EQ(s.elevation[1], 0);  // which one row does not measure
  EXPECT_NEAR(s.true_elevation[1], radians(-20), 1e-6);
  EXPECT_EQ(s.true_surfel[1], 61U);
  const Eigen::Vector3d head = 6.05 * unit_vector({radians(10), radians(-20)});
  EXPECT_LT((s.position[1] - scene.ping.world_from_head * head).norm(), 1e-9);
}

TEST(DetectSoundings, stays_silent_below_the_noise_floor_and_its_threshold) {
  Scene scene;
  EXPECT_EQ(scene.detect({.noise_floor_db = 88}).size(), 2U);
  EXPECT_EQ(scene.detect({.noise_floor_db = 89}).size(), 0U);  // 100 < 89 + 11.4
}

TEST(DetectSoundings, rejects_side_lobes) {
  Scene scene;
  scene.mark(1, 25, 74);  // leakage at the range of the target in beam 2, 26 dB down
  scene.add(3.05, radians(-10), 0, 1);
  EXPECT_EQ(scene.detect().size(), 2U);
  EXPECT_EQ(scene.detect({.noise_floor_db = 40, .side_lobe_margin_db = 30}).size(), 3U);
}

// Side lobes of a wide band stand beside the range of their echo.
TEST(DetectSoundings, rejects_side_lobes_about_the_range_of_their_echo) {
  Scene scene;
  scene.mark(1, 28, 70);  // 0.3 m behind the target in beam 2, 30 dB down
  EXPECT_EQ(scene.detect().size(), 3U);
  EXPECT_EQ(scene.detect({.noise_floor_db = 40, .side_lobe_reach = 0.25}).size(), 3U);
  EXPECT_EQ(scene.detect({.noise_floor_db = 40, .side_lobe_reach = 0.35}).size(), 2U);
}

// Noise is detected as an echo is; the true columns say that nothing is there. Without any echoes the same is found.
TEST(DetectSoundings, are_decided_by_the_ping_alone) {
  Scene scene;
  scene.mark(0, 80, 100);  // no scatterer there
  const Soundings s = scene.detect();
  ASSERT_EQ(s.size(), 3U);
  EXPECT_EQ(s.bin[0], 80U);
  EXPECT_EQ(s.true_surfel[0], Soundings::none);
  EXPECT_EQ(s.true_material[0], Soundings::none);
  EXPECT_TRUE(std::isnan(s.true_elevation[0]));
  const Eigen::Vector3d on_axis = 8.55 * unit_vector({scene.ping.fan.azimuth[0], 0});
  EXPECT_LT((s.position[0] - scene.ping.world_from_head * on_axis).norm(), 1e-6);
  scene.scatterers = {}, scene.echoes = {};
  const Soundings blind = scene.detect();
  EXPECT_EQ(blind.bin, s.bin);
  EXPECT_EQ(blind.range, s.range);
  EXPECT_EQ(blind.level_db, s.level_db);
  EXPECT_EQ(blind.true_surfel, std::vector<std::uint32_t>(3, Soundings::none));
}

// Beams 10 degrees wide and 2 degrees apart: both receive both scatterers, but each reports its own.
TEST(DetectSoundings, lets_neighbouring_beams_name_their_own_scatterers) {
  Scene scene;
  scene.ping.fan = make_fan(5, radians(10), radians(10), radians(40));  // 2 degrees apart
  scene.ping.pressure.setZero();
  scene.mark(2, 25, 100);
  scene.mark(3, 25, 99);
  scene.add(3.05, scene.ping.fan.azimuth[3], 0, 6);  // next to the one ahead at the same range, and weaker
  scene.echoes.amplitude.back() = 0.5;
  const Soundings s = scene.detect();
  ASSERT_EQ(s.size(), 2U);
  EXPECT_EQ(s.true_material[0], 4U);
  EXPECT_EQ(s.true_material[1], 6U);
}

// A line array receives from cones: a beam steered up or down is at u = cos(elevation) sin(azimuth).
TEST(DetectSoundings, searches_along_the_cone_of_a_beam_below_the_horizon) {
  Scene scene;
  scene.ping.fan = make_fan(5, radians(50), radians(2), radians(40), radians(-30));
  scene.ping.pressure.setZero();
  scene.scatterers = {}, scene.echoes = {};
  scene.add(3.05, scene.ping.fan.azimuth[4], radians(-30), 5);
  scene.mark(4, 25, 100);
  EXPECT_EQ(scene.detect().true_material, std::vector<std::uint32_t>{5});
}

// Two rows of a planar array, 4 degrees apart, and a target in each at one range and bearing: each row reports its own.
TEST(DetectSoundings, of_a_planar_array_name_scatterers_of_their_own_row) {
  Scene scene;
  scene.ping.fan = {{0, 0}, {radians(-2), radians(2)}, radians(2), radians(40), radians(2)};
  scene.ping.pressure = ComplexGridF::Zero(2, 100);
  scene.scatterers = {}, scene.echoes = {};
  scene.add(3.05, 0, radians(-2.3), 5);
  scene.add(3.05, 0, radians(2.4), 6);
  scene.echoes.amplitude.back() = 3;
  scene.add(3.05, 0, radians(12), 7);  // far above both rows, and strongest
  scene.echoes.amplitude.back() = 100;
  scene.mark(0, 25, 100);
  scene.mark(1, 25, 101);
  const Soundings s = scene.detect();
  ASSERT_EQ(s.size(), 2U);
  EXPECT_EQ(s.true_material[0], 5U);
  EXPECT_EQ(s.true_material[1], 6U);
  EXPECT_NEAR(s.elevation[1], radians(2), 1e-6);
  EXPECT_NEAR(s.true_elevation[1], radians(2.4), 1e-6);
  EXPECT_LT((s.position[1] - 3.05 * unit_vector({0, radians(2.4)})).norm(), 1e-9);
}

TEST(DetectSoundings, of_all_bins_keeps_the_flanks_too) {
  Scene scene;
  EXPECT_EQ(scene.detect({.all_bins = true, .above_db = 80}).size(), 6U);
  EXPECT_EQ(scene.detect({.all_bins = true, .above_db = 95}).size(), 2U);
}

TEST(DetectSoundings, does_not_depend_on_threads) {
  Scene scene;
  for (const int threads : {1, 2, 7}) {
    const Soundings s = scene.detect({.noise_floor_db = 40, .threads = threads});
    ASSERT_EQ(s.size(), 2U);
    EXPECT_EQ(s.beam, (std::vector<std::uint32_t>{2, 3}));
  }
}

TEST(DetectSoundings, refuses_echoes_of_another_ping) {
  Scene scene;
  scene.echoes.delay.pop_back();
  EXPECT_THROW(scene.detect(), Error);
}

// A Gaussian as long as a bin (0.44 c / 2B) between two bins is sampled 3 dB low; the parabola gives it back. (E72)
TEST(DetectSoundings, find_peaks_between_bins) {
  for (const double offset : {-0.49, -0.3, 0.0, 0.2, 0.49}) {
    for (const double length : {1.0, 2.0}) {
      Scene scene;
      scene.ping.pressure.setZero();
      for (int bin = 20; bin <= 30; ++bin) {
        const double x = (bin - 25 - offset) / length;
        scene.ping.pressure(2, bin) = static_cast<float>(std::sqrt(2) * 0.1 * std::pow(2, -2 * x * x));
      }
      const Soundings s = scene.detect();
      ASSERT_EQ(s.size(), 1U);
      EXPECT_EQ(s.bin[0], 25U);
      EXPECT_NEAR(s.range[0], 3.05 + 0.1 * offset, 2e-5) << offset;
      EXPECT_NEAR(s.level_db[0], 100, 2e-3) << offset;
    }
  }
}

TEST(DetectSoundings, leave_the_bin_where_every_bin_is_asked_for_or_the_gate_ends) {
  Scene scene;
  scene.ping.pressure(2, 26) *= 2;
  const Soundings all = scene.detect({.all_bins = true, .above_db = 99});
  ASSERT_EQ(all.size(), 2U);
  EXPECT_FLOAT_EQ(all.range[0], 3.05F);
  scene.ping.gate.max_range = 3.1;
  scene.ping.pressure = ComplexGridF(scene.ping.pressure.leftCols(26));
  const Soundings last = scene.detect();
  ASSERT_EQ(last.size(), 1U);
  EXPECT_FLOAT_EQ(last.range[0], 3.05F);
  EXPECT_NEAR(last.level_db[0], 100, 1e-3);
}

// Beside a null the parabola adds no more than half a bin and 3 dB.
TEST(DetectSoundings, bound_the_peak_beside_a_null) {
  Scene scene;
  scene.ping.pressure(2, 24) = 0;
  scene.ping.pressure(2, 26) = scene.ping.pressure(2, 25);
  const Soundings s = scene.detect();
  EXPECT_NEAR(s.range[0], 3.10, 1e-5);
  EXPECT_NEAR(s.level_db[0], 103.01, 0.01);
}

// A pulse on a smooth background of 20 dB: found where it stands out by the factor, whatever its own flanks and those
// of a neighbour two cells away.
TEST(DetectSoundings, stand_out_of_their_surroundings) {
  const double factor_db = db_from_power(background_factor(1e-3, 32));
  for (const double above : {-0.1, 0.1}) {
    Scene scene;
    const auto smooth = static_cast<float>(std::sqrt(2) * 1e-6 * amplitude_from_db(60));
    scene.ping.pressure.setConstant(smooth);
    const double level = 60 + factor_db + above;
    scene.ping.pressure(2, 25) = static_cast<float>(std::sqrt(2) * 1e-6 * amplitude_from_db(level));
    scene.ping.pressure(2, 23) = scene.ping.pressure(2, 27) = 0.99F * scene.ping.pressure(2, 25);
    const Soundings s = scene.detect({.noise_floor_db = 0, .false_alarm_rate = 1e-3});
    EXPECT_EQ(std::count(s.bin.begin(), s.bin.end(), 25U), above > 0) << above;
  }
  EXPECT_THROW(Scene().detect({.false_alarm_rate = 0}), Error);
}

// Two maxima three bins apart: two soundings in cells of up to three bins, one in a cell of four.
TEST(DetectSoundings, are_one_per_resolution_cell) {
  Scene scene;
  scene.mark(2, 28, 99);
  scene.add(3.35, 0, 0, 4);
  EXPECT_EQ(scene.detect({.noise_floor_db = 40, .range_resolution = 0.3}).size(), 3U);
  EXPECT_EQ(scene.detect({.noise_floor_db = 40, .range_resolution = 0.4}).size(), 2U);
}
