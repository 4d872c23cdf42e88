// SPDX-License-Identifier: BSD-3-Clause
// Tests display cells without samples (E180 to E184): expected intensities against sums from the definition, statistics
// against closed forms and against averaged samples of element_exact.
#include "beamforming/synthesize_cells.hpp"

#include "acoustics/direct_echoes.hpp"
#include "beamforming/synthesize.hpp"
#include "core/random.hpp"
#include "returns/looks.hpp"
#include "support/errors.hpp"
#include "support/heads.hpp"
#include "support/test.hpp"

namespace insonify::cell_tests {

constexpr double bandwidth = 60e3, centre = 750e3;
const Medium lossy{1490, {0.02, 2e-8, 1e-14}}, lossless{1490, {}};

SonarHead samples_head(std::size_t beams = 9, std::size_t elements = 32) {
  return line_head({.beams = beams, .elements = elements, .field_of_view_deg = 100, .min_range = 2, .max_range = 3});
}

SonarHead cells_head(SonarHead head, int cells) {
  head.gate = display_gate(head.gate, cells);
  return head;
}

/// Returns echoes evenly over range 1.9 to 3.1 m and all u, of unit mean power [Pa^2].
SurfaceEchoes even_ground(std::size_t count, std::uint64_t seed = 1) {
  SurfaceEchoes s;
  for (std::size_t i = 0; i < count; ++i) {
    const auto at = random_uniform(seed, RandomStage::scene_points, {i, 0, 0});
    const double range = 1.9 + 1.2 * at[0];
    s.echoes.delay.push_back(2 * range / lossy.sound_speed);
    s.echoes.u.push_back(2 * at[1] - 1);
    s.echoes.amplitude.push_back(std::polar(1.0, 4 * pi * range * centre / lossy.sound_speed));
    s.id.push_back(i);
  }
  s.power.assign(count, 1), s.depth.assign(count, 0), s.width.assign(count, 0);
  return s;
}

/// Returns the echoes with the random amplitudes of a seed.
Echoes drawn(const SurfaceEchoes& s, std::uint64_t seed) {
  Echoes echoes = s.echoes;
  std::vector<double> re(s.id.size()), im(s.id.size());
  random_amplitudes(seed, s.id, re.data(), im.data());
  for (std::size_t i = 0; i < re.size(); ++i) echoes.amplitude[i] *= std::complex(re[i], im[i]);
  return echoes;
}

/// Returns the cells by their definition: sums over echoes, frequencies of the pulse and ranges in fine steps.
Grid<double> cells_by_definition(const SurfaceEchoes& s, const SonarHead& head, const Medium& water) {
  const double c = water.sound_speed, wavelength = c / head.pulse.centre_frequency;
  const EchoShapes shapes(head.pulse, water);
  Grid<double> sum =
      Grid<double>::Zero(static_cast<Eigen::Index>(head.fan.beams()), static_cast<Eigen::Index>(head.gate.bins()));
  for (std::size_t i = 0; i < s.id.size(); ++i) {
    const double range = 0.5 * c * s.echoes.delay[i];
    const EchoEnvelope g = shapes.of(s.echoes.delay[i]);
    Eigen::ArrayXd in_cell = Eigen::ArrayXd::Zero(sum.cols());
    const double step = 1e-4;
    for (double r = range - 0.05; r < range + 0.05; r += step) {
      const double cell = (r - head.gate.min_range) / head.gate.bin_size;
      if (cell < 0 || cell >= static_cast<double>(sum.cols())) continue;
      const double middle = head.gate.centre(static_cast<std::size_t>(cell));
      in_cell[static_cast<Eigen::Index>(cell)] +=
          std::norm(g.at(2 * (r - range) / c)) * step / head.gate.bin_size * r / middle;
    }
    // |G(f)|^2 after absorption: a Gaussian that slope shifts and curvature narrows.
    const double a = 2 * std::numbers::ln2 / (bandwidth * bandwidth) + 2 * water.absorption.a2 * range;
    const double b = 2 * water.absorption.a1 * range;
    for (Eigen::Index beam = 0; beam < sum.rows(); ++beam) {
      const auto k = static_cast<std::size_t>(beam);
      const double u_beam = std::cos(head.fan.elevation[k]) * std::sin(head.fan.azimuth[k]);
      double response = 0, weights = 0;
      for (double f = -1.5 * bandwidth; f <= 1.5 * bandwidth; f += 1000) {
        const double weight = std::exp(-2 * (a * f * f + b * f));
        const double x = (1 + f / head.pulse.centre_frequency) * (s.echoes.u[i] - u_beam);
        response += weight * std::norm(array_response(head.array, wavelength, x, 0)), weights += weight;
      }
      sum.row(beam) += std::norm(s.echoes.amplitude[i]) * response / weights * in_cell.transpose();
    }
  }
  return sum;
}

/// Returns M = T^2 / integral of the squared correlation over the cell, 2^(-2 (x / L)^2) for a Gaussian pulse.
double looks_of_even_ground(const SonarHead& head) {
  const double length = head.gate.bin_size, l = 0.4413 * c0_cold / (2 * bandwidth);
  double overlap = 0;
  for (double x = 0.5e-5; x < length; x += 1e-5) overlap += 2e-5 * (length - x) * std::exp2(-2 * x * x / (l * l));
  return length * length / overlap;
}

double worst_db(const Grid<double>& a, const Grid<double>& b) { return (10 * (a / b).log10()).abs().maxCoeff(); }

TEST(DisplayCells, expected_are_the_energies_of_the_definition) {
  const SonarHead head = cells_head(samples_head(), 20);
  const SurfaceEchoes ground = even_ground(3000);
  const Grid<double> cells = synthesize_cells(ground, {}, head, lossy, {.speckle = false});
  const Grid<double> exact = cells_by_definition(ground, head, lossy);
  // Pulses are boxes of their variance: what stands within a pulse of an edge may be in the cell beside.
  EXPECT_LT(worst_db(cells, exact), 0.35);
  EXPECT_LT(worst_db(cells.rowwise().sum(), exact.rowwise().sum()), 0.02);
  EXPECT_LT(worst_db(cells.colwise().sum(), exact.colwise().sum()), 0.2);
}

TEST(DisplayCells, grating_lobes_are_those_of_the_band) {
  // Elements 0.7 wavelengths apart: the lobe of an echo at u = -0.75 stands at 0.68 at the centre, elsewhere at others.
  SonarHead head = cells_head(samples_head(33), 4);
  head.array.spacing = 0.7 * lossy.sound_speed / centre;
  SurfaceEchoes one = even_ground(1);
  one.echoes.u[0] = -0.75, one.echoes.delay[0] = 2 * 2.4 / lossy.sound_speed;
  // Absorption moves the middle of the band by a tenth of its width.
  const Medium steep{lossy.sound_speed, {0.3, 8e-7, 0}};
  const Grid<double> cells = synthesize_cells(one, {}, head, steep, {.speckle = false});
  const Grid<double> exact = cells_by_definition(one, head, steep);
  const double peak = exact.maxCoeff();
  for (Eigen::Index b = 0; b < cells.rows(); ++b)
    if (exact.row(b).sum() > 1e-2 * peak) {
      EXPECT_NEAR(db_from_power(cells.row(b).sum() / exact.row(b).sum()), 0, 0.15) << b;
    }
  EXPECT_GT(exact.rightCols(3).bottomRows(8).maxCoeff(), 0.1 * peak) << "there is a lobe";
}

/// Returns how much of the energy of echoes in a cell far beside a beam the beam hears in the cells around, and in all;
/// drawn: in display cells, else in means of samples, echo by echo.
std::array<double, 6> heard_around(const SurfaceEchoes& s, SonarHead samples, bool drawn) {
  const SonarHead head = cells_head(samples, 20);
  Grid<double> cells = Grid<double>::Zero(1, 20);
  if (drawn) cells = synthesize_cells(s, {}, head, lossless, {.speckle = false});
  samples.gate.bin_size /= 4;
  for (std::size_t i = 0; i < s.id.size() && !drawn; ++i) {
    Echoes one;
    one.delay = {s.echoes.delay[i]}, one.u = {s.echoes.u[i]}, one.amplitude = {s.echoes.amplitude[i]};
    const ComplexGrid p = synthesize(one, samples, lossless, SynthesisMethod::element_exact);
    cells += mean_over_cells(p.abs2(), samples.gate, head.gate);
  }
  return {cells(0, 8), cells(0, 9), cells(0, 10), cells(0, 11), cells(0, 12), cells.sum()};
}

TEST(DisplayCells, grating_lobes_stand_at_the_ranges_of_the_elements) {
  // One beam at u = 0.68, on an array of 0.18 m whose elements are 0.7 wavelengths apart: it hears what is at u = -0.75
  // up to 6 cm before and behind its range, in cells of 5 cm.
  SonarHead samples = samples_head(1, 128);
  samples.array.spacing = 0.7 * lossy.sound_speed / centre;
  samples.fan.azimuth[0] = std::asin(0.68);
  SurfaceEchoes s = even_ground(60);
  for (std::size_t i = 0; i < s.id.size(); ++i) {
    const auto at = random_uniform(9, RandomStage::scene_points, {i, 0, 0});
    s.echoes.delay[i] = 2 * (2.5 + 0.05 * (static_cast<double>(i) + at[0]) / 60) / lossy.sound_speed;
    s.echoes.u[i] = -0.75 + 0.02 * at[1];
  }
  const std::array<double, 6> cells = heard_around(s, samples, true), exact = heard_around(s, samples, false);
  EXPECT_NEAR(db_from_power(cells[5] / exact[5]), 0, 0.15);
  EXPECT_LT(exact[2], 0.7 * exact[5]) << "energy stands in other cells";
  for (std::size_t k = 0; k < 5; ++k) EXPECT_NEAR(cells[k] / cells[5], exact[k] / exact[5], 0.05) << k;
}

TEST(DisplayCells, surfaces_are_spread_over_their_extent) {
  const SonarHead head = cells_head(samples_head(), 20);
  SurfaceEchoes one = even_ground(1), many = even_ground(40000);
  one.echoes.u[0] = 0.1, one.echoes.delay[0] = 2 * 2.512 / lossy.sound_speed;
  one.depth[0] = 0.2f, one.width[0] = 0.3f;
  for (std::size_t i = 0; i < many.id.size(); ++i) {
    const auto at = random_uniform(3, RandomStage::scene_points, {i, 0, 0});
    many.echoes.delay[i] = 2 * (2.512 + 0.2 * (2 * at[0] - 1)) / lossy.sound_speed;
    many.echoes.u[i] = 0.1 + 0.3 * (2 * at[1] - 1);
    many.power[i] = 1 / 40000.0;
  }
  const Grid<double> a = synthesize_cells(one, {}, head, lossy, {.speckle = false});
  const Grid<double> b = synthesize_cells(many, {}, head, lossy, {.speckle = false});
  EXPECT_NEAR(db_from_power(a.sum() / b.sum()), 0, 0.1);
  EXPECT_LT(worst_db(a.block(4, 8, 2, 5), b.block(4, 8, 2, 5)), 0.5);
}

TEST(DisplayCells, of_a_tilted_surface_each_range_has_its_own_directions) {
  const SonarHead head = cells_head(samples_head(), 20);
  SurfaceEchoes one = even_ground(1), many = even_ground(40000);
  one.echoes.u[0] = 0.1, one.echoes.delay[0] = 2 * 2.512 / lossy.sound_speed;
  one.depth[0] = 0.2f, one.width[0] = 0.305f, one.slope = {1.5f}, one.across = {0.05f};
  for (std::size_t i = 0; i < many.id.size(); ++i) {
    const auto at = random_uniform(3, RandomStage::scene_points, {i, 0, 0});
    const double away = 0.2 * (2 * at[0] - 1);
    many.echoes.delay[i] = 2 * (2.512 + away) / lossy.sound_speed;
    many.echoes.u[i] = 0.1 + 1.5 * away + 0.05 * (2 * at[1] - 1);
    many.power[i] = 1 / 40000.0;
  }
  const Grid<double> a = synthesize_cells(one, {}, head, lossy, {.speckle = false});
  const Grid<double> b = synthesize_cells(many, {}, head, lossy, {.speckle = false});
  EXPECT_NEAR(db_from_power(a.sum() / b.sum()), 0, 0.1);
  // Cells with a tenth of the strongest or more.
  for (Eigen::Index i = 0; i < b.size(); ++i)
    if (b.data()[i] > 0.1 * b.maxCoeff()) {
      EXPECT_NEAR(db_from_power(a.data()[i] / b.data()[i]), 0, 0.5) << i;
    }
  one.slope.clear(), one.across.clear();
  const Grid<double> box = synthesize_cells(one, {}, head, lossy, {.speckle = false});
  EXPECT_GT(worst_db(box.block(4, 8, 2, 5), b.block(4, 8, 2, 5)), 3) << "directions matter";
}

/// Compares cells of even ground with means of samples, over many draws; within_db: of the total.
void expect_statistics_of_samples(const SonarHead& samples, SynthesisMethod method, double within_db) {
  const SonarHead head = cells_head(samples, 12);
  const SurfaceEchoes ground = even_ground(4000);
  Grid<double> mean[2], square[2];
  constexpr int seeds = 48;
  for (int seed = 1; seed <= seeds; ++seed) {
    const auto key = static_cast<std::uint64_t>(seed);
    const ComplexGrid p = synthesize(drawn(ground, key), samples, lossless, method);
    const Grid<double> images[] = {mean_over_cells(p.abs2(), samples.gate, head.gate),
                                   synthesize_cells(ground, {}, head, lossless, {.seed = key})};
    for (const int k : {0, 1}) {
      if (seed == 1) mean[k] = square[k] = Grid<double>::Zero(head.fan.beams(), head.gate.bins());
      mean[k] += images[k] / seeds, square[k] += images[k].square() / seeds;
    }
  }
  const auto contrast = [&](int k) { return std::sqrt((square[k] / mean[k].square() - 1).mean()); };
  EXPECT_NEAR(db_from_power(mean[1].sum() / mean[0].sum()), 0, within_db);
  EXPECT_NEAR(contrast(1) / contrast(0), 1, 0.06);
  const double rms = std::sqrt((10 * (mean[1] / mean[0]).log10()).square().mean());
  EXPECT_LT(rms, 4.34 * std::sqrt(2.0) * contrast(0) / std::sqrt(seeds) * 1.3 + 0.1);
}

TEST(DisplayCells, have_mean_and_contrast_of_averaged_samples) {
  expect_statistics_of_samples(samples_head(), SynthesisMethod::element_exact, 0.05);
}

TEST(DisplayCells, of_sweeps_have_mean_and_contrast_of_averaged_samples) {
  SonarHead sweep = samples_head();
  sweep.pulse.shape = PulseShape::linear_fm;
  sweep.pulse.duration = 60 / sweep.pulse.bandwidth;
  // Echoes from beyond the gate leave side lobes in it.
  expect_statistics_of_samples(sweep, SynthesisMethod::gridded, 0.1);
}

TEST(DisplayCells, looks_of_even_ground_are_those_of_the_pulse) {
  const SonarHead head = cells_head(samples_head(), 10);
  const double looks = looks_of_even_ground(head);
  double mean = 0, square = 0, n = 0;
  // The mean of 90 cells a seed, of contrast 0.29, deviates by 0.0024 over so many seeds.
  for (std::uint64_t seed = 1; seed <= 160; ++seed) {
    const SurfaceEchoes ground = even_ground(20000, seed);
    const Grid<double> expected = synthesize_cells(ground, {}, head, {c0_cold, {}}, {.speckle = false});
    const Grid<double> relative = synthesize_cells(ground, {}, head, {c0_cold, {}}, {.seed = seed}) / expected;
    mean += relative.sum(), square += relative.square().sum(), n += static_cast<double>(relative.size());
  }
  EXPECT_NEAR(mean / n, 1, 0.01);
  EXPECT_NEAR(std::sqrt(square * n / (mean * mean) - 1), 1 / std::sqrt(looks), 0.06 / std::sqrt(looks));
}

TEST(DisplayCells, an_echo_alone_is_exponential) {
  const SonarHead head = cells_head(samples_head(), 5);
  SurfaceEchoes one = even_ground(1);
  one.echoes.u[0] = 0, one.echoes.delay[0] = 2 * 2.5 / lossy.sound_speed;
  const double expected = synthesize_cells(one, {}, head, lossy, {.speckle = false})(4, 2);
  double sum = 0, square = 0;
  constexpr int seeds = 1500;
  for (int seed = 1; seed <= seeds; ++seed) {
    const double i =
        synthesize_cells(one, {}, head, lossy, {.seed = static_cast<std::uint64_t>(seed)})(4, 2) / expected;
    sum += i, square += i * i;
  }
  EXPECT_NEAR(sum / seeds, 1, 0.1);
  EXPECT_NEAR(square / seeds, 2, 0.5);
}

/// Returns even ground with two facets in each of five cells, with 45 and 25 % of the middle beam's energy there.
SurfaceEchoes ground_with_facets(const SonarHead& head) {
  SurfaceEchoes s = even_ground(4000);
  const Grid<double> ground = synthesize_cells(s, {}, head, lossless, {.speckle = false});
  for (std::size_t cell = 0; cell < 5; ++cell)
    for (const auto& [aside, part] : {std::pair(-0.05, 0.45), std::pair(0.05, 0.25)}) {
      SurfaceEchoes one = even_ground(1);
      const double range = head.gate.centre(cell) + aside;
      one.echoes.u[0] = 0, one.echoes.delay[0] = 2 * range / lossy.sound_speed;
      const double alone =
          synthesize_cells(one, {}, head, lossless, {.speckle = false})(4, static_cast<Eigen::Index>(cell));
      const double power = part / 0.3 * ground(4, static_cast<Eigen::Index>(cell)) / alone;
      s.echoes.delay.push_back(one.echoes.delay[0]), s.echoes.u.push_back(0);
      s.echoes.amplitude.push_back(std::polar(std::sqrt(power), 4 * pi * range * centre / lossy.sound_speed));
      s.id.push_back(s.id.size()), s.power.push_back(power), s.depth.push_back(0), s.width.push_back(0);
    }
  return s;
}

// Drawn as even ground alone they would be dark a third as often.
TEST(DisplayCells, of_two_bright_facets_are_dark_as_often_as_those_of_samples) {
  const SonarHead samples = samples_head(), head = cells_head(samples, 5);
  const SurfaceEchoes ground = ground_with_facets(head);
  const Grid<double> expected = synthesize_cells(ground, {}, head, lossless, {.speckle = false});
  constexpr int seeds = 300;
  double dark[] = {0, 0};
  for (int seed = 1; seed <= seeds; ++seed) {
    const auto key = static_cast<std::uint64_t>(seed);
    const ComplexGrid p = synthesize(drawn(ground, key), samples, lossless, SynthesisMethod::gridded);
    const Grid<double> images[] = {mean_over_cells(p.abs2(), samples.gate, head.gate),
                                   synthesize_cells(ground, {}, head, lossless, {.seed = key})};
    for (const int k : {0, 1})
      for (Eigen::Index cell = 0; cell < 5; ++cell) dark[k] += images[k](4, cell) < 0.4 * expected(4, cell);
  }
  const double of_samples = dark[0] / (5 * seeds), of_drawn = dark[1] / (5 * seeds);
  EXPECT_GT(of_samples, 0.05);
  EXPECT_NEAR(of_drawn, of_samples, 0.02);
}

TEST(DisplayCells, fixed_echoes_add_up_as_pressures) {
  const SonarHead head = cells_head(samples_head(), 5);
  const auto fixed = [&](std::complex<double> more) {
    Echoes e;
    for (const auto& amplitude : {std::complex<double>(1), more}) {
      e.delay.push_back(2 * 2.5 / lossy.sound_speed), e.u.push_back(0), e.amplitude.push_back(amplitude);
    }
    return synthesize_cells({}, e, head, lossy)(4, 2);
  };
  EXPECT_NEAR(fixed({1, 0}) / fixed({0, 0}), 4, 1e-6);
  EXPECT_NEAR(fixed({0, 1}) / fixed({0, 0}), 2, 1e-6);
  EXPECT_NEAR(fixed({-1, 0}) / fixed({0, 0}), 0, 1e-6);
  // Its level is that of samples: of one echo |P|^2 has no speckle.
  Echoes one;
  one.delay = {2 * 2.5 / lossy.sound_speed}, one.u = {0}, one.amplitude = {1};
  SonarHead samples = samples_head();
  samples.gate.bin_size /= 5;
  const ComplexGrid p = synthesize(one, samples, lossy, SynthesisMethod::element_exact);
  const Grid<double> exact = mean_over_cells(p.abs2(), samples.gate, head.gate);
  EXPECT_NEAR(db_from_power(synthesize_cells({}, one, head, lossy)(4, 2) / exact(4, 2)), 0, 0.05);
}

// Two cells share their transforms. In one of them stands a patch whose energy another patch has, so that it expects
// nothing: what the loud one rounds off there is no level to divide by.
TEST(DisplayCells, a_cell_without_energy_is_silent_beside_a_loud_one) {
  const SonarHead head = cells_head(samples_head(), 20);
  SurfaceEchoes s;
  const double loud = head.gate.centre(8), silent = head.gate.centre(9);
  for (std::uint64_t i = 0; i < 40; ++i) {
    const bool even = i % 2 == 0;
    s.echoes.delay.push_back(2 * (even ? loud : silent) / lossy.sound_speed);
    s.echoes.u.push_back(0.04 * static_cast<double>(i) - 0.8);
    s.echoes.amplitude.push_back(even ? 1e6 : 1e-4);
    s.id.push_back(i), s.power.push_back(even ? 1e12 : 0);
  }
  s.depth.assign(40, 0), s.width.assign(40, 0);
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Grid<double> cells = synthesize_cells(s, {}, head, lossy, {.seed = seed});
    EXPECT_LT(cells.col(9).maxCoeff(), 1e-9 * cells.col(8).maxCoeff()) << seed;
  }
}

