// SPDX-License-Identifier: BSD-3-Clause
// Gridding for every kind of pulse and absorption, of few echoes and of many.
#include "beamforming/gridded/gridded_engine.hpp"
#include "core/random.hpp"
#include "sonar/shading.hpp"
#include "support/heads.hpp"
#include "support/test.hpp"

namespace {

SonarHead head_of(PulseShape shape) {
  SonarHead head = line_head({.beams = 64, .elements = 32, .max_range = 2.2});
  if (shape == PulseShape::linear_fm) head.pulse.shape = shape, head.pulse.duration = 1e-3;
  return head;
}

/// Returns water with 20 dB of absorption over the gate, and as much over the band by its slope or its curvature.
Medium medium_of(bool slope, bool curvature) {
  const double loss = 20 * nepers_per_db / 2.4;
  return {c0_cold, {loss, slope ? 0.3 * loss / 30e3 : 0, curvature ? 0.3 * loss / 30e3 / 30e3 : 0}};
}

Echoes crowd(std::size_t count, double doppler) {
  Echoes e;
  for (std::size_t i = 0; i < count; ++i) {
    const auto at = random_uniform(5, RandomStage::scene_points, {i, 0, 0});
    e.delay.push_back(2 * (0.95 + 1.3 * at[0]) / c0_cold);  // some begin or end outside the gate
    e.u.push_back(-0.9 + 1.8 * at[1]);
    e.amplitude.push_back(std::polar(1.0, 2 * pi * at[2]));
    if (doppler != 0) e.doppler.push_back(doppler * (2 * at[3] - 1));
  }
  return e;
}

void expect_promise(const SonarHead& head, const Medium& medium, double doppler = 0) {
  for (const std::size_t count : {3, 1000})
    for (const double tolerance : {1e-2, 1e-4, 1e-7, 1e-11}) {
      const GriddedEngine plan(head, medium, {tolerance, 2});
      const Echoes echoes = crowd(count, doppler);
      const ComplexGrid exact = synthesize_direct(echoes, head, medium);
      EXPECT_LE(relative_l2(plan.pressure(echoes), exact), tolerance) << count << " echoes, " << tolerance;
    }
}

}  // namespace

TEST(GriddedEchoes, keep_the_tolerance_for_a_pulse_of_one_shape) {
  expect_promise(head_of(PulseShape::gaussian), medium_of(false, false));
}

TEST(GriddedEchoes, keep_the_tolerance_where_absorption_has_a_slope) {
  expect_promise(head_of(PulseShape::gaussian), medium_of(true, false));
}

TEST(GriddedEchoes, keep_the_tolerance_where_absorption_is_curved) {
  expect_promise(head_of(PulseShape::gaussian), medium_of(false, true));
}

TEST(GriddedEchoes, keep_the_tolerance_with_doppler_shifts) {
  expect_promise(head_of(PulseShape::gaussian), medium_of(false, false), 2000);
}

TEST(GriddedEchoes, keep_the_tolerance_for_sweeps_with_both_their_ends) {
  expect_promise(head_of(PulseShape::linear_fm), medium_of(false, false));
}

TEST(GriddedEchoes, keep_the_tolerance_for_sweeps_through_sloping_absorption) {
  expect_promise(head_of(PulseShape::linear_fm), medium_of(true, true));
}

TEST(GriddedEchoes, keep_the_tolerance_for_sweeps_with_doppler_shifts) {
  expect_promise(head_of(PulseShape::linear_fm), medium_of(false, false), 2000);
}

// Echoes beside the fan are received by side lobes only: detected from the image, which is repeated more accurately.
TEST(GriddedEchoes, keep_the_tolerance_outside_all_beams) {
  SonarHead head = head_of(PulseShape::gaussian);
  head.fan = make_fan(64, radians(8), radians(2), radians(20));
  const Medium medium = medium_of(false, false);
  for (const double tolerance : {1e-2, 1e-4, 1e-8}) {
    const GriddedEngine plan(head, medium, {tolerance, 2});
    Echoes echoes = crowd(1000, 0);
    for (double& u : echoes.u) u = 0.75 + 0.1 * u;
    EXPECT_LE(relative_l2(plan.pressure(echoes), synthesize_direct(echoes, head, medium)), tolerance) << tolerance;
  }
}
