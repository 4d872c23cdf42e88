// SPDX-License-Identifier: BSD-3-Clause
#include "beamforming/gridded/gridded_engine.hpp"

#include "core/random.hpp"
#include "sonar/sonar_spec.hpp"
#include "support/echo_chunks.hpp"
#include "support/heads.hpp"
#include "support/test.hpp"

namespace {

constexpr double speed_of_sound = 1500;

struct Case {
  std::size_t echoes = 200, beams = 32, bins = 256;
  double bandwidth = 30e3;
  double dynamic_range_db = 40;  ///< fall from the first bin to the last
  double field_of_view = radians(60);
  double beam_width = radians(2);
  double bin_part = 0.44;  ///< bins by the length of the pulse, c / 2 B
  int absorption_order = 0;
};

SonarHead head_of(const Case& c) {
  SonarSpec s;
  s.name = "test";
  s.centre_frequency = 600e3, s.bandwidth = c.bandwidth;
  s.beams = c.beams, s.field_of_view = c.field_of_view;
  s.beam_width = c.beam_width, s.elevation_width = radians(20);
  s.min_range = 1;
  s.bin_size = c.bin_part * speed_of_sound / (2 * c.bandwidth);
  s.max_range = 1 + (static_cast<double>(c.bins) - 0.5) * *s.bin_size;
  return make_head(s, speed_of_sound);
}

/// Returns the absorption that lowers the last bin by the dynamic range against the first.
Medium medium_of(const Case& c, const SonarHead& head) {
  Medium m;
  m.sound_speed = speed_of_sound;
  m.absorption.a0 = c.dynamic_range_db * nepers_per_db / (2 * (head.gate.max_range - head.gate.min_range));
  if (c.absorption_order >= 1) m.absorption.a1 = m.absorption.a0 / head.pulse.centre_frequency;
  if (c.absorption_order >= 2) m.absorption.a2 = m.absorption.a0 / std::pow(head.pulse.centre_frequency, 2);
  return m;
}

/// Returns complex-normal echoes in and a little beyond fan and gate.
Echoes echoes_of(const Case& c, const SonarHead& head) {
  Echoes e;
  const double length = head.gate.max_range - head.gate.min_range;
  for (std::size_t i = 0; i < c.echoes; ++i) {
    const auto at = random_uniform(7, RandomStage::scene_points, {i, 0, 0});
    e.delay.push_back(2 * (head.gate.min_range + length * (1.02 * at[0] - 0.01)) / speed_of_sound);
    e.u.push_back(std::sin((at[1] - 0.5) * (c.field_of_view + c.beam_width)));
    e.amplitude.push_back(random_complex_normal(7, RandomStage::noise, {i, 0, 0}));
  }
  return e;
}

/// Returns the largest relative error of the eighths of the range axis, each by its own level.
double local_error(const ComplexGrid& a, const ComplexGrid& b) {
  double worst = 0;
  const Eigen::Index part = b.cols() / 8;
  for (Eigen::Index k = 0; k < 8; ++k)
    if (b.middleCols(k * part, part).abs2().sum() > 0)
      worst = std::max(worst, relative_l2(a.middleCols(k * part, part), b.middleCols(k * part, part)));
  return worst;
}

ComplexGrid synthesized(const Case& c, double tolerance, int threads = 0) {
  const SonarHead head = head_of(c);
  return GriddedEngine(head, medium_of(c, head), {tolerance, threads}).pressure(echoes_of(c, head));
}

ComplexGrid referee(const Case& c) {
  const SonarHead head = head_of(c);
  return synthesize_direct(echoes_of(c, head), head, medium_of(c, head));
}

}  // namespace

class GriddedEngineTolerance : public testing::TestWithParam<Case> {};