TEST(DisplayCells, noise_has_level_and_looks_of_the_samples) {
  const SonarHead samples = samples_head(), head = cells_head(samples, 10);
  double sum = 0, square = 0, n = 0;
  for (std::int64_t ping = 0; ping < 60; ++ping) {
    const Grid<double> cells = synthesize_cells({}, {}, head, lossy, {.ping = ping, .element_noise_db = 100});
    sum += cells.sum(), square += cells.square().sum(), n += static_cast<double>(cells.size());
  }
  double weights = 0;
  for (const double w : head.array.shading) weights += w * w;
  const double beam = 2 * 1e10 * 1e-12 * weights / std::pow(static_cast<double>(head.array.elements()), 2);  // (E19)
  EXPECT_NEAR(db_from_power(sum / n / beam), 0, 0.1);
  EXPECT_NEAR(std::sqrt(square / n / std::pow(sum / n, 2) - 1), 1 / std::sqrt(looks_of_even_ground(head)), 0.02);
}

TEST(DisplayCells, are_linear_and_the_same_for_any_threads) {
  const SonarHead head = cells_head(samples_head(), 12);
  SurfaceEchoes ground = even_ground(500);
  const Grid<double> one = synthesize_cells(ground, {}, head, lossy, {.threads = 1});
  EXPECT_TRUE(same(one, synthesize_cells(ground, {}, head, lossy, {.threads = 5})));
  for (auto& a : ground.echoes.amplitude) a *= 1e-7;
  for (double& power : ground.power) power *= 1e-14;
  EXPECT_LT(worst_db(1e14 * synthesize_cells(ground, {}, head, lossy), one), 1e-3);
}

