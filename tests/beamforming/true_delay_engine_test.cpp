// SPDX-License-Identifier: BSD-3-Clause
#include "beamforming/true_delays/true_delay_engine.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "beamforming/reference/element_series.hpp"
#include "core/random.hpp"
#include "core/units.hpp"
#include "sonar/shading.hpp"
#include "support/errors.hpp"
#include "support/heads.hpp"

using namespace insonify;

namespace {

Medium near_water() { return {c0, {0.02, 0, 0}}; }

struct TrueDelayCase {
  const char* name;
  double frequency, bandwidth;
  std::size_t elements;
  double field_of_view, min_range, max_range;
};

SonarHead true_delay_head(const TrueDelayCase& of) {
  SonarHead head;
  head.pulse = {of.frequency, of.bandwidth, 200};
  head.array = {0.5 * c0 / of.frequency, taylor_shading(of.elements, -30)};
  head.fan = make_fan(9, radians(of.field_of_view), radians(2), radians(20));
  head.gate = {of.min_range, of.max_range, 0.44 * c0 / (2 * of.bandwidth)};
  return head;
}

Echoes near_echoes(const SonarHead& head, std::size_t n) {
  Echoes e;
  const double widest = std::sin(head.fan.azimuth.back());
  for (std::size_t i = 0; i < n; ++i) {
    const auto at = random_uniform(5, RandomStage::scene_points, {i, 0, 0});
    e.delay.push_back(2 * (head.gate.min_range + at[0] * (head.gate.max_range - head.gate.min_range)) / c0);
    e.u.push_back(1.05 * widest * (2 * at[1] - 1));
    e.amplitude.push_back(random_complex_normal(5, RandomStage::noise, {i, 0, 0}));
  }
  return e;
}

ComplexGrid synthesize_true_delays(const Echoes& echoes, const SonarHead& head, const Medium& medium,
                                   const SynthesisOptions& options = {}) {
  return TrueDelayEngine(head, medium, options).pressure(echoes);
}

ComplexGrid exact(const Echoes& e, const SonarHead& head, const Medium& medium = near_water()) {
  return synthesize(e, head, medium, SynthesisMethod::element_exact, {1e-7});
}

double relative_l2(const ComplexGrid& a, const ComplexGrid& b) {
  return std::sqrt((a - b).abs2().sum() / b.abs2().sum());
}

class TrueDelayPromise : public testing::TestWithParam<TrueDelayCase> {};

}  // namespace

TEST_P(TrueDelayPromise, true_delays_of_every_element_to_the_tolerance) {
  const SonarHead head = true_delay_head(GetParam());
  const Echoes e = near_echoes(head, 60);
  const ComplexGrid referee = exact(e, head);
  for (const double tolerance : {1e-2, 1e-3, 1e-4, 1e-5})
    EXPECT_LE(relative_l2(synthesize_true_delays(e, head, near_water(), {tolerance}), referee), tolerance) << tolerance;
  // The narrow band is wrong by more than that, which is why true delays exist.
  EXPECT_GT(relative_l2(synthesize_gridded(e, head, near_water()), referee), 1e-2);
}

INSTANTIATE_TEST_SUITE_P(heads, TrueDelayPromise,
                         testing::Values(TrueDelayCase{"wide", 400e3, 100e3, 40, 120, 3, 3.6},
                                         TrueDelayCase{"half_the_carrier", 400e3, 200e3, 40, 120, 6, 6.3},
                                         TrueDelayCase{"narrow_fan", 1800e3, 150e3, 160, 28, 4, 4.4},
                                         TrueDelayCase{"long_array", 400e3, 40e3, 128, 120, 20, 21},
                                         TrueDelayCase{"near", 400e3, 100e3, 40, 90, 0.5, 0.7},
                                         TrueDelayCase{"oculus_m750d", 750e3, 187.5e3, 64, 130, 0.5, 0.6},
                                         TrueDelayCase{"em2040", 400e3, 37.5e3, 64, 140, 0.5, 0.9},
                                         TrueDelayCase{"aris_3000", 3000e3, 250e3, 128, 28, 0.4, 0.45},
                                         TrueDelayCase{"p900_45", 900e3, 29.5e3, 64, 45, 0.5, 0.8},
                                         TrueDelayCase{"as_near_as_the_array_is_long", 400e3, 100e3, 40, 90, 0.075,
                                                       0.2},
                                         TrueDelayCase{"all_of_it_near", 400e3, 100e3, 40, 90, 0.075, 0.1},
                                         TrueDelayCase{"hardly_a_band", 600e3, 1.5e3, 64, 90, 0.5, 5}),
                         [](const auto& one) { return std::string(one.param.name); });

