// SPDX-License-Identifier: BSD-3-Clause
// Tests the image of a curved array (E205): direct, element-exact and incoherent against sums of the definition.
#include "beamforming/engine.hpp"
#include "beamforming/gridded/gridded_engine.hpp"
#include "beamforming/reference/element_series.hpp"
#include "beamforming/split_aperture.hpp"
#include "beamforming/synthesize_cells.hpp"
#include "beamforming/synthesize_noise.hpp"
#include "beamforming/synthesizer.hpp"
#include "beamforming/true_delays/true_delay_engine.hpp"
#include "sonar/receive_array.hpp"
#include "support/heads.hpp"
#include "support/test.hpp"

namespace insonify::curved_array_tests {

const Medium water{c0, {}};

SonarHead bent_head(double min_range, double max_range, double bandwidth) {
  SonarHead head;
  head.name = "bent";
  head.pulse = {100e3, bandwidth, 220};
  head.fan = make_fan(41, radians(100), radians(3), radians(20));
  head.gate = {min_range, max_range, default_bin_size(head.pulse, c0)};
  head.array = {0.5 * c0 / 100e3, taylor_shading(56, -30)};
  head.array_shape = ArrayShape::curved;
  head.array_radius = 0.25;
  return head;
}

Echoes one_echo(double range, Direction direction) {
  const Eigen::Vector3d from = unit_vector(direction);
  Echoes echoes;
  echoes.delay = {2 * range / c0}, echoes.u = {from.y()}, echoes.v = {from.z()}, echoes.amplitude = {{0.3, 0.4}};
  return echoes;
}

// The level of a beam relative to the echo: elements of an arc, each with its own delay from the place of the echo, and
// with the delay by which the beam focuses on the range of the sample.
double summed_level_db(const SonarHead& head, double range, Direction from, double beam) {
  const double k = 2 * pi * head.pulse.centre_frequency / c0,
               middle = 0.5 * (static_cast<double>(head.array.elements()) - 1);
  const Eigen::Vector3d source = range * unit_vector(from), focus = range * unit_vector({beam, 0});
  std::complex<double> sum = 0;
  for (std::size_t m = 0; m < head.array.elements(); ++m) {
    const double angle = (static_cast<double>(m) - middle) * head.array.spacing / head.array_radius;
    const Eigen::Vector3d element = head.array_radius * Eigen::Vector3d(std::cos(angle), std::sin(angle), 0);
    sum += head.array.shading[m] * std::polar(1.0, k * ((source - element).norm() - (focus - element).norm()));
  }
  return 2 * 10 * std::log10(std::abs(sum) / static_cast<double>(head.array.elements()));
}

double peak_db(const ComplexGrid& image, std::size_t beam) {
  return 10 * std::log10(image.row(static_cast<Eigen::Index>(beam)).abs2().maxCoeff() / 0.25);
}

// Levels of all beams that hear an echo above `floor_db`, its range at the middle of a bin.
void expect_levels(SynthesisMethod method, double range, double bandwidth, double within_db) {
  SonarHead head = bent_head(0.9 * range, 1.1 * range, bandwidth);
  const double at = head.gate.centre(head.gate.bins() / 2);
  const Direction from{radians(18), radians(4)};
  const ComplexGrid image = synthesize(one_echo(at, from), head, water, method, {1e-5, 1});
  int heard = 0;
  for (std::size_t b = 0; b < head.fan.beams(); ++b) {
    const double expected = summed_level_db(head, at, from, head.fan.azimuth[b]);
    if (expected < -25) continue;
    ++heard;
    EXPECT_NEAR(peak_db(image, b), expected, within_db) << b;
  }
  EXPECT_GE(heard, 3);
}

TEST(CurvedArrayImage, has_the_levels_of_a_sum_over_elements_far_away) {
  for (const auto method : {SynthesisMethod::direct, SynthesisMethod::element_exact, SynthesisMethod::incoherent})
    expect_levels(method, 400, 500, 0.05);
}

TEST(CurvedArrayImage, is_focused_near_by_with_true_delays) {
  expect_levels(SynthesisMethod::element_exact, 2, 500, 0.05);
}

// A pulse of 30 m is the same at all elements: the narrow-band image is that of elements in plane waves.
TEST(CurvedArrayImage, of_plane_waves_is_that_of_the_elements_in_a_narrow_band) {
  const SonarHead head = bent_head(250, 460, 20);
  Echoes echoes;
  for (int i = 0; i < 40; ++i) {
    const Echoes one = one_echo(351 + 0.2 * i, {radians(-45 + 2.2 * i), radians(-6 + 0.3 * i)});
    echoes.delay.push_back(one.delay[0]), echoes.u.push_back(one.u[0]), echoes.v.push_back(one.v[0]);
    echoes.amplitude.push_back(std::polar(1.0, 0.7 * i * i));
  }
  const ElementOptions plane{1e-8, Wavefront::plane, 1};
  const ComplexGrid of_elements = beam_from_elements(element_series(echoes, head, water, plane), head, water, plane);
  EXPECT_LT(relative_l2(synthesize(echoes, head, water, SynthesisMethod::direct), of_elements), 1e-3);
}

TEST(CurvedArrayImage, of_noise_has_gain_and_correlation_of_the_steered_elements) {
  SonarHead head = bent_head(10, 110, 5e3);
  head.fan = make_fan(2, radians(4), radians(3), radians(20));
  const ComplexGrid noise = synthesize_noise(head, water, 60);
  const double element = 2 * std::pow(10, 6.0) * 1e-12;
  const double mean = noise.row(0).abs2().mean();
  EXPECT_NEAR(10 * std::log10(mean / element), -array_gain_db(head), 0.5);
  // Beams of independent elements are alike as far as their weights are.
  const auto array = receive_array(head);
  const std::vector<Eigen::Vector3d> axes = beam_axes(head.fan);
  std::complex<double> alike = 0;
  double all = 0;
  for (std::size_t m = 0; m < head.array.elements(); ++m) {
    const double energy = head.array.shading[m] * head.array.shading[m];
    const Eigen::Vector3d apart = axes[0] - axes[1];
    alike += energy * std::polar(1.0, -2 * pi * 100e3 / c0 * array->positions()[m].dot(apart)), all += energy;
  }
  const std::complex<double> measured = (noise.row(0) * noise.row(1).conjugate()).mean() / mean;
  EXPECT_NEAR(std::abs(measured - alike / all), 0, 0.1);
}

TEST(CurvedArrayImage, is_refused_by_engines_of_lines) {
  const SonarHead head = bent_head(10, 20, 5e3);
  const Echoes echoes = one_echo(15, {});
  std::string served;
  for (const Engine& engine : engines()) {
    if (engine.suits(head)) {
      served += std::string(engine.word) + " ";
      EXPECT_GT(synthesize(echoes, head, water, engine.method).abs2().sum(), 0) << engine.word;
      continue;
    }
    expect_error(ErrorKind::argument, {"'bent' must have a line", "direct, element-exact or incoherent"},
                 [&] { Synthesizer(head, water, engine.method); });
    EXPECT_TRUE(engine_of(engine.referee).suits(head));
    EXPECT_EQ(engine_of(engine.referee).model, engine.model);
  }
  EXPECT_EQ(served, "direct element-exact incoherent ");
  expect_error(ErrorKind::argument, {"must have a line"}, [&] { GriddedEngine(head, water, {}); });
  expect_error(ErrorKind::argument, {"must have a line"}, [&] { TrueDelayEngine(head, water, {}); });
  expect_error(ErrorKind::argument, {"must have a line"}, [&] { CellSynthesizer(head, water); });
  expect_error(ErrorKind::argument, {"this head has a curved array"},
               [&] { half_aperture(head, ApertureSide::port, "test"); });
  Echoes flat = echoes;
  flat.v.clear();
  expect_error(ErrorKind::argument, {"directions upwards (v)"},
               [&] { synthesize(flat, head, water, SynthesisMethod::direct); });
}

}  // namespace insonify::curved_array_tests
