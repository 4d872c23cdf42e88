// SPDX-License-Identifier: BSD-3-Clause
#include "beamforming/head_patterns.hpp"
#include "beamforming/synthesize.hpp"
#include "beamforming/synthesize_noise.hpp"
#include "core/random.hpp"
#include "sonar/shading.hpp"
#include "support/heads.hpp"
#include "support/test.hpp"

namespace {

constexpr double wavelength_750k = c0 / 750e3;
const Medium planar_medium{c0, {0.02, 0, 0}};

LineArray taylor(std::size_t elements) { return {wavelength_750k / 2, taylor_shading(elements, -30)}; }
LineArray uniform(std::size_t elements) { return {wavelength_750k / 2, uniform_shading(elements)}; }

/// Returns a head of beams x rows over 40 x 30 degrees.
SonarHead stacked_head(std::size_t beams, std::size_t rows, double elevation_width = radians(60)) {
  SonarHead head;
  head.pulse = {750e3, 60e3, 220};
  head.gate = {1, 3, default_bin_size(head.pulse, c0)};
  head.array = taylor(24);
  head.fan.beam_width = array_beam_width(head.array, wavelength_750k), head.fan.elevation_width = elevation_width;
  const std::vector<double> azimuth = make_fan(beams, radians(40), 1, 1).azimuth;
  for (const double elevation : make_fan(rows, radians(30), 1, 1).azimuth)
    for (const double a : azimuth) head.fan.azimuth.push_back(a), head.fan.elevation.push_back(elevation);
  return head;
}

SonarHead planar_head(std::size_t beams, std::size_t rows, const LineArray& column = taylor(17)) {
  SonarHead head = stacked_head(beams, rows);
  head.elevation_shape = ElevationShape::sector;
  head.column = column;
  head.fan.row_width = array_beam_width(column, wavelength_750k);
  return head;
}

Echoes planar_echoes(std::size_t n, double most_v = 0.4) {
  Echoes e;
  for (std::uint64_t i = 0; i < n; ++i) {
    const auto x = random_uniform(3, RandomStage::scene_points, {i, 0, 0});
    const auto y = random_uniform(4, RandomStage::scene_points, {i, 0, 0});
    e.delay.push_back(2 * (0.9 + 2.2 * x[0]) / c0);
    e.u.push_back(-0.6 + 1.2 * x[1]);
    e.v.push_back(most_v * (2 * y[0] - 1));
    e.amplitude.push_back(std::polar(std::pow(10, -2 * x[2]), 2 * pi * x[3]));
  }
  return e;
}

/// Returns one echo at the centre of bin 100, amplitude 1.
Echoes one_echo(const SonarHead& head, double u, double v) { return {{2 * head.gate.centre(100) / c0}, {u}, {1}, {v}}; }

const SynthesisMethod methods[] = {SynthesisMethod::gridded, SynthesisMethod::direct, SynthesisMethod::spectrum};

}  // namespace

// Reference: the sum over all elements of the planar array, shaded by the product of the weights.
TEST(PlanarArray, response_is_the_double_sum_over_all_elements) {
  const SonarHead head = planar_head(7, 5);
  const std::size_t ny = head.array.elements(), nz = head.column->elements();
  for (const auto& [u, v] : {std::pair{0.0, 0.0}, {0.13, -0.07}, {-0.4, 0.33}}) {
    const ComplexGrid p = synthesize(one_echo(head, u, v), head, planar_medium, SynthesisMethod::direct);
    const double gain = std::exp(-2 * planar_medium.absorption.a0 * head.gate.centre(100));
    for (std::size_t b = 0; b < head.fan.beams(); ++b) {
      const double u_b = std::cos(head.fan.elevation[b]) * std::sin(head.fan.azimuth[b]);
      const double v_b = std::sin(head.fan.elevation[b]);
      std::complex<double> sum = 0;
      for (std::size_t m = 0; m < ny; ++m)
        for (std::size_t k = 0; k < nz; ++k)
          sum += head.array.shading[m] * head.column->shading[k] *
                 std::polar(1.0, pi * (element_position(m, ny) * (u - u_b) + element_position(k, nz) * (v - v_b)));
      EXPECT_LT(std::abs(p(b, 100) - gain * sum / static_cast<double>(ny * nz)), 1e-13) << "beam " << b;
    }
  }
}