struct OneBeamCase {
  const char* name;
  double frequency, bandwidth;
  std::size_t elements;
  double azimuth, widest, min_range, max_range;  // degrees, |u| of echoes from the beam, metres
};

class OneBeamPromise : public testing::TestWithParam<OneBeamCase> {
 protected:
  OneBeamPromise()
      : head(true_delay_head({"", GetParam().frequency, GetParam().bandwidth, GetParam().elements, 1,
                              GetParam().min_range, GetParam().max_range})) {
    const OneBeamCase& of = GetParam();
    head.fan.azimuth = {radians(of.azimuth)};
    head.fan.elevation = {0};
    echoes = near_echoes(head, 60);
    for (std::size_t i = 0; i < echoes.size(); ++i) {
      const auto at = random_uniform(6, RandomStage::scene_points, {i, 0, 0});
      echoes.u[i] = std::sin(radians(of.azimuth)) + of.widest * (2 * at[0] - 1);
    }
  }
  SonarHead head;
  Echoes echoes;
  Medium water{c0, {0.02, 1e-8, 3e-15}};  // losses that tilt and widen pulses
};

// Responses between the entries of tables: near and far, within the main lobe and far beyond it.
TEST_P(OneBeamPromise, true_delays_of_every_element_to_the_tolerance) {
  const ComplexGrid referee = exact(echoes, head, water);
  for (const double tolerance : {1e-2, 1e-3, 1e-4, 1e-5})
    EXPECT_LE(relative_l2(synthesize_true_delays(echoes, head, water, {tolerance}), referee), tolerance) << tolerance;
}

TEST_P(OneBeamPromise, the_same_of_moving_echoes) {
  for (std::size_t i = 0; i < echoes.size(); ++i)
    echoes.doppler.push_back(4e-3 * head.pulse.centre_frequency * std::sin(static_cast<double>(i)));
  const ComplexGrid referee = exact(echoes, head, water);
  for (const double tolerance : {1e-2, 1e-3, 1e-4})
    EXPECT_LE(relative_l2(synthesize_true_delays(echoes, head, water, {tolerance}), referee), tolerance) << tolerance;
}

using FastOneBeam = OneBeamPromise;

// Shifts that tables do not hold. Curved wavefronts come to the ends of a long array from beyond the fan.
TEST_P(FastOneBeam, fast_echoes_keep_a_hundredth) {
  for (std::size_t i = 0; i < echoes.size(); ++i)
    echoes.doppler.push_back(i % 10 == 0 ? 0.03 * head.pulse.centre_frequency : 0);
  EXPECT_LE(relative_l2(synthesize_true_delays(echoes, head, water, {1e-2}), exact(echoes, head, water)), 1e-2);
}

constexpr OneBeamCase in_their_lobes[] = {{"side_scan", 500e3, 40e3, 610, 0, 0.008, 3, 6},
                                          {"its_side_lobes", 500e3, 40e3, 610, 0, 0.05, 4, 6},
                                          {"nearer_than_tables", 500e3, 40e3, 128, 0, 0.05, 0.1, 1},
                                          {"scanning", 700e3, 60e3, 48, 0, 0.9, 0.3, 2},
                                          {"aside", 700e3, 60e3, 48, 20, 0.2, 0.3, 2}};
constexpr OneBeamCase beyond_them[] = {{"side_scan_far", 500e3, 40e3, 610, 0, 0.008, 100, 104},
                                       {"far_beyond_its_lobe", 500e3, 40e3, 400, 0, 0.97, 2, 4},
                                       {"all_around_and_far", 1000e3, 60e3, 400, 0, 0.97, 20, 21},
                                       {"one_element", 700e3, 60e3, 1, 0, 0.9, 0.3, 1}};
const auto case_name = [](const auto& one) { return std::string(one.param.name); };
INSTANTIATE_TEST_SUITE_P(in_lobes, OneBeamPromise, testing::ValuesIn(in_their_lobes), case_name);
INSTANTIATE_TEST_SUITE_P(beyond, OneBeamPromise, testing::ValuesIn(beyond_them), case_name);
INSTANTIATE_TEST_SUITE_P(in_lobes, FastOneBeam, testing::ValuesIn(in_their_lobes), case_name);

