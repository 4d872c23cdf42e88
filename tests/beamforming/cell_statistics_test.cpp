// SPDX-License-Identifier: BSD-3-Clause
// Tests the speckle of display cells (E182 to E184, E223, E224, E226) against closed forms and averaged samples.
#include <array>

#include "beamforming/cell_echoes.hpp"
#include "beamforming/synthesize.hpp"
#include "beamforming/synthesize_noise.hpp"
#include "beamforming/synthesizer.hpp"
#include "support/test.hpp"

namespace insonify::cell_tests {

/// Returns M = T^2 / integral of the squared correlation over the cell, 2^(-2 (x / L)^2) for a Gaussian pulse.
double looks_of_even_ground(const SonarHead& head) {
  const double length = head.gate.bin_size, l = 0.4413 * c0_cold / (2 * bandwidth);
  double overlap = 0;
  for (double x = 0.5e-5; x < length; x += 1e-5) overlap += 2e-5 * (length - x) * std::exp2(-2 * x * x / (l * l));
  return length * length / overlap;
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

// Echoes of a point, of a disc of one ring of points and of one of two rings (E228).
TEST(DisplayCells, an_echo_alone_is_exponential) {
  const SonarHead head = cells_head(samples_head(), 5);
  SurfaceEchoes one = even_ground(1);
  one.echoes.u[0] = 0, one.echoes.delay[0] = 2 * 2.5 / lossy.sound_speed;
  const double expected = synthesize_cells(one, {}, head, lossy, {.speckle = false})(4, 2);
  for (const int rings : {0, 1, 2}) {
    if (rings > 0) one.disc = {{{0.01f, 0.002f}, {0.01f, 0}, rings == 2}};
    double sum = 0, square = 0;
    constexpr int seeds = 1500;
    for (int seed = 1; seed <= seeds; ++seed) {
      const double i =
          synthesize_cells(one, {}, head, lossy, {.seed = static_cast<std::uint64_t>(seed)})(4, 2) / expected;
      sum += i, square += i * i;
    }
    EXPECT_NEAR(sum / seeds, 1, 0.1) << rings;
    EXPECT_NEAR(square / seeds, 2, 0.5) << rings;
  }
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

// Samples have a piece of surface at its middle. So has the drawn image what is added as a pressure: beams beside it hear as
// little of it, though the piece is as wide as a beam. Its mean as a box would be 2 to 6 dB louder there.
TEST(DisplayCells, a_bright_piece_beside_a_beam_is_as_quiet_as_that_of_samples) {
  const SonarHead samples =
      line_head({.beams = 65, .elements = 32, .field_of_view_deg = 10, .min_range = 2, .max_range = 3});
  const SonarHead head = cells_head(samples, 5);
  SurfaceEchoes s = even_ground(8000);
  const double range = head.gate.centre(2);
  s.echoes.delay.push_back(2 * range / lossless.sound_speed), s.echoes.u.push_back(0.003);
  s.echoes.amplitude.push_back(std::polar(300.0, 4 * pi * range * centre / lossless.sound_speed));
  s.id.push_back(s.id.size()), s.power.push_back(9e4), s.depth.push_back(0), s.width.push_back(0.03f);
  Grid<double> mean[2] = {Grid<double>::Zero(65, 5), Grid<double>::Zero(65, 5)};
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    const ComplexGrid p = synthesize(drawn(s, seed), samples, lossless, SynthesisMethod::gridded);
    mean[0] += mean_over_cells(p.abs2(), samples.gate, head.gate);
    mean[1] += synthesize_cells(s, {}, head, lossless, {.seed = seed});
  }
  // Both share the amplitude of the piece, but not the speckle of the ground that it stands on: 0.1 dB of the ratio. Near the
  // nulls of the piece, what is left of the mean is rough.
  for (Eigen::Index beam = 0; beam < 65; ++beam)
    EXPECT_NEAR(db_from_power(mean[1](beam, 2) / mean[0](beam, 2)), 0,
                mean[0](beam, 2) > 3e-2 * mean[0].maxCoeff() ? 0.3 : 2)
        << beam;
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

// A glint of a wall beside the fan is so loud that a hundred thousandth of it would hide what else a beam receives.
TEST(DisplayCells, glints_are_heard_in_far_side_lobes_as_the_array_receives_them) {
  SonarHead head = cells_head(samples_head(33), 5);
  head.pulse.bandwidth = 500;  // its pattern is that of the centre frequency
  const double wavelength = lossy.sound_speed / centre, glint = -0.953;
  Echoes e;
  e.delay = {2 * 2.5 / lossy.sound_speed}, e.u = {glint}, e.amplitude = {1};
  const Grid<double> ahead = synthesize_cells({}, {e.delay, {0.0}, e.amplitude, {}}, head, lossy);
  const std::vector<double>& azimuth = head.fan.azimuth;
  for (const bool speckle : {false, true}) {
    const Grid<double> cells = synthesize_cells({}, e, head, lossy, {.speckle = speckle});
    for (std::size_t b = 0; b < azimuth.size(); ++b) {
      const double response = std::norm(array_response(head.array, wavelength, glint, std::sin(azimuth[b])));
      const auto beam = static_cast<Eigen::Index>(b);
      EXPECT_NEAR(cells(beam, 2) / ahead(16, 2), response, 0.02 * response + 1e-5) << azimuth[b];
    }
  }
}

/// Mean and contrast of cells, and how alike cells side by side are, over images whose cells all expect the same.
class CellStatistics {
 public:
  void add(const Grid<double>& cells) {
    const Eigen::Index last = cells.cols() - 1;
    sum_ += cells.sum(), square_ += cells.square().sum(), count_ += static_cast<double>(cells.size());
    product_ += (cells.leftCols(last) * cells.rightCols(last)).sum();
    pairs_ += static_cast<double>(cells.rows() * last);
  }
  double mean() const { return sum_ / count_; }
  double contrast() const { return std::sqrt(variance()) / mean(); }
  double next_cell() const { return (product_ / pairs_ - mean() * mean()) / variance(); }

 private:
  double variance() const { return square_ / count_ - mean() * mean(); }
  double sum_ = 0, square_ = 0, count_ = 0, product_ = 0, pairs_ = 0;
};

/// Returns statistics of cells of noise alone, drawn and as means of samples.
std::array<CellStatistics, 2> noise_statistics(const SonarHead& samples, int cells, int pings) {
  const SonarHead head = cells_head(samples, cells);
  const CellSynthesizer drawn(head, lossy, samples.gate.bin_size);
  std::array<CellStatistics, 2> of;
  for (std::int64_t ping = 0; ping < pings; ++ping) {
    of[0].add(drawn.cells({}, {}, {.ping = ping, .element_noise_db = 100}));
    const ComplexGrid noise = synthesize_noise(samples, lossy, 100, {.ping = ping});
    of[1].add(mean_over_cells(noise.abs2(), samples.gate, head.gate));
  }
  return of;
}

// The receiver's filter has taps as far apart as samples: of Gaussian pulses noise has 7 % more looks than ground, of
// tones sampled finely 59 % more.
TEST(DisplayCells, noise_has_level_and_looks_of_the_samples) {
  SonarHead tone = samples_head();
  tone.pulse.shape = PulseShape::tone_burst, tone.gate.bin_size /= 3;
  for (const SonarHead& samples : {samples_head(), tone}) {
    const auto [drawn, averaged] = noise_statistics(samples, 10, 200);
    EXPECT_NEAR(db_from_power(drawn.mean() / averaged.mean()), 0, 0.05);
    EXPECT_NEAR(drawn.contrast() / averaged.contrast(), 1, 0.02);
  }
}

TEST(DisplayCells, noise_with_ground_has_the_looks_of_both) {
  SonarHead samples = samples_head();
  samples.pulse.shape = PulseShape::tone_burst, samples.gate.bin_size /= 3;
  const SonarHead head = cells_head(samples, 12);
  const CellSynthesizer synthesizer(head, lossless, samples.gate.bin_size);
  // Noise as loud as the ground.
  CellOptions options{.element_noise_db = 100, .speckle = false};
  const double noise = synthesizer.cells({}, {}, options).mean();
  options.element_noise_db +=
      db_from_power(synthesizer.cells(even_ground(20000), {}, {.speckle = false}).mean() / noise);
  options.speckle = true;
  CellStatistics of_drawn, of_averaged;
  for (options.seed = 1; options.seed <= 60; ++options.seed) {
    options.ping = static_cast<std::int64_t>(options.seed);
    const SurfaceEchoes ground = even_ground(20000, options.seed);
    const ComplexGrid p =
        synthesize(drawn(ground, options.seed), samples, lossless, SynthesisMethod::gridded) +
        synthesize_noise(samples, lossless, options.element_noise_db, {.seed = options.seed, .ping = options.ping});
    of_averaged.add(mean_over_cells(p.abs2(), samples.gate, head.gate));
    of_drawn.add(synthesizer.cells(ground, {}, options));
  }
  EXPECT_NEAR(of_drawn.contrast() / of_averaged.contrast(), 1, 0.04);
}

/// Returns the contrast of cells of 5 cm, drawn and as means of samples, in which a beam at u = 0.68 hears `count` echoes
/// from u = -0.75 to `last` by a lobe at the distance 1 / 0.7 = 1.43: elements are 0.7 wavelengths apart.
std::array<double, 2> contrast_of_lobes(double last, std::size_t count, std::uint64_t seeds) {
  SonarHead samples = samples_head(1, 128);
  samples.array.spacing = 0.7 * c0_cold / centre;
  samples.fan.azimuth[0] = std::asin(0.68);
  const SonarHead head = cells_head(samples, 20);
  const Synthesizer synthesizer(samples, lossless, SynthesisMethod::true_delays);
  const CellSynthesizer cells(head, lossless);
  CellStatistics of_drawn, of_averaged;
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    SurfaceEchoes ground = even_ground(count, seed);
    for (double& u : ground.echoes.u) u = -0.75 + 0.5 * (u + 1) * (last + 0.75);
    const ComplexGrid p = synthesizer.pressure(drawn(ground, seed));
    of_averaged.add(mean_over_cells(p.abs2(), samples.gate, head.gate));
    of_drawn.add(cells.cells(ground, {}, {.seed = seed}));
  }
  return {of_drawn.contrast(), of_averaged.contrast()};
}

// A lobe is a tenth as wide as the band: an echo makes one look of the six of even ground. Half the band makes three. Two
// standard deviations of these contrasts are 0.08 and 0.1 of them.
TEST(DisplayCells, heard_through_grating_lobes_have_the_contrast_of_samples) {
  const auto [drawn, averaged] = contrast_of_lobes(-0.745, 1500, 100);
  EXPECT_GT(averaged, 0.8);
  EXPECT_NEAR(drawn / averaged, 1, 0.08);
  const auto [drawn_of_many, averaged_of_many] = contrast_of_lobes(-0.65, 6000, 30);
  EXPECT_LT(averaged_of_many, 0.6);
  EXPECT_NEAR(drawn_of_many / averaged_of_many, 1, 0.1);
}

TEST(DisplayCells, side_by_side_are_as_alike_as_those_of_samples) {
  // Cells of 4.6 samples.
  const auto [drawn, averaged] = noise_statistics(samples_head(), 40, 200);
  EXPECT_GT(averaged.next_cell(), 0.05);
  EXPECT_NEAR(drawn.next_cell(), averaged.next_cell(), 0.02);
  const SonarHead samples = samples_head(), head = cells_head(samples, 40);
  CellStatistics of_drawn, of_averaged;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    const SurfaceEchoes ground = even_ground(20000, seed);
    const ComplexGrid p = synthesize(cell_tests::drawn(ground, seed), samples, lossless, SynthesisMethod::gridded);
    of_averaged.add(mean_over_cells(p.abs2(), samples.gate, head.gate));
    of_drawn.add(synthesize_cells(ground, {}, head, lossless, {.seed = seed}));
  }
  EXPECT_NEAR(of_drawn.next_cell(), of_averaged.next_cell(), 0.03);
}

}  // namespace insonify::cell_tests
