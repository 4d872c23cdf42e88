// SPDX-License-Identifier: BSD-3-Clause
// Tests the shares of an echo before an edge of a cell (E227) against sums over samples from the definition.
#include <array>
#include <numbers>

#include "beamforming/cell_echoes.hpp"
#include "beamforming/display/cell_edges_internal.hpp"
#include "beamforming/synthesize.hpp"
#include "support/test.hpp"

namespace insonify::cell_tests {
namespace {

constexpr double deviation = 0.0048, first_range = 0.7, sample_length = 0.011;

double density(double x) { return std::exp(-0.5 * x * x / (deviation * deviation)) / (std::sqrt(2 * pi) * deviation); }

/// Returns the share of the samples before `edge` in the energy of a pulse about `range`.
double share_of_samples(double edge, double range) {
  double sum = 0;
  for (int n = 0; n < 200; ++n) {
    const double begin = first_range + n * sample_length, before = std::clamp(edge - begin, 0.0, sample_length);
    sum += before * density(begin + 0.5 * sample_length - range);
  }
  return sum;
}
double share_of_range(double edge, double range) {
  return 0.5 * std::erfc((range - edge) / (std::numbers::sqrt2 * deviation));
}

/// Returns the mean share of the parts of a surface of half depth `depth` about `range`.
template <typename Share>
double mean_over_surface(const Share& share, double edge, double range, double depth) {
  constexpr int parts = 400;
  double sum = 0;
  for (int k = 0; k < parts; ++k) sum += share(edge, range + depth * (2 * (k + 0.5) / parts - 1)) / parts;
  return sum;
}

/// Largest difference from `share` for edges, ranges and depths of all kinds.
template <typename Share>
double worst_difference(const CellEdges& edges, const Share& share) {
  double worst = 0;
  for (std::uint64_t i = 0; i < 500; ++i) {
    const auto at = random_uniform(1, RandomStage::scene_points, {i, 0, 0});
    const double edge = 1.2 + 0.1 * at[0], range = edge + 0.08 * (at[1] - 0.5);
    const std::array<double, 5> depths = {0, 0.0002, 0.0045, 0.005, 0.05};
    const double depth = depths[i % depths.size()];
    const double drawn = edges.before(edges.at(edge), range, depth);
    worst = std::max(worst, std::abs(drawn - mean_over_surface(share, edge, range, depth)));
  }
  return worst;
}

}  // namespace

// The pulse ends at four deviations: a sample there would have 3e-4 of its energy.
TEST(CellEdges, shares_are_those_of_the_samples_that_edges_divide) {
  EXPECT_LT(worst_difference(CellEdges(deviation, first_range, sample_length), share_of_samples), 4e-4);
  EXPECT_LT(worst_difference(CellEdges(deviation, first_range, 0), share_of_range), 4e-4);
  EXPECT_LT(worst_difference(CellEdges(deviation, first_range, 1e-9), share_of_range), 4e-4);
  // Samples far coarser than the pulse, and a pulse without length.
  EXPECT_TRUE(std::isfinite(CellEdges(1e-6, first_range, 1).before({1, 0.5}, 1, 0)));
  EXPECT_EQ(CellEdges(0, first_range, 0).before({1, 0}, 0.9, 0), 1);
}

TEST(CellEdges, an_echo_alone_has_the_energy_of_its_samples) {
  const CellEdges edges(deviation, first_range, sample_length);
  double least = 2, most = 0;
  for (int k = 0; k < 100; ++k) {
    const double range = 1.4 + 0.001 * k;
    const double share = edges.before(edges.at(1.61), range, 0) - edges.before(edges.at(1.2), range, 0);
    EXPECT_NEAR(share, share_of_samples(1.61, range) - share_of_samples(1.2, range), 4e-4);
    least = std::min(least, share), most = std::max(most, share);
  }
  // The first harmonic of the sum over samples (Poisson): 2 exp(-2 (pi deviation / length)^2).
  EXPECT_NEAR(most - least, 4 * std::exp(-2 * std::pow(pi * deviation / sample_length, 2)), 2e-3);
}

TEST(DisplayCells, before_a_wall_have_the_energy_of_samples) {
  // A wall begins at an edge, which divides a sample.
  const SonarHead samples = samples_head(1), head = cells_head(samples, 20);
  const double edge = head.gate.min_range + 10 * head.gate.bin_size;
  SurfaceEchoes wall = even_ground(60);
  Grid<double> exact = Grid<double>::Zero(1, 20);
  for (std::size_t i = 0; i < wall.id.size(); ++i) {
    wall.echoes.delay[i] = 2 * (edge + 0.0005 * static_cast<double>(i)) / lossless.sound_speed, wall.echoes.u[i] = 0;
    Echoes one;
    one.delay = {wall.echoes.delay[i]}, one.u = {0}, one.amplitude = {1};
    const ComplexGrid p = synthesize(one, samples, lossless, SynthesisMethod::direct);
    exact += mean_over_cells(p.abs2(), samples.gate, head.gate);
  }
  const auto cells = [&](double length) {
    return CellSynthesizer(head, lossless, length).cells(wall, {}, {.speckle = false});
  };
  // Shares of the cell before the wall: levels of a single direction also have the error of its node of u.
  const auto before = [](const Grid<double>& of) { return of(0, 9) / of.sum(); };
  EXPECT_NEAR(before(cells(samples.gate.bin_size)) / before(exact), 1, 0.01);
  EXPECT_LT(before(cells(0)) / before(exact), 0.75) << "samples matter";
}

}  // namespace insonify::cell_tests