// A uniform half-wavelength_750k array of N elements is 3 dB down where its sinc is: 0.88589 / N off in u, and in v.
TEST(PlanarArray, beams_have_their_closed_form_width_both_ways) {
  SonarHead head = planar_head(1, 1, uniform(40));
  head.array = uniform(64);
  const auto level = [&](double u, double v) {
    return std::norm(synthesize(one_echo(head, u, v), head, {c0, {}}, SynthesisMethod::direct)(0, 100));
  };
  EXPECT_NEAR(level(0, 0), 1, 1e-12);
  for (const double side : {-1, 1}) {
    EXPECT_NEAR(level(side * 0.885893 / 64, 0), 0.5, 1e-3);
    EXPECT_NEAR(level(0, side * 0.885893 / 40), 0.5, 1e-3);
  }
}

TEST(PlanarArray, finds_a_target_in_its_beam_with_the_level_of_the_sonar_equation) {
  const SonarHead head = planar_head(9, 7);
  const std::size_t beam = 5 * 9 + 2;  // row 5, beam 2 of it
  Scatterers s;
  const double r = head.gate.centre(200), ts = -25;
  s.range = {r}, s.azimuth = {head.fan.azimuth[beam]}, s.elevation = {head.fan.elevation[beam]};
  const std::vector<double> sigma{power_from_db(ts)};
  const std::vector<std::complex<double>> xi{1};
  const Echoes echoes = target_echoes(s, sigma, xi, head.pulse, planar_medium, with_patterns({}, head));
  const double loss = 20 * std::log10(r) + planar_medium.absorption.a0 / nepers_per_db * r;
  for (const SynthesisMethod method : methods) {
    const ComplexGrid p = synthesize(echoes, head, planar_medium, method, {.tolerance = 1e-9});
    Eigen::Index row = 0, column = 0;
    const double peak = p.abs().maxCoeff(&row, &column);
    EXPECT_EQ(row, static_cast<Eigen::Index>(beam));
    EXPECT_EQ(column, 200);
    EXPECT_NEAR(pressure_level_db(peak), head.pulse.source_level_db - 2 * loss + ts, 1e-6);
  }
}

TEST(Rows, of_a_head_with_one_are_the_line_array_bit_for_bit) {
  SonarHead head = stacked_head(9, 1);
  Echoes echoes = planar_echoes(50);
  for (const bool upwards : {true, false}) {
    if (!upwards) echoes.v.clear();
    EXPECT_TRUE((synthesize(echoes, head, planar_medium, SynthesisMethod::gridded) ==
                 synthesize_gridded(echoes, head, planar_medium))
                    .all());
    EXPECT_TRUE((synthesize(echoes, head, planar_medium, SynthesisMethod::direct) ==
                 synthesize_direct(echoes, head, planar_medium))
                    .all());
    EXPECT_TRUE((synthesize(echoes, head, planar_medium, SynthesisMethod::spectrum) ==
                 synthesize_spectrum(echoes, head, planar_medium))
                    .all());
  }
}

// Each row is equivalent to a separate head with its own elevation pattern.
TEST(Rows, of_a_head_without_column_are_tilted_heads_bit_for_bit) {
  const SonarHead head = stacked_head(6, 4);
  const Echoes echoes = planar_echoes(80);
  const ComplexGrid p = synthesize(echoes, head, planar_medium, SynthesisMethod::gridded);
  for (const FanRow& row : fan_rows(head.fan)) {
    SonarHead tilted = head;
    tilted.fan = make_fan(6, radians(40), head.fan.beam_width, head.fan.elevation_width, row.elevation);
    Echoes weighted = echoes;
    for (std::size_t i = 0; i < weighted.size(); ++i)
      weighted.amplitude[i] *=
          elevation_response(head.elevation_shape, head.fan.elevation_width, std::asin(echoes.v[i]) - row.elevation);
    const ComplexGrid line = synthesize_gridded(weighted, tilted, planar_medium);
    for (std::size_t k = 0; k < 6; ++k) EXPECT_TRUE((p.row(row.beams[k]) == line.row(k)).all());
  }
}

