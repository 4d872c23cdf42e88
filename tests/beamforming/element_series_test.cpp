// SPDX-License-Identifier: BSD-3-Clause
#include "beamforming/reference/element_series.hpp"

#include "beamforming/synthesize.hpp"
#include "core/random.hpp"
#include "sonar/pulse.hpp"
#include "sonar/shading.hpp"
#include "support/heads.hpp"
#include "support/test.hpp"

namespace {

SonarHead head_of(double frequency, double bandwidth, std::size_t elements, double min_range, double max_range) {
  return line_head({frequency, bandwidth, 200, 9, elements, 80, 2, 20, min_range, max_range, c0});
}

Medium water() { return {c0, {0.02, 0, 0}}; }

Echoes echoes_in(const SonarHead& head, std::size_t n) {
  Echoes e;
  for (std::size_t i = 0; i < n; ++i) {
    const auto at = random_uniform(3, RandomStage::scene_points, {i, 0, 0});
    e.delay.push_back(2 * (head.gate.min_range + at[0] * (head.gate.max_range - head.gate.min_range)) / c0);
    e.u.push_back(1.4 * at[1] - 0.7);
    e.amplitude.push_back(random_complex_normal(3, RandomStage::noise, {i, 0, 0}));
  }
  return e;
}

/// The definition, echo by echo and element by element, without sampled series.
ComplexGrid referee(const Echoes& e, const SonarHead& head, const Medium& medium, Wavefront wavefront) {
  ComplexGrid p = ComplexGrid::Zero(head.fan.beams(), head.gate.bins());
  const std::size_t elements = head.array.elements();
  const auto longer = [&](double r, double u, double y) {
    return wavefront == Wavefront::plane ? -y * u : std::sqrt(r * r - 2 * r * y * u + y * y) - r;
  };
  for (std::size_t i = 0; i < e.size(); ++i) {
    const double r = 0.5 * c0 * e.delay[i];
    const EchoEnvelope envelope = echo_envelope(head.pulse, medium.absorption, r);
    for (std::size_t b = 0; b < head.fan.beams(); ++b)
      for (std::size_t n = 0; n < head.gate.bins(); ++n)
        for (std::size_t m = 0; m < elements; ++m) {
          const double y = head.array.spacing * (static_cast<double>(m) - 0.5 * (static_cast<double>(elements) - 1));
          const double in = longer(r, e.u[i], y) / c0,
                       out = longer(head.gate.centre(n), std::sin(head.fan.azimuth[b]), y) / c0;
          const double t = 2 * head.gate.centre(n) / c0 - e.delay[i] + out - in;
          p(b, n) += head.array.shading[m] / static_cast<double>(elements) * e.amplitude[i] *
                     std::polar(1.0, 2 * pi * head.pulse.centre_frequency * (in - out)) * envelope.at(t);
        }
  }
  return p;
}

ComplexGrid beams_of(const Echoes& e, const SonarHead& head, const ElementOptions& options) {
  return beam_from_elements(element_series(e, head, water(), options), head, water(), options);
}

}  // namespace

// Bandwidth a quarter of the carrier, in the near field (L^2 / lambda = 1.5 m).
TEST(ElementSeries, wide_band_and_near_field_keep_the_tolerance_against_the_definition) {
  const SonarHead head = head_of(400e3, 100e3, 40, 0.5, 0.9);
  const Echoes e = echoes_in(head, 20);
  for (const Wavefront wavefront : {Wavefront::spherical, Wavefront::plane}) {
    const ComplexGrid exact = referee(e, head, water(), wavefront);
    for (const double tolerance : {1e-2, 1e-4, 1e-6, 1e-9})
      EXPECT_LE(relative_l2(beams_of(e, head, {tolerance, wavefront}), exact), tolerance) << tolerance;
  }
}

