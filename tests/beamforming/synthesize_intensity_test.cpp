// SPDX-License-Identifier: BSD-3-Clause
#include "beamforming/synthesize_intensity.hpp"

#include "beamforming/head_patterns.hpp"
#include "core/random.hpp"
#include "sonar/sonar_spec.hpp"
#include "support/heads.hpp"
#include "support/test.hpp"

namespace {

SonarSpec intensity_spec(std::size_t beams = 16) {
  SonarSpec s;
  s.name = "test";
  s.centre_frequency = 600e3, s.bandwidth = 30e3;
  s.beams = beams, s.field_of_view = radians(40);
  s.beam_width = radians(3), s.elevation_width = radians(20);
  s.min_range = 2, s.max_range = 3;
  return s;
}

SonarHead line() { return make_head(intensity_spec(), c0); }

SonarHead long_line() {
  SonarSpec s = intensity_spec();
  s.max_range = 6;
  return make_head(s, c0);
}

SonarHead sweep() {
  SonarHead head = line();
  head.pulse.shape = PulseShape::linear_fm;
  head.pulse.duration = 40 / head.pulse.bandwidth;
  return head;
}

/// Returns an absorption of 40 dB over the gate, with slope and curvature of a like size over the band.
Medium water_of_order(int order) {
  const double a0 = 20 * nepers_per_db;
  return {c0, {a0, order < 1 ? 0 : 2 * a0 / 600e3, order < 2 ? 0 : 2 * a0 / (600e3 * 30e3)}};
}

/// Returns echoes in and around fan and gate with complex normal amplitudes.
Echoes intensity_echoes(const SonarHead& head, std::size_t count, bool moving = false) {
  Echoes e;
  const double length = head.gate.max_range - head.gate.min_range;
  for (std::size_t i = 0; i < count; ++i) {
    const auto at = random_uniform(5, RandomStage::scene_points, {i, 0, 0});
    e.delay.push_back(2 * (head.gate.min_range + length * (1.02 * at[0] - 0.01)) / c0);
    e.u.push_back(0.8 * at[1] - 0.4);
    e.v.push_back(0.5 * at[2] - 0.25);
    e.amplitude.push_back(random_complex_normal(5, RandomStage::noise, {i, 0, 0}));
    if (moving) e.doppler.push_back(4000 * at[3] - 2000);
  }
  return e;
}

/// Returns the sum of (|A|^2 |B|^2 |G|^2)^power, term by term.
Grid<double> by_definition(const Echoes& e, const SonarHead& head, const Medium& medium, int power = 1) {
  Grid<double> sum = Grid<double>::Zero(head.fan.beams(), head.gate.bins());
  const double wavelength = c0 / head.pulse.centre_frequency;
  const EchoShapes shapes(head.pulse, medium);
  const bool rows = fan_rows(head.fan).size() > 1;
  for (std::size_t b = 0; b < head.fan.beams(); ++b) {
    const double u_b = std::cos(head.fan.elevation[b]) * std::sin(head.fan.azimuth[b]);
    RowResponse row(head, wavelength, head.fan.elevation[b]);
    for (std::size_t i = 0; i < e.size(); ++i) {
      const EchoEnvelope envelope = shapes.of(e.delay[i], e.doppler_of(i));
      const double response =
          array_response(head.array, wavelength, e.u[i], u_b).real() * (rows || head.column ? row.at(e.v[i]) : 1);
      for (std::size_t n = 0; n < head.gate.bins(); ++n) {
        const double g = std::abs(envelope.at(2 * head.gate.centre(n) / c0 - e.delay[i]));
        sum(b, n) += std::pow(std::norm(e.amplitude[i]) * response * response * g * g, power);
      }
    }
  }
  return sum;
}

double relative_l2(const Grid<double>& a, const Grid<double>& b) {
  return std::sqrt((a - b).square().sum() / b.square().sum());
}

}  // namespace

