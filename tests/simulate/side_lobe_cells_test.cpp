// SPDX-License-Identifier: BSD-3-Clause
// Tests the wider cells of surfaces that only side lobes receive (E17): level and speckle stay.
#include "scene/built_in_scenes.hpp"
#include "simulate/resolve_ping.hpp"
#include "simulate/simulate_ping.hpp"
#include "support/heads.hpp"
#include "support/test.hpp"

namespace insonify::side_lobe_cells_tests {

const SonarHead one_beam = small_head({.beams = 1, .field_of_view_deg = 2, .elevation_width_deg = 40, .max_range = 12});
const Pose pose = pose_from_yaw_pitch_roll({-6, 0, 3}, 0, radians(15), 0);
constexpr int seeds = 40;

/// Returns a plane without its main lobe: nothing within `off` of u = 0.
SceneCloud shadowed_plane(double off) {
  const SceneCloud whole = make_built_in_scene("plane", {.points = 5000, .size = {24, 24}});
  const Pose to_head = pose.inverse();
  std::vector<std::uint32_t> beside;
  for (std::uint32_t i = 0; i < whole.size(); ++i) {
    const Eigen::Vector3d p = to_head * (whole.origin + whole.point[i].cast<double>());
    if (std::abs(p.y()) > off * p.norm()) beside.push_back(i);
  }
  return subset(whole, beside);
}

/// Returns the intensities of a ping, one beam, in bins of the plane.
Eigen::ArrayXd intensities(const SceneCloud& scene, std::uint64_t seed, double per_cell, SynthesisMethod method,
                           std::size_t* scatterers = nullptr) {
  SimulationOptions options{
      .seed = seed, .sampling = {.scatterers_per_cell = per_cell}, .synthesis = {.method = method}};
  options.sampling.outer_azimuths = Choice::always;
  options.synthesis.true_delays = Choice::never;
  const SimulatedPing p = simulate_ping(scene, one_beam, pose, {}, options);
  if (scatterers) *scatterers = p.report.sampling.scatterers;
  const auto begin = static_cast<Eigen::Index>((7 - one_beam.gate.min_range) / one_beam.gate.bin_size);
  const Eigen::ArrayXd all = p.ping.pressure.row(0).cast<std::complex<double>>().abs2();
  return all.segment(begin, all.size() - begin);
}

TEST(SideLobeCells, hold_enough_scatterers_for_the_expected_level) {
  for (const double off : {0.06, 0.2, 0.3}) {
    SCOPED_TRACE(off);
    const SceneCloud plane = shadowed_plane(off);
    const Eigen::ArrayXd exact = intensities(plane, 100, 300, SynthesisMethod::incoherent);
    double squares = 0, mean = 0;
    std::size_t scatterers = 0;
    for (int seed = 1; seed <= 4; ++seed) {
      const Eigen::ArrayXd error =
          intensities(plane, static_cast<std::uint64_t>(seed), 10, SynthesisMethod::incoherent, &scatterers) / exact -
          1;
      squares += error.square().mean() / 4, mean += error.mean() / 4;
    }
    EXPECT_LT(squares, 0.04);  // as in a main lobe; ten independent points have 0.1
    EXPECT_NEAR(mean, 0, 0.02);
    EXPECT_LT(scatterers, 60000U);
  }
}

TEST(SideLobeCells, have_the_speckle_of_many_scatterers) {
  const SceneCloud plane = shadowed_plane(0.3);
  const Eigen::ArrayXd expected = intensities(plane, 100, 300, SynthesisMethod::incoherent);
  double mean = 0, squares = 0;
  for (int seed = 1; seed <= seeds; ++seed) {
    const Eigen::ArrayXd looks =
        intensities(plane, static_cast<std::uint64_t>(seed), 10, SynthesisMethod::gridded) / expected;
    mean += looks.mean() / seeds, squares += looks.square().mean() / seeds;
  }
  EXPECT_NEAR(mean, 1, 0.06);
  EXPECT_NEAR(squares / (mean * mean), 2, 0.2);  // <I^2> of an exponential distribution
}

// Refracted rays come from other directions, a turning head receives elsewhere, a sparse array has further lobes: whether
// the stages that say so are in or out. Bounces have scatterers of their own.
TEST(SideLobeCells, are_those_of_main_lobes_where_echoes_may_be_as_loud) {
  const auto margin_of = [](const SonarHead& head, const SimulationOptions& options, const Environment& environment,
                            const Motion& motion = {}) {
    return resolve_ping(WholeScene{}, head, {.motion = motion}, environment, options).view.sampling.lobe_margin;
  };
  Environment sea;
  sea.surface = SeaSurface{3, 1e-4, -35};
  EXPECT_EQ(margin_of(one_beam, {}, sea), 0);
  EXPECT_EQ(margin_of(one_beam, {.effects = {.multipath = Choice::always}}, sea), 0);
  sea.profile = SoundSpeedProfile{{0, 20, 40}, {1500, 1500, 1490}};
  const double turn = 10.0 / 20 / 1490 * one_beam.gate.max_range;
  for (const Choice refraction : {Choice::never, Choice::as_needed, Choice::always})
    EXPECT_NEAR(margin_of(one_beam, {.effects = {.refraction = refraction}}, sea), turn, 0.01 * turn);
  sea.profile = SoundSpeedProfile{{0, 40}, {1500, 1500}};
  EXPECT_EQ(margin_of(one_beam, {.effects = {.refraction = Choice::always}}, sea), 0);
  SonarHead sparse = one_beam;
  sparse.array.spacing *= 2.1;
  EXPECT_EQ(margin_of(sparse, {}, sea), 2);
  const Motion turning{.turn_rate = {0, 0, 0.5}};
  const double turned = margin_of(one_beam, {.effects = {.moving = Choice::always}}, sea, turning);
  EXPECT_EQ(margin_of(one_beam, {.effects = {.moving = Choice::never}}, sea, turning), turned);
  EXPECT_GE(turned, 0.5 * 2 * one_beam.gate.max_range / 1500);
  EXPECT_LT(turned, 0.02);
}

}  // namespace insonify::side_lobe_cells_tests
