// SPDX-License-Identifier: BSD-3-Clause
// Tests expected display cells (E180, E181, E188, E189): against sums from the definition, and what synthesize_cells
// promises of its arguments.
#include "beamforming/synthesize_cells.hpp"

#include "beamforming/cell_echoes.hpp"
#include "beamforming/synthesize.hpp"
#include "support/errors.hpp"
#include "support/test.hpp"

namespace insonify::cell_tests {

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

TEST(DisplayCells, expected_are_the_energies_of_the_definition) {
  const SonarHead head = cells_head(samples_head(), 20);
  const SurfaceEchoes ground = even_ground(3000);
  const Grid<double> cells = synthesize_cells(ground, {}, head, lossy, {.speckle = false});
  const Grid<double> exact = cells_by_definition(ground, head, lossy);
  // Directions between nodes of u cost up to a tenth of a dB in cells of few echoes.
  EXPECT_LT(worst_db(cells, exact), 0.15);
  EXPECT_LT(worst_db(cells.rowwise().sum(), exact.rowwise().sum()), 0.02);
  EXPECT_LT(worst_db(cells.colwise().sum(), exact.colwise().sum()), 0.02);
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

TEST(DisplayCells, far_side_lobes_are_those_of_the_band) {
  // Echoes stand at one end of the fan; at the other a grating lobe of the band begins.
  SonarHead head = line_head({.beams = 65, .elements = 64, .field_of_view_deg = 130, .min_range = 2, .max_range = 3});
  head.gate = display_gate(head.gate, 4);
  SurfaceEchoes end = even_ground(40);
  for (std::size_t i = 0; i < end.id.size(); ++i)
    end.echoes.u[i] = -0.99 + 0.001 * static_cast<double>(i), end.echoes.delay[i] = 2 * 2.4 / lossy.sound_speed;
  const Grid<double> cells = synthesize_cells(end, {}, head, lossy, {.speckle = false});
  const Grid<double> exact = cells_by_definition(end, head, lossy);
  double least = 1;
  for (Eigen::Index b = 0; b < cells.rows(); ++b) {
    const double share = exact.row(b).sum() / exact.rowwise().sum().maxCoeff();
    least = std::min(least, share);
    // Directions between nodes of u cost up to a tenth of a dB where the pattern is steep.
    EXPECT_NEAR(db_from_power(cells.row(b).sum() / exact.row(b).sum()), 0, 0.15) << b << ": " << share;
  }
  EXPECT_LT(least, 1e-3);
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

// A surface about as wide as a beam, at places all over a node of u: beams on its flank hear as much of it as of its
// points.
TEST(DisplayCells, surfaces_of_a_beam_have_their_own_width) {
  const SonarHead head =
      cells_head(line_head({.beams = 17, .elements = 32, .field_of_view_deg = 10, .min_range = 2, .max_range = 3}), 5);
  constexpr int places = 32;
  constexpr double step = 0.0005, half = 0.02;
  SurfaceEchoes boxes = even_ground(places), points = even_ground(64 * places);
  for (std::size_t k = 0; k < points.id.size(); ++k) {
    const std::size_t place = k % places;
    const double u = step * static_cast<double>(place), part = (static_cast<double>(k / places) + 0.5) / 64;
    points.echoes.u[k] = u + half * (2 * part - 1), points.echoes.delay[k] = 2 * 2.5 / lossy.sound_speed;
    points.echoes.amplitude[k] = 0.125;
    boxes.echoes.u[place] = u, boxes.echoes.delay[place] = points.echoes.delay[k];
    boxes.width[place] = static_cast<float>(half);
  }
  const Grid<double> made = synthesize_cells(boxes, {}, head, lossy, {.speckle = false}),
                     exact = cells_by_definition(points, head, lossy);
  for (Eigen::Index beam = 0; beam < 17; ++beam)
    if (exact(beam, 2) > 1e-2 * exact.maxCoeff()) {
      EXPECT_NEAR(db_from_power(made(beam, 2) / exact(beam, 2)), 0, 0.05) << beam;
    }
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

TEST(DisplayCells, before_a_tilted_surface_hear_its_nearest_part) {
  // The surface begins two millimetres before the end of cell 10 and goes on for another 22, as the pulse does.
  const SonarHead fan =
      line_head({.beams = 33, .elements = 64, .field_of_view_deg = 24, .min_range = 2, .max_range = 3});
  const SonarHead head = cells_head(fan, 20);
  SurfaceEchoes one = even_ground(1), many = even_ground(20000);
  const double middle = 2.56, depth = 0.012, slope = 8;
  one.echoes.u[0] = 0.1, one.echoes.delay[0] = 2 * middle / lossy.sound_speed;
  one.depth[0] = static_cast<float>(depth), one.width[0] = static_cast<float>(slope * depth);
  one.slope = {static_cast<float>(slope)}, one.across = {0.002f};
  for (std::size_t i = 0; i < many.id.size(); ++i) {
    const double away = depth * (2 * (static_cast<double>(i) + 0.5) / 20000 - 1);
    many.echoes.delay[i] = 2 * (middle + away) / lossy.sound_speed, many.echoes.u[i] = 0.1 + slope * away;
    many.power[i] = 1 / 20000.0;
  }
  const Grid<double> a = synthesize_cells(one, {}, head, lossy, {.speckle = false});
  const Grid<double> b = synthesize_cells(many, {}, head, lossy, {.speckle = false});
  std::size_t heard = 0;
  for (Eigen::Index beam = 0; beam < b.rows(); ++beam) {
    if (b(beam, 10) < 1e-2 * b.maxCoeff()) continue;
    EXPECT_NEAR(db_from_power(a(beam, 10) / b(beam, 10)), 0, 0.2) << beam;
    ++heard;
  }
  EXPECT_GE(heard, 8U);
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