TEST(Rows, agree_with_tilted_heads_on_the_same_scatterers) {
  const SonarHead head = stacked_head(6, 3, radians(20));
  Scatterers s;
  std::vector<double> sigma;
  std::vector<std::complex<double>> xi;
  for (std::uint64_t i = 0; i < 40; ++i) {
    const auto x = random_uniform(5, RandomStage::scene_points, {i, 0, 0});
    s.range.push_back(1.1 + x[0]), s.azimuth.push_back(x[1] - 0.5), s.elevation.push_back(x[2] - 0.5);
    sigma.push_back(x[3]), xi.emplace_back(1);
  }
  const auto received_by = [&](const SonarHead& some) {
    return synthesize(target_echoes(s, sigma, xi, some.pulse, planar_medium, with_patterns({}, some)), some,
                      planar_medium, SynthesisMethod::direct);
  };
  const ComplexGrid all = received_by(head);
  for (const FanRow& row : fan_rows(head.fan)) {
    SonarHead tilted = head;
    tilted.fan = make_fan(6, radians(40), head.fan.beam_width, head.fan.elevation_width, row.elevation);
    EXPECT_LT(relative_l2(all.middleRows(row.beams[0], 6), received_by(tilted)), 1e-12);
  }
}

TEST(Rows, of_an_irregular_table_do_not_depend_on_the_order_of_the_beams) {
  SonarHead head = planar_head(1, 1), turned = head;
  head.fan.azimuth = {0.1, -0.2, 0.3, 0.05, -0.1}, head.fan.elevation = {0.1, -0.1, 0.1, 0.02, -0.1};
  turned.fan = head.fan;
  std::reverse(turned.fan.azimuth.begin(), turned.fan.azimuth.end());
  std::reverse(turned.fan.elevation.begin(), turned.fan.elevation.end());
  const Echoes echoes = planar_echoes(30);
  const ComplexGrid p = synthesize(echoes, head, planar_medium, SynthesisMethod::direct);
  EXPECT_TRUE((synthesize(echoes, turned, planar_medium, SynthesisMethod::direct).colwise().reverse() == p).all());
}

// A mirrored scene gives the mirrored image: port to starboard, and top to bottom.
TEST(PlanarArray, gives_the_mirrored_image_of_a_mirrored_scene) {
  const SonarHead head = planar_head(6, 4);
  const Echoes echoes = planar_echoes(60);
  Echoes across = echoes, upside_down = echoes;
  for (double& u : across.u) u = -u;
  for (double& v : upside_down.v) v = -v;
  const ComplexGrid p = synthesize(echoes, head, planar_medium, SynthesisMethod::direct);
  const ComplexGrid left = synthesize(across, head, planar_medium, SynthesisMethod::direct);
  const ComplexGrid down = synthesize(upside_down, head, planar_medium, SynthesisMethod::direct);
  ComplexGrid left_back(p.rows(), p.cols()), down_back(p.rows(), p.cols());
  for (int row = 0; row < 4; ++row)
    for (int b = 0; b < 6; ++b) {
      left_back.row(6 * row + b) = left.row(6 * row + 5 - b);
      down_back.row(6 * row + b) = down.row(6 * (3 - row) + b);
    }
  EXPECT_LT(relative_l2(left_back, p), 1e-12);
  EXPECT_LT(relative_l2(down_back, p), 1e-12);
  EXPECT_GT(relative_l2(left, p), 0.1);
}

// Rows 10 degrees apart: narrow patterns of their own (most echoes are omitted from most rows), the column's side
// lobes, and a scene entirely above all rows.
TEST(Synthesize, of_rows_keeps_its_tolerance_against_the_referee) {
  for (const SonarHead& head : {stacked_head(8, 4, radians(6)), stacked_head(8, 4), planar_head(8, 4)})
    for (const bool above : {false, true}) {
      Echoes echoes = planar_echoes(300);
      if (above)
        for (double& v : echoes.v) v = 0.45 + 0.3 * v;
      const ComplexGrid exact = synthesize(echoes, head, planar_medium, SynthesisMethod::direct);
      for (const double tolerance : {1e-1, 1e-2, 1e-4, 1e-6, 1e-9, 1e-12})
        EXPECT_LT(
            relative_l2(synthesize(echoes, head, planar_medium, SynthesisMethod::gridded, {.tolerance = tolerance}),
                        exact),
            tolerance)
            << "above: " << above << ", width " << degrees(head.fan.elevation_width);
    }
}