TEST_P(GriddedEngineTolerance, holds_for_the_image_and_for_every_part_of_the_range_axis) {
  const ComplexGrid exact = referee(GetParam());
  for (const double tolerance : {1e-2, 1e-3, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12}) {
    const ComplexGrid image = synthesized(GetParam(), tolerance);
    EXPECT_LE(relative_l2(image, exact), tolerance) << tolerance;
    if (GetParam().echoes >= 200) {  // fewer leave parts of the axis without an echo
      EXPECT_LE(local_error(image, exact), tolerance) << tolerance;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Sweep, GriddedEngineTolerance,
                         testing::Values(Case{.echoes = 1}, Case{.echoes = 10, .beams = 17, .bins = 251},
                                         Case{.echoes = 1000}, Case{.echoes = 30000, .beams = 16},
                                         Case{.beams = 1, .field_of_view = radians(2)},
                                         Case{.beams = 256, .bins = 127, .beam_width = radians(1)},
                                         Case{.bandwidth = 300e3}, Case{.bandwidth = 3e3},
                                         Case{.dynamic_range_db = 150}, Case{.dynamic_range_db = 0},
                                         Case{.bins = 31, .beam_width = radians(60)}, Case{.absorption_order = 1},
                                         Case{.bandwidth = 100e3, .dynamic_range_db = 60, .absorption_order = 2},
                                         Case{.echoes = 200, .beams = 4096, .bins = 131, .field_of_view = radians(120)},
                                         Case{.echoes = 100000, .beams = 5, .bins = 251, .bandwidth = 200e3},
                                         Case{.beams = 61, .field_of_view = radians(170), .beam_width = radians(5)}));

// 400 dB from one end of the axis to the other: near echoes do not disturb far ones.
TEST(GriddedEngine, error_is_local_in_single_precision_over_400_db) {
  const Case c{.echoes = 2000, .dynamic_range_db = 400};
  EXPECT_LE(local_error(synthesized(c, 1e-4), referee(c)), 1e-4);
}

TEST(GriddedEngine, same_plan_serves_many_pings) {
  const Case c;
  const SonarHead head = head_of(c);
  const GriddedEngine plan(head, medium_of(c, head), {1e-6, 1});
  const Echoes e = echoes_of(c, head);
  const ComplexGrid first = plan.pressure(e);
  plan.pressure(Echoes{});
  EXPECT_TRUE((first == plan.pressure(e)).all());
}

TEST(GriddedEngine, no_echoes_and_echoes_beyond_the_gate_give_silence) {
  const Case c;
  const SonarHead head = head_of(c);
  const GriddedEngine plan(head, medium_of(c, head), {1e-6, 1});
  EXPECT_EQ(plan.pressure(Echoes{}).abs().maxCoeff(), 0);
  Echoes far;
  far.delay = {1.0, 1e-6};
  far.u = {0.1, 0.1};
  far.amplitude = {{1, 0}, {1, 0}};
  EXPECT_EQ(plan.pressure(far).abs().maxCoeff(), 0);
}

TEST(GriddedEngine, all_echoes_in_one_bin_and_direction_add_coherently) {
  const Case c;
  const SonarHead head = head_of(c);
  Echoes hot;
  hot.delay.assign(100000, 2 * head.gate.centre(100) / speed_of_sound);
  hot.u.assign(100000, 0.2);
  hot.amplitude.assign(100000, {1, 0});
  Echoes one = hot;
  one.delay.resize(1), one.u.resize(1), one.amplitude = {{1e5, 0}};
  const Medium m = medium_of(c, head);
  EXPECT_LE(relative_l2(GriddedEngine(head, m, {1e-4, 0}).pressure(hot), synthesize_direct(one, head, m)), 1e-4);
}

TEST(GriddedEngine, keeps_its_tolerance_for_echoes_that_cancel) {
  const Case c{.echoes = 300};
  const SonarHead head = head_of(c);
  Echoes e = echoes_of(c, head);
  const std::size_t n = e.size();
  for (std::size_t i = 0; i < n; ++i) {
    e.delay.push_back(e.delay[i]);
    e.u.push_back(e.u[i]);
    e.amplitude.push_back(-e.amplitude[i] * (1 + 1e-4));
  }
  const Medium m = medium_of(c, head);
  const ComplexGrid exact = synthesize_direct(e, head, m);
  EXPECT_LE(relative_l2(GriddedEngine(head, m, {1e-4, 0}).pressure(e), exact), 1e-4);
}

TEST(GriddedEngine, reports_its_choice) {
  const Case c;
  const SonarHead head = head_of(c);
  const SynthesisChoice coarse = GriddedEngine(head, medium_of(c, head), {1e-3, 0}).choice();
  const SynthesisChoice fine = GriddedEngine(head, medium_of(c, head), {1e-10, 0}).choice();
  EXPECT_TRUE(coarse.single_precision);
  EXPECT_FALSE(fine.single_precision);
  EXPECT_LT(coarse.kernel_width, fine.kernel_width);
  EXPECT_LT(coarse.pulse_samples, fine.pulse_samples);
  EXPECT_GE(coarse.grid, 2 * head.array.elements());
}

// Echoes with Doppler shifts, few and many; the same bits for any number of threads.
TEST(GriddedEngine, keeps_its_tolerance_for_moving_echoes) {
  for (const std::size_t echoes : {5, 200, 2000}) {
    const Case c{.echoes = echoes, .beams = 48, .bins = 1000, .bandwidth = 60e3};
    const SonarHead head = head_of(c);
    const Medium m = medium_of(c, head);
    Echoes e = echoes_of(c, head);
    for (std::size_t i = 0; i < e.size(); ++i) e.doppler.push_back(500 * std::sin(static_cast<double>(i)));
    const ComplexGrid exact = synthesize_direct(e, head, m);
    for (const double tolerance : {1e-3, 1e-7, 1e-11}) {
      const ComplexGrid image = GriddedEngine(head, m, {tolerance, 1}).pressure(e);
      EXPECT_LE(relative_l2(image, exact), tolerance) << echoes << " echoes";
      EXPECT_TRUE((image == GriddedEngine(head, m, {tolerance, 3}).pressure(e)).all()) << echoes << " echoes";
    }
  }
}

// A pulse of thousands of bins: samples follow one another by recurrence.
TEST(GriddedEngine, keeps_its_tolerance_for_a_long_pulse) {
  for (const int order : {0, 2}) {
    const Case c{
        .echoes = 20, .beams = 3, .bins = 4000, .bandwidth = 30e3, .bin_part = 0.002, .absorption_order = order};
    const ComplexGrid exact = referee(c);
    for (const double tolerance : {1e-4, 1e-9, 1e-12})
      EXPECT_LE(relative_l2(synthesized(c, tolerance), exact), tolerance) << order;
  }
}

// Two echoes of opposite sign a little apart: at a bin near the end of one pulse and beyond that of the other, the part
// cut off is small compared with each echo but not with their difference.
TEST(GriddedEngine, keeps_its_tolerance_for_few_echoes_that_cancel) {
  const Case c{.beams = 4, .bins = 40};
  const SonarHead head = head_of(c);
  const Medium m = medium_of(c, head);
  const double step = 2 * head.gate.bin_size / speed_of_sound, first = 2 * head.gate.centre(20) / speed_of_sound;
  for (const double tolerance : {1e-2, 1e-6}) {
    const GriddedEngine plan(head, m, {tolerance, 1});
    double worst = 0;
    for (int k = 0; k < 500; ++k) {
      const double delay = first + 0.002 * k * step;
      const Echoes e{{delay, delay + 0.002 * step}, {0.1, 0.1}, {{1, 0}, {-1, 0}}};
      worst = std::max(worst, relative_l2(plan.pressure(e), synthesize_direct(e, head, m)));
    }
    EXPECT_LE(worst, tolerance);
  }
}

// Arrays have an element or two to a thousand.
TEST(GriddedEngine, keeps_its_tolerance_for_any_array) {
  for (const double beam_width : {radians(0.11), radians(0.3), radians(60)}) {
    const Case c{.echoes = 70, .beams = 21, .bins = 300, .beam_width = beam_width};
    const SonarHead head = head_of(c);
    const GriddedEngine plan(head, medium_of(c, head), {1e-12, 2});
    const Echoes e = echoes_of({.echoes = 3, .beams = 21, .bins = 300, .beam_width = beam_width}, head);
    EXPECT_LE(relative_l2(plan.pressure(e), synthesize_direct(e, head, medium_of(c, head))), 1e-12);
    EXPECT_LE(relative_l2(synthesized(c, 1e-12), referee(c)), 1e-12);
  }
}

TEST(GriddedEngine, refuses_a_tolerance_it_cannot_keep_and_a_nan) {
  const Case c;
  const SonarHead head = head_of(c);
  EXPECT_THAT(error_of([&] {
                GriddedEngine(head, medium_of(c, head), {1e-15, 0});
              }),
              HasSubstr("tolerance = 1e-15, must be at least 1e-13"));
  Echoes e = echoes_of(c, head);
  e.amplitude[5] = {NAN, 0};
  EXPECT_THAT(error_of([&] { GriddedEngine(head, medium_of(c, head), {1e-4, 0}).pressure(e); }), HasSubstr("5"));
}

// Tiles that an error has left half filled must not come back in the next image.
TEST(GriddedEngine, an_image_after_an_error_holds_nothing_of_the_echoes_before_it) {
  const Case c;
  const SonarHead head = head_of(c);
  const Medium medium = medium_of(c, head);
  const Echoes echoes = echoes_of(c, head);
  const GriddedEngine engine(head, medium, {1e-4, 1});
  Echoes loud = echoes;
  for (auto& amplitude : loud.amplitude) amplitude *= 10;
  loud.amplitude.back() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(error_of([&] { (void)engine.pressure(EchoChunks(loud, speed_of_sound)); }), HasSubstr("amplitude"));
  EXPECT_TRUE((engine.pressure(echoes) == GriddedEngine(head, medium, {1e-4, 1}).pressure(echoes)).all());
}