TEST(SynthesizeIntensity, is_the_sum_of_squares_to_the_square_of_the_tolerance) {
  for (const std::size_t beams : {1u, 16u})
    for (const int order : {0, 1, 2})
      for (const double tolerance : {1e-2, 1e-4, 1e-6}) {
        SonarHead head = make_head(intensity_spec(beams), c0);
        if (beams == 1) head.array = {head.array.spacing, {0.7, 1.6, 0.7}};  // odd; the other one is even
        const Medium medium = water_of_order(order);
        const Echoes echoes = intensity_echoes(head, 150, order == 2);
        EXPECT_LT(relative_l2(synthesize_intensity(echoes, head, medium, {.tolerance = tolerance}),
                              by_definition(echoes, head, medium)),
                  tolerance * tolerance)
            << beams << " beams, order " << order << ", tolerance " << tolerance;
      }
}

TEST(SynthesizeIntensity, of_a_sweep_is_the_sum_of_squares) {
  const SonarHead head = sweep();
  for (const int order : {0, 1}) {
    const Echoes echoes = intensity_echoes(head, 30, order == 1);
    EXPECT_LT(relative_l2(synthesize_intensity(echoes, head, water_of_order(order)),
                          by_definition(echoes, head, water_of_order(order))),
              1e-12);
  }
}

TEST(SynthesizeIntensity, gives_rows_and_columns_their_patterns) {
  SonarSpec rows = intensity_spec();
  rows.elevations = {radians(-6), radians(4)};
  SonarSpec planar = rows;
  planar.column_beam_width = radians(8);
  for (const SonarSpec& s : {rows, planar}) {
    const SonarHead head = make_head(s, c0);
    const Echoes echoes = intensity_echoes(head, 100);
    EXPECT_LT(relative_l2(synthesize_intensity(echoes, head, water_of_order(0)),
                          by_definition(echoes, head, water_of_order(0))),
              1e-6);
  }
}

/// With unit amplitudes and random phases abs(P)^2 has the mean I and the variance I^2 - sum w^2.
TEST(SynthesizeIntensity, is_the_mean_over_random_phases_within_its_statistical_error) {
  constexpr int draws = 400;
  const SonarHead head = long_line();
  const Medium medium{c0, {}};
  Echoes echoes = intensity_echoes(head, 4000);
  for (auto& a : echoes.amplitude) a = 1;
  const Grid<double> expected = synthesize_intensity(echoes, head, medium);
  const Grid<double> variance = expected.square() - by_definition(echoes, head, medium, 2);
  Grid<double> mean = Grid<double>::Zero(expected.rows(), expected.cols());
  for (std::uint64_t draw = 0; draw < draws; ++draw) {
    for (std::size_t i = 0; i < echoes.size(); ++i) {
      const auto xi = random_complex_normal(draw, RandomStage::surface_amplitude, {i, 0, 0});
      echoes.amplitude[i] = xi / std::abs(xi);
    }
    mean += synthesize_gridded(echoes, head, medium).abs2() / draws;
  }
  double squares = 0, cells = 0, worst = 0;
  for (Eigen::Index k = 0; k < mean.size(); ++k) {
    const double w = expected.data()[k], spread = std::sqrt(variance.data()[k] / draws);
    if (!(variance.data()[k] > 0.3 * w * w)) continue;  // cells of one echo do not fluctuate
    const double z = (mean.data()[k] - w) / spread;
    squares += z * z, worst = std::max(worst, std::abs(z)), ++cells;
  }
  EXPECT_GT(cells, 3000);
  EXPECT_NEAR(squares / cells, 1, 0.15);  // some 1000 of the cells are independent: 0.05
  EXPECT_LT(worst, 6);                    // means of 400 exponentials have longer tails than a normal number
}

TEST(SynthesizeIntensity, as_a_method_gives_its_root_as_a_real_pressure) {
  const SonarHead head = line();
  const Echoes echoes = intensity_echoes(head, 50);
  const ComplexGrid p = synthesize(echoes, head, water_of_order(0), SynthesisMethod::incoherent);
  EXPECT_TRUE((p.imag() == 0).all());
  EXPECT_TRUE((p.real() == synthesize_intensity(echoes, head, water_of_order(0)).sqrt()).all());
}

TEST(SynthesizeIntensity, does_not_depend_on_the_number_of_threads) {
  for (const SonarHead& head : {line(), sweep()}) {
    const Echoes echoes = intensity_echoes(head, 60);
    const Grid<double> one = synthesize_intensity(echoes, head, water_of_order(0), {.threads = 1});
    for (const int threads : {2, 7})
      EXPECT_TRUE((synthesize_intensity(echoes, head, water_of_order(0), {.threads = threads}) == one).all());
  }
}