TEST(WithPatterns, gives_direct_echoes_its_part_and_no_more) {
  SonarHead line = stacked_head(4, 1);
  line.fan.elevation.assign(4, -0.2);
  line.transmit_width = 0.9;
  const EchoOptions of_line = with_patterns({.seed = 7}, line);
  EXPECT_EQ(of_line.elevation_width, line.fan.elevation_width);
  EXPECT_EQ(of_line.elevation_centre, -0.2);
  EXPECT_EQ(of_line.transmit_width, 0.9);
  EXPECT_EQ(of_line.seed, 7U);
  EXPECT_EQ(with_patterns({}, stacked_head(4, 3)).elevation_width, 0);
  SonarHead planar = planar_head(4, 3);
  for (double& elevation : planar.fan.elevation) elevation += 0.1;
  const EchoOptions of_planar = with_patterns({}, planar);
  EXPECT_EQ(of_planar.elevation_width, planar.fan.elevation_width);
  EXPECT_EQ(of_planar.elevation_shape, ElevationShape::sector);
  EXPECT_NEAR(of_planar.elevation_centre, 0.1, 1e-12);
}

// Rows from -10 to 10 degrees. A transmitter of 60 degrees fills +-30: 20 degrees beyond the outermost rows.
TEST(SampledHalfExtent, reaches_as_far_as_the_transmitter) {
  EXPECT_NEAR(sampled_half_extent(planar_head(4, 3), -40), radians(20), 1e-12);
  const SonarHead stacked = stacked_head(4, 3);
  EXPECT_EQ(sampled_half_extent(stacked, -40),
            elevation_half_extent(ElevationShape::gaussian, stacked.fan.elevation_width, -40));
  SonarHead narrow = planar_head(4, 3);
  narrow.fan.elevation_width = radians(5);
  EXPECT_EQ(sampled_half_extent(narrow, -40), narrow.fan.row_width);
}

// Integral of the power pattern over the sphere by midpoints in v and in azimuth.
TEST(DirectivityIndex, of_a_planar_array_is_that_of_its_pattern_over_the_sphere) {
  SonarHead head = planar_head(1, 1, taylor(6));
  head.array = taylor(9);
  head.column->spacing = 0.7 * wavelength_750k;
  double integral = 0;
  constexpr int n = 400;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const double v = -1 + 2 * (i + 0.5) / n, azimuth = 2 * pi * (j + 0.5) / n;
      const double u = std::sqrt(1 - v * v) * std::sin(azimuth);
      const double b = array_response(head.array, wavelength_750k, u, 0).real() *
                       array_response(*head.column, wavelength_750k, v, 0).real();
      integral += b * b * (2.0 / n) * (2 * pi / n);
    }
  EXPECT_NEAR(directivity_index_db(head, wavelength_750k), 10 * std::log10(4 * pi / integral), 1e-3);
}

TEST(DirectivityIndex, of_planar_arrays_has_its_closed_forms) {
  SonarHead head = planar_head(1, 1, uniform(1));
  EXPECT_NEAR(directivity_index_db(head, wavelength_750k), directivity_index_db(head.array, wavelength_750k), 1e-9);
  head.column.reset();
  EXPECT_EQ(directivity_index_db(head, wavelength_750k), directivity_index_db(head.array, wavelength_750k));
  // Large and uniform: 4 pi area / lambda^2 to the front alone, half of that with the image behind.
  head.column = head.array = uniform(128);
  EXPECT_NEAR(directivity_index_db(head, wavelength_750k), 10 * std::log10(128 * 128 * pi / 2), 0.05);
  EXPECT_NEAR(array_gain_db(head), 20 * std::log10(128), 1e-9);
}

TEST(SynthesizeNoise, of_a_planar_array_is_the_element_level_less_its_gain) {
  const SonarHead head = planar_head(2, 3);
  const double level = 60;
  const ComplexGrid p = synthesize_noise(head, {c0, {}}, level);
  EXPECT_NEAR(pressure_level_db(std::sqrt(p.abs2().mean())), level - array_gain_db(head), 0.5);
}