TEST(DisplayCells, of_a_kept_synthesizer_are_those_of_a_new_one) {
  const SonarHead head = cells_head(samples_head(), 5);
  const CellSynthesizer kept(head, lossy);
  for (const std::uint64_t key : {3, 4}) {
    const SurfaceEchoes ground = even_ground(300 * key, key);
    const CellOptions options{.seed = key, .ping = 2, .element_noise_db = 60};
    EXPECT_TRUE(same(kept.cells(ground, {}, options), synthesize_cells(ground, {}, head, lossy, options)));
  }
}

TEST(DisplayCells, of_a_planar_array_are_weighted_by_its_rows) {
  SonarHead head = cells_head(samples_head(3), 5);
  head.fan.azimuth = {-0.2, 0, 0.2, -0.2, 0, 0.2};
  head.fan.elevation = {0, 0, 0, 0.2, 0.2, 0.2};
  head.fan.row_width = 0.1;
  head.column = LineArray{head.array.spacing, uniform_shading(16)};
  SurfaceEchoes one = even_ground(1);
  one.echoes.u[0] = 0, one.echoes.delay[0] = 2 * 2.5 / lossy.sound_speed, one.echoes.v = {0.05};
  const Grid<double> cells = synthesize_cells(one, {}, head, lossy, {.speckle = false});
  const double wavelength = lossy.sound_speed / centre;
  const double below = std::norm(array_response(*head.column, wavelength, 0.05, 0)),
               above = std::norm(array_response(*head.column, wavelength, 0.05, std::sin(0.2)));
  EXPECT_NEAR(db_from_power(cells(1, 2) / cells(4, 2)), db_from_power(below / above), 0.3);
  // Noise of elements above each other adds up.
  const double noise = synthesize_cells({}, {}, head, lossy, {.element_noise_db = 100, .speckle = false})(0, 0);
  double weights = 0;
  for (const double w : head.array.shading) weights += w * w;
  EXPECT_NEAR(noise / (2e-2 * weights / (32. * 32) / 16), 1, 1e-9);
}

TEST(DisplayCells, refuse_arrays_of_other_lengths) {
  SurfaceEchoes ground = even_ground(3);
  ground.depth.pop_back();
  EXPECT_EQ(error_of([&] { synthesize_cells(ground, {}, cells_head(samples_head(), 5), lossy); }),
            "synthesize_cells: 3 delays, but 3 ids, 3 powers, 2 depths and 3 widths");
}

}  // namespace insonify::cell_tests
