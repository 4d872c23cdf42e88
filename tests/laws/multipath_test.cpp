// SPDX-License-Identifier: BSD-3-Clause
// Echoes by way of surface and bottom: images of one target in the layers of a ping.
#include "acoustics/reflection.hpp"
#include "simulate/simulate_ping.hpp"
#include "speckle_bench.hpp"
#include "support/test.hpp"

using namespace insonify::laws;

namespace {

/// Pings one patch 20 m away and 3 m deep, received at 2 m depth in water 10 m deep at 1500 m/s.
SimulatedPing ping_of_one_patch(const Environment& environment) {
  SceneCloud scene;
  scene.materials = {{"patch", 0.1}};
  add_surfel(scene, {20, 0, -3}, {-1, 0, 0}, 1e-4);
  SonarHead head = head_with({wavelength / 2, {1.0}}, {0}, 29.5e3, {19, 26, 0.005});
  head.fan.elevation_width = pi;
  head.elevation_shape = ElevationShape::sector;
  SimulationOptions options;
  options.amplitude = SurfaceAmplitude::coherent;
  options.sampling.scatterers_per_cell = 0;
  options.outputs.layers = true;
  options.effects.multipath = Choice::always;
  Pose pose = Pose::Identity();
  pose.translation() = Eigen::Vector3d(0, 0, -2);
  return simulate_ping(scene, head, pose, environment, options);
}

/// Peak within 0.1 m of `range` by the parabola through three levels [dB], and its position [m].
struct Arrival {
  double range, level_db;
};
Arrival arrival_near(const ComplexGridF& pressure, const SimulatedPing& p, double range) {
  const auto first = static_cast<Eigen::Index>((range - 0.1 - p.ping.gate.min_range) / p.ping.gate.bin_size);
  Eigen::Index n;
  pressure.row(0).segment(first, 40).abs().maxCoeff(&n);
  n += first;
  const auto db = [&](Eigen::Index k) { return pressure_level_db(std::abs(Complex(pressure(0, k)))); };
  const double l = db(n - 1), m = db(n), h = db(n + 1), at = 0.5 * (l - h) / (l - 2 * m + h);
  const double position = p.ping.gate.centre(static_cast<std::size_t>(n)) + at * p.ping.gate.bin_size;
  return {position, m - 0.25 * (l - h) * at};
}

Environment shallow_water() {
  Environment e;
  e.profile = SoundSpeedProfile{{0, 100}, {speed, speed}};
  e.surface = SeaSurface{};
  e.bottom = FlatBottom{-10};
  return e;
}

}  // namespace

// R_s = hypot(20, 2 + 3), R_b = hypot(20, 2 x 10 - 2 - 3); apparent range (R1 + R2) / 2. Levels re the direct echo with
// the two senses of a mixed path adding up and 0.29946 dB/m of absorption, before reflections; the patch's cosines and
// the reflections are taken off.
TEST(MultipathLaws, images_of_one_patch_stand_at_their_ranges_with_their_levels) {
  const Environment environment = shallow_water();
  const SimulatedPing p = ping_of_one_patch(environment);
  ASSERT_EQ(p.ping.layers.size(), 2u);
  ASSERT_EQ(p.ping.layers[1].name, "multipath");
  const double r_d = std::hypot(20, 1), r_s = std::hypot(20, 5), r_b = std::hypot(20, 15);
  const Arrival direct = arrival_near(p.ping.layers[0].pressure, p, r_d);
  EXPECT_NEAR(direct.range, 20.0250, 1e-4);
  const double bounce = std::abs(bottom_reflection(*environment.bottom, std::asin(15 / r_b)));
  const struct {
    double out, back, apparent, delay_us, level_db, reflections;
  } paths[] = {{r_d, r_s, 20.3203, 393.7, 5.59, 1},
               {r_s, r_s, 20.6155, 787.4, -0.86, 1},
               {r_d, r_b, 22.5125, 3316.7, 2.60, bounce},
               {r_b, r_b, 25.0, 6633.4, -6.83, bounce * bounce}};
  for (const auto& path : paths) {
    const Arrival a = arrival_near(p.ping.layers[1].pressure, p, path.apparent);
    EXPECT_NEAR(a.range, path.apparent, 3e-4);
    EXPECT_NEAR((a.range - direct.range) * 2 / speed * 1e6, path.delay_us, 0.5);
    const double cosines = std::sqrt((20 / path.out) * (20 / path.back)) / (20 / r_d);
    EXPECT_NEAR(a.level_db - direct.level_db - db_from_amplitude(path.reflections * cosines), path.level_db, 0.02)
        << path.apparent << " m";
  }
}

// A surface of rms height h attenuates every bounce by exp(-2 (k h sin g)^2), and the direct echo not at all.
TEST(MultipathLaws, rough_surface_applies_eckarts_loss_to_every_bounce) {
  Environment environment = shallow_water();
  environment.bottom.reset();
  environment.surface->rms_height = 0;
  const SimulatedPing smooth = ping_of_one_patch(environment);
  environment.surface->rms_height = 4e-4;
  const SimulatedPing rough = ping_of_one_patch(environment);
  const double grazing = std::asin(5 / std::hypot(20, 5)), k = 2 * pi / wavelength;
  const double loss = db_from_amplitude(std::exp(-2 * std::pow(k * 4e-4 * std::sin(grazing), 2)));
  EXPECT_LT(loss, -1);
  for (const auto& [range, bounces] : {std::pair(20.3203, 1), std::pair(20.6155, 2)}) {
    const double change = arrival_near(rough.ping.layers[1].pressure, rough, range).level_db -
                          arrival_near(smooth.ping.layers[1].pressure, smooth, range).level_db;
    EXPECT_NEAR(change, bounces * loss, 0.01) << range;
  }
  EXPECT_TRUE((rough.ping.layers[0].pressure == smooth.ping.layers[0].pressure).all());
}