// Independent elements: beams of two rows share noise as far as the column's beams overlap, beams of one row as far as
// the row's do. 3600 bins scatter by 0.02.
TEST(SynthesizeNoise, of_two_rows_is_correlated_by_the_response_of_the_column) {
  SonarHead head = planar_head(1, 1, uniform(12));
  head.array = uniform(10);
  head.gate.max_range = 21;
  head.fan.azimuth = {0, 0, 0, 0.1}, head.fan.elevation = {0, radians(4), radians(8), radians(4)};
  const ComplexGrid p = synthesize_noise(head, {c0, {}}, 60);
  const auto correlation = [&](int a, int b) {
    return (p.row(a) * p.row(b).conjugate()).sum() / std::sqrt(p.row(a).abs2().sum() * p.row(b).abs2().sum());
  };
  const auto up = [&](double elevation) {
    return array_response(*head.column, wavelength_750k, std::sin(elevation), 0).real();
  };
  EXPECT_LT(std::abs(correlation(0, 1) - up(radians(4))), 0.08);
  EXPECT_LT(std::abs(correlation(0, 2) - up(radians(8))), 0.08);
  const double across = array_response(head.array, wavelength_750k, std::cos(radians(4)) * std::sin(0.1), 0).real();
  EXPECT_LT(std::abs(correlation(1, 3) - across), 0.08);
  EXPECT_LT(std::abs(correlation(0, 3) - up(radians(4)) * across), 0.08);
}

TEST(SynthesizeNoise, of_rows_without_column_is_independent_and_that_of_the_first_row_unchanged) {
  SonarHead two = stacked_head(2, 2), one = two;
  two.gate.max_range = one.gate.max_range = 11;
  one.fan.azimuth.resize(2), one.fan.elevation.resize(2);
  const ComplexGrid p = synthesize_noise(two, {c0, {}}, 60), q = synthesize_noise(one, {c0, {}}, 60);
  EXPECT_TRUE((p.topRows(2) == q).all());
  const auto shared = (p.row(0) * p.row(2).conjugate()).sum() / p.row(0).abs2().sum();
  EXPECT_LT(std::abs(shared), 0.1);
}

TEST(SynthesizeNoise, of_a_planar_array_does_not_depend_on_threads) {
  const SonarHead head = planar_head(3, 4);
  const ComplexGrid p = synthesize_noise(head, {c0, {}}, 60, {.threads = 1});
  for (const int threads : {2, 7}) EXPECT_TRUE((synthesize_noise(head, {c0, {}}, 60, {.threads = threads}) == p).all());
}

TEST(Synthesize, of_rows_names_what_is_wrong) {
  SonarHead head = planar_head(3, 2);
  Echoes echoes = planar_echoes(5);
  head.name = "flat";
  EXPECT_EQ(error_of([&] { synthesize_gridded(echoes, head, planar_medium); }),
            "synthesize_gridded: head 'flat' has 2 rows of beams and a column, must be one row of a line array; use "
            "synthesize");
  EXPECT_THAT(error_of([&] { synthesize_direct(echoes, stacked_head(3, 2), planar_medium); }),
              HasSubstr("has 2 rows of beams, must be one row of a line array; use synthesize"));
  echoes.v[3] = std::nan("");
  EXPECT_THAT(error_of([&] { synthesize(echoes, head, planar_medium, SynthesisMethod::gridded); }),
              HasSubstr("synthesize: echo 3 has v nan"));
  echoes.v.clear();
  EXPECT_EQ(
      error_of([&] { synthesize(echoes, head, planar_medium, SynthesisMethod::direct); }),
      "synthesize: echoes have 5 delays and 0 directions upwards (v), must be one of each for a head with several rows "
      "of beams");
}

TEST(RequireValid, of_a_planar_head_names_what_is_wrong) {
  const auto error_with = [](auto&& spoil) {
    SonarHead head = planar_head(3, 2);
    spoil(head);
    return error_of([&] { require_valid(head, "test"); });
  };
  EXPECT_EQ(error_with([](SonarHead& h) { h.fan.row_width = 0; }),
            "test: fan.row_width = 0, must be the width of the column's beam");
  EXPECT_THAT(error_with([](SonarHead& h) { h.column.reset(); }), HasSubstr("must be 0 for a head without column"));
  EXPECT_EQ(error_with([](SonarHead& h) { h.column->spacing = 0; }), "test: array.spacing = 0 m, must be > 0 (column)");
  EXPECT_THAT(error_with([](SonarHead& h) { h.fan.row_width = -1; }), HasSubstr("fan.row_width = -1 rad"));
  EXPECT_THAT(error_with([](SonarHead& h) { h.transmit_width = -0.1; }), HasSubstr("transmit_width"));
  EXPECT_THAT(error_with([](SonarHead& h) { h.array = uniform(1 << 16), h.column = uniform(1 << 13); }),
              HasSubstr("65536 columns of 8192 elements, must be at most 2^28 in all"));
}