// Pulses of moving echoes, and of losses that tilt and widen them, are each gridded as they are.
TEST(TrueDelayEngine, moving_echoes_and_absorption_by_frequency_keep_the_tolerance) {
  const SonarHead head = true_delay_head({"", 400e3, 100e3, 40, 120, 3, 3.6});
  Echoes e = near_echoes(head, 60);
  for (std::size_t i = 0; i < e.size(); ++i) e.doppler.push_back(40.0 * static_cast<double>(i % 50) - 1000);
  const Medium tilted{c0, {0.02, 2e-8, 1e-14}};
  EXPECT_LE(relative_l2(synthesize_true_delays(e, head, tilted, {1e-3}), exact(e, head, tilted)), 1e-3);
}

struct MovingCase {
  TrueDelayCase head;
  double speed;  ///< largest, along the line of sight [m/s]
};

Echoes moving_echoes(const MovingCase& of, const SonarHead& head) {
  Echoes e = near_echoes(head, 60);
  for (std::size_t i = 0; i < e.size(); ++i)
    e.doppler.push_back(2 * of.speed / c0 * head.pulse.centre_frequency * std::sin(static_cast<double>(i)));
  return e;
}

// Shifts beyond the band, and near ranges, where the curvature changes over a pulse whose spectrum is shifted.
TEST(TrueDelayEngine, echoes_that_move_in_a_narrow_band_or_nearby_keep_the_tolerance) {
  const MovingCase cases[] = {{{"beyond_the_band", 600e3, 3e3, 84, 45, 20, 26}, 5},
                              {{"within_the_band", 600e3, 30e3, 84, 45, 3, 5}, 5},
                              {{"nearby", 600e3, 30e3, 84, 45, 1, 1.7}, 5},
                              {{"three_lengths_away", 600e3, 30e3, 84, 45, 0.35, 0.8}, 5}};
  for (const MovingCase& of : cases) {
    const SonarHead head = true_delay_head(of.head);
    const Echoes e = moving_echoes(of, head);
    const ComplexGrid referee = exact(e, head);
    for (const double tolerance : {1e-2, 1e-3, 1e-4, 1e-5})
      EXPECT_LE(relative_l2(synthesize_true_delays(e, head, near_water(), {tolerance}), referee), tolerance)
          << of.head.name << ", " << tolerance;
  }
}

TEST(TrueDelayEngine, same_bits_for_moving_echoes_and_any_number_of_threads) {
  const MovingCase of{{"", 600e3, 30e3, 84, 45, 3, 4}, 5};
  const SonarHead head = true_delay_head(of.head);
  const Echoes e = moving_echoes(of, head);
  const ComplexGrid one = synthesize_true_delays(e, head, near_water(), {1e-4, 1});
  EXPECT_TRUE((one == synthesize_true_delays(e, head, near_water(), {1e-4, 7})).all());
}

// The band reaches to 0.98 and 1.3 of the carrier below it.
TEST(TrueDelayEngine, bands_that_reach_near_zero_keep_the_tolerance) {
  for (const auto& [bandwidth, tolerance] : {std::pair{200e3, 1e-5}, std::pair{300e3, 1e-4}}) {
    const SonarHead head = true_delay_head({"", 600e3, bandwidth, 84, 45, 1, 1.5});
    const Echoes e = near_echoes(head, 60);
    EXPECT_LE(relative_l2(synthesize_true_delays(e, head, near_water(), {tolerance}), exact(e, head)), tolerance);
  }
}

// Side lobes receive echoes from far beyond the fan: half of the echoes.
TEST(TrueDelayEngine, echoes_from_all_directions_keep_the_tolerance) {
  const SonarHead head = true_delay_head({"", 400e3, 100e3, 40, 30, 3, 3.6});
  Echoes e = near_echoes(head, 60);
  for (std::size_t i = 0; i < e.size(); i += 2) e.u[i] = (i % 4 == 0 ? 1 : -1) * (0.97 - 1e-3 * static_cast<double>(i));
  for (const double tolerance : {1e-3, 1e-4})
    EXPECT_LE(relative_l2(synthesize_true_delays(e, head, near_water(), {tolerance}), exact(e, head)), tolerance);
}