// Narrow band and far field: agrees with the fixed pattern of the other methods.
TEST(ElementSeries, far_and_narrow_agree_with_the_fixed_pattern) {
  const SonarHead head = head_of(400e3, 1e3, 24, 100, 108);
  const Echoes e = echoes_in(head, 30);
  EXPECT_LT(relative_l2(beams_of(e, head, {1e-6, Wavefront::spherical}), synthesize_direct(e, head, water())), 0.02);
  EXPECT_LT(relative_l2(beams_of(e, head, {1e-6, Wavefront::plane}), synthesize_direct(e, head, water())), 0.02);
}

// The error of the fixed pattern grows with bandwidth x array length / sound speed.
TEST(ElementSeries, wide_band_changes_the_image_in_proportion_to_the_band) {
  const auto change = [](double bandwidth) {
    const SonarHead head = head_of(400e3, bandwidth, 24, 100, 100 + 8e3 / bandwidth);
    const Echoes e = echoes_in(head, 40);
    return relative_l2(beams_of(e, head, {1e-6, Wavefront::plane}), synthesize_direct(e, head, water()));
  };
  const double narrow = change(1e3);
  EXPECT_NEAR(change(4e3) / narrow, 4, 1.5);
  EXPECT_GT(change(80e3), 0.05);
}

// In the near field a focused beam keeps the level of a point on its axis; a plane-wave beam does not.
TEST(ElementSeries, focus_keeps_the_level_of_a_point_in_the_near_field) {
  SonarHead head = head_of(900e3, 30e3, 102, 0.8, 1.2);
  head.fan = make_fan(1, 0, radians(1), radians(20));
  Echoes point;
  point.delay = {2 * head.gate.centre(17) / c0};
  point.u = {0};
  point.amplitude = {{1, 0}};
  const double alone = std::exp(-2 * 0.02 * head.gate.centre(17));
  EXPECT_NEAR(std::abs(beams_of(point, head, {1e-8, Wavefront::spherical})(0, 17)), alone, 1e-7);
  const ElementSeries series = element_series(point, head, water(), {1e-8, Wavefront::spherical});
  EXPECT_LT(std::abs(beam_from_elements(series, head, water(), {1e-8, Wavefront::plane})(0, 17)), 0.8 * alone);
}

// An echo from port reaches the port element first.
TEST(ElementSeries, port_elements_receive_port_echoes_first) {
  const SonarHead head = head_of(400e3, 100e3, 40, 5, 5.4);
  Echoes point;
  point.delay = {2 * 5.2 / c0};
  point.u = {0.5};
  point.amplitude = {{1, 0}};
  const ElementSeries series = element_series(point, head, water(), {1e-4, Wavefront::plane});
  Eigen::Index starboard = 0, port = 0;
  series.pressure.row(0).abs().maxCoeff(&starboard);
  series.pressure.row(39).abs().maxCoeff(&port);
  EXPECT_NEAR(static_cast<double>(starboard - port) * series.step, 39 * head.array.spacing * 0.5 / c0, series.step);
}

TEST(ElementSeries, same_bits_for_any_number_of_threads) {
  const SonarHead head = head_of(400e3, 50e3, 16, 2, 3);
  const Echoes e = echoes_in(head, 50);
  const ComplexGrid one = beams_of(e, head, {1e-4, Wavefront::spherical, 1});
  for (const int threads : {2, 7}) EXPECT_TRUE((one == beams_of(e, head, {1e-4, Wavefront::spherical, threads})).all());
}

TEST(ElementSeries, refuses_a_tolerance_it_cannot_keep_and_a_series_of_another_head) {
  const SonarHead head = head_of(400e3, 50e3, 16, 2, 3);
  EXPECT_THAT(error_of([&] { element_series({}, head, water(), {1e-14}); }), HasSubstr("tolerance = 1e-14"));
  ElementSeries other = element_series({}, head, water(), {});
  other.pressure.conservativeResize(15, other.pressure.cols());
  EXPECT_THAT(error_of([&] { beam_from_elements(other, head, water()); }), HasSubstr("15 elements"));
}
