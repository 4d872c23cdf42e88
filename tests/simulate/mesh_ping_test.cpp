// SPDX-License-Identifier: BSD-3-Clause
// Compares levels of a big mesh under a narrow swath, sampled for the ping, with a fine cloud and a closed form.
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/units.hpp"
#include "sampling/mesh_surfels.hpp"
#include "scene/built_in_scenes.hpp"
#include "simulate/resolve_ping.hpp"
#include "simulate/simulate_ping.hpp"
#include "support/heads.hpp"
#include "support/scenes.hpp"

namespace insonify::mesh_ping_tests {

constexpr double height = 20;

/// 512 beams over 110 degrees, 1 degree x 1 degree, looking straight down from 20 m.
const SonarHead head = small_head({.beams = 512,
                                   .field_of_view_deg = 110,
                                   .beam_width_deg = 1,
                                   .elevation_width_deg = 1,
                                   .min_range = 18,
                                   .max_range = 42});
const Pose pose = pose_from_yaw_pitch_roll({0, 0, height}, 0, radians(90), 0);

const SceneMesh& bed() {
  static const SceneMesh mesh = [] {
    SceneMesh m;
    m.point = {{-200, -200, 0}, {200, -200, 0}, {200, 200, 0}, {-200, 200, 0}};
    m.triangle = {{0, 1, 2}, {0, 2, 3}};
    m.material.assign(4, 0);
    m.whole = {200000, std::sqrt(0.8), 0};
    return m;
  }();
  return mesh;
}

/// Samples the sector alone; stages left open would widen it.
MeshSurfels surfels_for(SimulationOptions options = {}) {
  options.sampling.outer_elevations = options.sampling.outer_azimuths = Choice::never;
  const ResolvedPing resolved = resolve_ping(bed().whole, head, {pose}, {}, options);
  return mesh_surfels(bed(), resolved.region, resolved.head.fan, resolved.view.sampling);
}

SimulatedPing swath_ping(const SceneCloud& scene, SimulationOptions options = {}) {
  options.synthesis.method = SynthesisMethod::incoherent;
  return simulate_ping(scene, head, pose, {}, options);
}

/// Returns the energy of each beam over all bins [dB].
Eigen::ArrayXd beam_levels_db(const Ping& p) {
  return 10 * p.pressure.cast<std::complex<double>>().abs2().rowwise().sum().log10();
}

// Over three samplings; of one, the worst of 512 beams is 0.3 dB off.
TEST(MeshPing, has_the_level_of_a_fine_cloud_in_every_beam) {
  SceneCloud strip;
  add_rectangle(strip, {-1.2, -38, 0}, {2.4, 0, 0}, {0, 76, 0}, {0, 0, 1}, 0.02, 0.5);
  const Eigen::ArrayXd fine = beam_levels_db(swath_ping(strip, {.sampling = {.scatterers_per_cell = 0}}).ping);
  Eigen::ArrayXd mean = Eigen::ArrayXd::Zero(512);
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const MeshSurfels mesh = surfels_for({.seed = seed});
    EXPECT_EQ(mesh.coarsening, 1);
    EXPECT_LT(mesh.scene.size(), 30000U);
    const SimulatedPing sampled = swath_ping(mesh.scene, {.seed = seed});
    EXPECT_EQ(sampled.report.sampling.sparse_beams, 0U);
    EXPECT_TRUE(sampled.report.notes.empty());
    const Eigen::ArrayXd error = beam_levels_db(sampled.ping) - fine;
    EXPECT_LT(error.abs().maxCoeff(), 0.5);
    mean += error / 3;
  }
  EXPECT_LT(mean.abs().maxCoeff(), 0.2);
  EXPECT_LT(std::abs(mean.mean()), 0.02);
}

// An even sampling of the whole mesh gives too few surfels in every beam, and a note.
TEST(MeshPing, of_an_even_sampling_is_noted) {
  SceneCloud scene = make_built_in_scene("plane", {.points = 200000, .size = {400, 400}});
  scene.origin.x() -= 200;
  const SimulatedPing coarse = swath_ping(scene);
  EXPECT_GT(coarse.report.sampling.sparse_beams, 500U);
  ASSERT_EQ(coarse.report.notes.size(), 1U);
  EXPECT_EQ(coarse.report.notes[0].kind, "sparse beams");
  EXPECT_THAT(coarse.report.notes[0].text, HasSubstr("of 512 beams: their main lobes hold fewer than four surfels"));
}

TEST(MeshPing, does_not_depend_on_threads) {
  const SceneCloud scene = surfels_for().scene;
  const SimulatedPing one = swath_ping(scene, {.threads = 1}),
                      three = swath_ping(surfels_for({.threads = 3}).scene, {.threads = 3});
  EXPECT_TRUE((one.ping.pressure == three.ping.pressure).all());
}

// With speckle, over seeds: amplitudes are bound to ids.
TEST(MeshPing, keeps_its_speckle_when_the_head_does_not_move) {
  const SceneCloud scene = surfels_for().scene;
  const SimulatedPing a = simulate_ping(scene, head, pose, {}), b = simulate_ping(surfels_for().scene, head, pose, {});
  EXPECT_TRUE((a.ping.pressure == b.ping.pressure).all());
}

}  // namespace insonify::mesh_ping_tests