TEST(TrueDelayEngine, sweeps_keep_a_hundredth) {
  SonarHead head = true_delay_head({"", 400e3, 60e3, 40, 120, 5, 6});
  head.pulse.shape = PulseShape::linear_fm;
  head.pulse.duration = 1e-3;
  const Echoes e = near_echoes(head, 40);
  EXPECT_LE(relative_l2(synthesize_true_delays(e, head, near_water(), {1e-2}), exact(e, head)), 1e-2);
}

TEST(TrueDelayEngine, heads_of_several_rows_are_made_row_by_row) {
  SonarHead head = true_delay_head({"", 400e3, 100e3, 40, 90, 4, 4.4});
  const BeamFan row = head.fan;
  for (const double elevation : {-0.1, 0.1})
    for (std::size_t b = 0; b < row.beams(); ++b) {
      head.fan.azimuth.push_back(row.azimuth[b]);
      head.fan.elevation.push_back(elevation);
    }
  head.fan.azimuth.erase(head.fan.azimuth.begin(), head.fan.azimuth.begin() + static_cast<std::ptrdiff_t>(row.beams()));
  head.fan.elevation.erase(head.fan.elevation.begin(),
                           head.fan.elevation.begin() + static_cast<std::ptrdiff_t>(row.beams()));
  Echoes e = near_echoes(head, 40);
  for (std::size_t i = 0; i < e.size(); ++i) e.v.push_back(0.3 * std::sin(static_cast<double>(i)));
  EXPECT_LE(relative_l2(synthesize(e, head, near_water(), SynthesisMethod::true_delays, {1e-3}), exact(e, head)), 1e-3);
}

// A loud echo does not spoil a faint one a block away: each is right relative to its own level.
TEST(TrueDelayEngine, errors_stay_where_they_are_made) {
  const SonarHead head = true_delay_head({"", 400e3, 100e3, 40, 120, 3, 9});
  Echoes e;
  e.delay = {2 * 3.5 / c0, 2 * 8.5 / c0};
  e.u = {0.2, -0.4};
  e.amplitude = {{1e8, 0}, {1, 0}};
  const ComplexGrid referee = exact(e, head), image = synthesize_true_delays(e, head, near_water(), {1e-3});
  const Eigen::Index half = referee.cols() * 3 / 4;
  EXPECT_LE(relative_l2(image.rightCols(referee.cols() - half), referee.rightCols(referee.cols() - half)), 1e-3);
}

TEST(TrueDelayEngine, one_echo_and_none) {
  const SonarHead head = true_delay_head({"", 400e3, 100e3, 40, 120, 3, 5});
  const TrueDelayEngine plan(head, near_water(), {1e-3});
  EXPECT_EQ(plan.pressure(Echoes{}).abs2().sum(), 0);
  Echoes point;
  point.delay = {2 * 4.0 / c0};
  point.u = {0.01};
  point.amplitude = {{1e-30, 0}};
  EXPECT_LE(relative_l2(plan.pressure(point), exact(point, head)), 1e-3);
  // Just outside the gate, in the outermost beam, whose elements receive part of it within.
  point.delay = {2 * 5.005 / c0};
  point.u = {0.86};
  EXPECT_LE(relative_l2(plan.pressure(point), exact(point, head)), 1e-2);
}

TEST(TrueDelayEngine, same_bits_for_any_number_of_threads) {
  const SonarHead head = true_delay_head({"", 400e3, 100e3, 40, 120, 0.3, 6});
  const Echoes e = near_echoes(head, 200);
  const ComplexGrid one = synthesize_true_delays(e, head, near_water(), {1e-3, 1});
  for (const int threads : {2, 7})
    EXPECT_TRUE((one == synthesize_true_delays(e, head, near_water(), {1e-3, threads})).all());
}

TEST(TrueDelayEngine, refuses_what_it_cannot_keep) {
  const SonarHead head = true_delay_head({"", 400e3, 100e3, 40, 120, 3, 4});
  EXPECT_NE(error_of([&] { synthesize_true_delays({}, head, near_water(), {1e-6}); }).find("tolerance = 1e-06"),
            std::string::npos);
  EXPECT_NE(error_of([&] { synthesize_true_delays({}, head, near_water(), {0.5}); }).find("tolerance = 0.5"),
            std::string::npos);
  Echoes e = near_echoes(head, 3);
  e.u[1] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(error_of([&] { synthesize_true_delays(e, head, near_water()); }).find("echo 1"), std::string::npos);
  e.u[1] = -1.2;
  EXPECT_THAT(error_of([&] { synthesize_true_delays(e, head, near_water()); }), HasSubstr("u = +-1.2, must be within"));
}
