// SPDX-License-Identifier: BSD-3-Clause
// Tests display cells of a ping (E180): drawn ones against means of samples, and their effect on plan and options.
#include "returns/looks.hpp"
#include "scene/built_in_scenes.hpp"
#include "simulate/plan_ping.hpp"
#include "simulate/simulate_ping.hpp"
#include "support/heads.hpp"
#include "support/simulate_event.hpp"
#include "support/test.hpp"

namespace insonify::display_tests {

constexpr int cells = 24;
const SonarHead head = small_head({.beams = 24,
                                   .field_of_view_deg = 60,
                                   .beam_width_deg = 3,
                                   .elevation_width_deg = 25,
                                   .min_range = 4,
                                   .max_range = 14});

const SceneCloud& seabed() {
  static const SceneCloud scene = make_built_in_scene("plane", {.points = 60000, .size = {20, 24}});
  return scene;
}

/// Returns a pose tilted in all three angles, above a plane at z = 0.
Pose tilted(double aside = 0) { return pose_from_yaw_pitch_roll({-5, aside, 3}, 0.1, 0.35, -0.12); }

SimulationOptions display(bool phases, std::uint64_t seed = 1) {
  SimulationOptions o;
  o.seed = seed, o.outputs.display_bins = cells, o.synthesis.phases = phases;
  return o;
}

SimulatedPing ping_of(const SimulationOptions& options, const Pose& pose = tilted()) {
  return simulate_event(seabed(), head, {.world_from_head = pose}, {}, options);
}

Grid<double> intensity_of(const SimulatedPing& p) { return p.ping.pressure.cast<std::complex<double>>().abs2(); }

struct Moments {
  Grid<double> mean, square;
  /// Returns the contrast of cells within 30 dB of the loudest.
  double contrast() const {
    double sum = 0, n = 0;
    for (Eigen::Index i = 0; i < mean.size(); ++i)
      if (mean.data()[i] > 1e-3 * mean.maxCoeff()) sum += square.data()[i] / std::pow(mean.data()[i], 2) - 1, ++n;
    return std::sqrt(sum / n);
  }
};
Moments moments_of(bool phases, int seeds) {
  Moments m;
  for (int seed = 1; seed <= seeds; ++seed) {
    const Grid<double> image = intensity_of(ping_of(display(phases, static_cast<std::uint64_t>(seed))));
    if (seed == 1) m.mean = m.square = Grid<double>::Zero(image.rows(), image.cols());
    m.mean += image / seeds, m.square += image.square() / seeds;
  }
  return m;
}
const Moments& drawn() {
  static const Moments m = moments_of(false, 24);
  return m;
}
const Moments& averaged() {
  static const Moments m = moments_of(true, 24);
  return m;
}

/// Returns the correlation of two images relative to `usual`, over cells of the bed.
double correlation(const Grid<double>& a, const Grid<double>& b, const Grid<double>& usual) {
  double ab = 0, aa = 0, bb = 0;
  for (Eigen::Index i = 0; i < a.size(); ++i) {
    if (usual.data()[i] < 1e-3 * usual.maxCoeff()) continue;
    const double x = a.data()[i] / usual.data()[i] - 1, y = b.data()[i] / usual.data()[i] - 1;
    ab += x * y, aa += x * x, bb += y * y;
  }
  return ab / std::sqrt(aa * bb);
}

TEST(DisplayPing, drawn_cells_have_level_and_contrast_of_samples) {
  const Grid<double>&a = drawn().mean, &b = averaged().mean;
  EXPECT_NEAR(db_from_power(a.sum() / b.sum()), 0, 0.08);
  for (int band = 4; band + 4 <= cells; band += 4)
    EXPECT_NEAR(db_from_power(a.middleCols(band, 4).sum() / b.middleCols(band, 4).sum()), 0, 0.2) << band;
  EXPECT_NEAR(drawn().contrast() / averaged().contrast(), 1, 0.08);
}

TEST(DisplayPing, neighbouring_beams_are_as_alike_as_those_of_samples) {
  const auto apart = [](bool phases, const Moments& m) {
    const Grid<double> image = intensity_of(ping_of(display(phases, 99)));
    const Eigen::Index last = image.rows() - 1;
    // Scale the second beam to the mean of the first.
    const Grid<double> second = image.bottomRows(last) / m.mean.bottomRows(last).max(1e-30) * m.mean.topRows(last);
    return correlation(image.topRows(last), second, m.mean.topRows(last));
  };
  EXPECT_NEAR(apart(false, drawn()), apart(true, averaged()), 0.12);
}

TEST(DisplayPing, speckle_stays_with_the_scene_and_goes_with_motion) {
  const auto after = [](bool phases, const Moments& m, double aside) {
    return correlation(intensity_of(ping_of(display(phases, 5))),
                       intensity_of(ping_of(display(phases, 5), tilted(aside))), m.mean);
  };
  EXPECT_DOUBLE_EQ(after(false, drawn(), 0), 1);
  EXPECT_GT(after(false, drawn(), 0.004), 0.8);
  for (const double aside : {0.02, 0.04})
    EXPECT_NEAR(after(false, drawn(), aside), after(true, averaged(), aside), 0.15) << aside;
  EXPECT_LT(after(false, drawn(), 0.5), 0.2);
}

// Surfels 25 cm apart are as wide as beams and half as long as cells. Drawn as points, they would leave 0.38 for 0.11 of samples
// in the mean over these moves. The standard error of one is 0.05.
TEST(DisplayPing, speckle_of_wide_surfels_goes_with_motion_as_that_of_samples) {
  const SceneCloud coarse = make_built_in_scene("plane", {.points = 7700, .size = {20, 24}});
  const auto image = [&](bool phases, std::uint64_t seed, double aside) {
    return intensity_of(simulate_event(coarse, head, {.world_from_head = tilted(aside)}, {}, display(phases, seed)));
  };
  constexpr int seeds = 8;
  const auto after = [&](bool phases, const std::vector<Grid<double>>& before, double aside) {
    Grid<double> a = Grid<double>::Zero(before[0].rows(), cells), b = a, ab = a, aa = a, bb = a;
    for (std::size_t k = 0; k < seeds; ++k) {
      const Grid<double>&x = before[k], y = image(phases, k + 1, aside);
      a += x / seeds, b += y / seeds, ab += x * y / seeds, aa += x * x / seeds, bb += y * y / seeds;
    }
    double both = 0, first = 0, second = 0;
    for (Eigen::Index i = 0; i < a.size(); ++i) {
      const double x = a.data()[i], y = b.data()[i];
      if (!(x > 1e-3 * a.maxCoeff())) continue;
      both += ab.data()[i] / (x * y) - 1, first += aa.data()[i] / (x * x) - 1, second += bb.data()[i] / (y * y) - 1;
    }
    return both / std::sqrt(first * second);
  };
  std::vector<Grid<double>> drawn, averaged;
  for (std::uint64_t seed = 1; seed <= seeds; ++seed)
    drawn.push_back(image(false, seed, 0)), averaged.push_back(image(true, seed, 0));
  double of_drawn = 0, of_samples = 0;
  for (const double aside : {0.02, 0.04, 0.08})
    of_drawn += after(false, drawn, aside) / 3, of_samples += after(true, averaged, aside) / 3;
  EXPECT_NEAR(of_drawn, of_samples, 0.1);
}

TEST(DisplayPing, is_the_same_for_any_threads_and_moves_with_the_world) {
  SimulationOptions one = display(false), three = one;
  one.threads = 1, three.threads = 3;
  const Grid<double> image = intensity_of(ping_of(one));
  EXPECT_TRUE(same(image, intensity_of(ping_of(three))));
  SceneCloud elsewhere = seabed();
  const Eigen::Vector3d shift(3000, -500, 40);
  elsewhere.origin += shift;
  const Pose pose = Eigen::Translation3d(shift) * tilted();
  const Grid<double> moved = intensity_of(simulate_event(elsewhere, head, {.world_from_head = pose}, {}, one));
  EXPECT_LT(relative_l2(moved, image), 1e-4);
}

TEST(DisplayPing, noise_and_expected_levels_are_those_of_samples) {
  SimulationOptions o = display(false);
  o.effects.noise = true;
  Environment loud;
  loud.self_noise_db = 95;
  const auto level = [&](bool phases, double ranges) {
    o.synthesis.phases = phases;
    const Ping ping = simulate_event(seabed(), head, {.world_from_head = tilted()}, loud, o).ping;
    return mean_level_db(ping, ranges, ranges + 0.8);
  };
  EXPECT_NEAR(level(false, 4), level(true, 4), 0.3) << "before the bed there is noise alone";
  o.effects.noise = false, o.synthesis.method = SynthesisMethod::incoherent;
  const auto expected = [&](bool phases) {
    o.synthesis.phases = phases;
    const SimulatedPing p = ping_of(o);
    EXPECT_TRUE(p.ping.expected_level && p.ping.display_cells);
    return intensity_of(p);
  };
  EXPECT_NEAR(db_from_power(expected(false).sum() / expected(true).sum()), 0, 0.1);
}

TEST(DisplayPing, forms_samples_for_a_reason) {
  const auto row = [](const SimulationOptions& o, const SceneCloud& scene, const Environment& environment = {},
                      const SonarHead& of = head) {
    const PingPlan plan = plan_ping(scene, of, {.world_from_head = tilted()}, environment, o);
    const auto at = std::find_if(plan.stages.begin(), plan.stages.end(), [](auto& s) { return s.name == "phases"; });
    return at->included ? at->why : "";
  };
  EXPECT_EQ(row(display(false), seabed()), "");
  EXPECT_EQ(row({}, seabed()), "the output is pressure");
  EXPECT_EQ(row(display(true), seabed()), "asked for");
  SimulationOptions o = display(false);
  o.outputs.layers = true;
  EXPECT_EQ(row(o, seabed()), "");
  o = display(false), o.sampling.kind = SamplingKind::rays;
  EXPECT_EQ(row(o, seabed()), "rays meet points, which have no extent to spread energy over");
  o = display(false), o.outputs.display_bins = 500;
  EXPECT_EQ(row(o, seabed()),
            "a display cell has fewer than four samples, formed to 0.1 dB of its mean and 5 % of its contrast");
  o = display(false), o.amplitude = SurfaceAmplitude::coherent;
  EXPECT_EQ(row(o, seabed()), "amplitudes are not Gaussian");
  SceneCloud shiny = seabed();
  shiny.materials[0].coherent_fraction = 0.5;
  EXPECT_EQ(row(display(false), shiny), "a material has a coherent fraction");
  Environment walls;
  walls.surface = SeaSurface{4, 1e-4};
  o = display(false), o.effects.multipath = Choice::always;
  EXPECT_EQ(row(o, seabed(), walls), "") << "both senses of a path add up as pressures";
  SceneCloud pile = seabed();
  add_surfel(pile, {5, 0, 3.95}, {-1, 0, 0}, 0.01);
  EXPECT_EQ(row(o, pile, walls),
            "echoes by a boundary arrive within a pulse of direct ones, to which they add with their phases");
}

TEST(DisplayPing, of_few_samples_is_formed_as_well_as_a_display_shows) {
  constexpr int fine = 300;  // 1.8 samples a cell
  const auto decided = [](SimulationOptions o) {
    o.outputs.display_bins = fine;
    return plan_ping(seabed(), head, {.world_from_head = tilted()}, {}, o).options;
  };
  EXPECT_EQ(decided(display(false)).sampling.scatterers_per_cell, 3);
  EXPECT_EQ(decided(display(false)).synthesis.tolerance, 1e-3);
  // Settings of the caller stay.
  EXPECT_EQ(decided(display(true)).sampling.scatterers_per_cell, SamplingOptions{}.scatterers_per_cell);
  EXPECT_EQ(decided(display(true)).synthesis.tolerance, SynthesisSettings{}.tolerance);
  SimulationOptions requested = display(false);
  requested.sampling.scatterers_per_cell = 5, requested.synthesis.tolerance = 1e-5;
  EXPECT_EQ(decided(requested).sampling.scatterers_per_cell, 5);
  EXPECT_EQ(decided(requested).synthesis.tolerance, 1e-5);

  // Level and contrast are those of all scatterers at the usual tolerance.
  Moments coarse, all;
  std::size_t few = 0, many = 0;
  constexpr int seeds = 24;
  for (int seed = 1; seed <= seeds; ++seed)
    for (Moments* m : {&coarse, &all}) {
      SimulationOptions o = display(m == &all, static_cast<std::uint64_t>(seed));
      o.outputs.display_bins = fine;
      const SimulatedPing p = ping_of(o);
      (m == &all ? many : few) = p.report.sampling.scatterers;
      const Grid<double> image = intensity_of(p);
      if (seed == 1) m->mean = m->square = Grid<double>::Zero(image.rows(), image.cols());
      m->mean += image / seeds, m->square += image.square() / seeds;
    }
  EXPECT_LT(2 * few, many);
  EXPECT_NEAR(db_from_power(coarse.mean.sum() / all.mean.sum()), 0, 0.1);
  EXPECT_NEAR(coarse.contrast() / all.contrast(), 1, 0.05);
}

TEST(DisplayPing, of_samples_is_their_mean_over_area) {
  SimulationOptions o;
  const SimulatedPing samples = ping_of(o);
  const Ping averaged_ping = ping_of(display(true)).ping;
  EXPECT_TRUE(averaged_ping.display_cells);
  EXPECT_EQ(averaged_ping.gate.bins(), static_cast<std::size_t>(cells));
  const Grid<double> fine = intensity_of(samples);
  const RangeGate& gate = samples.ping.gate;
  // Cell 12 of beam 3, bin by bin.
  const double first = 4 + 12 * 10. / cells, last = first + 10. / cells;
  double sum = 0, area = 0;
  for (std::size_t n = 0; n < gate.bins(); ++n) {
    const double low = std::max(first, gate.min_range + static_cast<double>(n) * gate.bin_size),
                 high = std::min(last, gate.min_range + static_cast<double>(n + 1) * gate.bin_size);
    if (high <= low) continue;
    sum += (high * high - low * low) * fine(3, static_cast<Eigen::Index>(n)), area += high * high - low * low;
  }
  EXPECT_NEAR(std::norm(std::complex<double>(averaged_ping.pressure(3, 12))) / (sum / area), 1, 1e-5);
}

TEST(DisplayPing, soundings_are_of_cells) {
  const SimulatedPing p = ping_of(display(false));
  for (std::size_t i = 0; i < p.soundings.size(); ++i) {
    EXPECT_GE(p.soundings.range[i], 4);
    EXPECT_LE(p.soundings.range[i], 14);
  }
  EXPECT_EQ(ping_of(display(false)).soundings.size(), p.soundings.size());
}

TEST(DisplayPing, refuses_outputs_of_samples) {
  const auto refusal = [](auto&& change) {
    SimulationOptions o = display(false);
    change(o);
    return error_of([&] { ping_of(o); });
  };
  EXPECT_EQ(refusal([](SimulationOptions& o) { o.outputs.display_bins = -1; }),
            "PingSimulator: options.outputs.display_bins = -1, must be within 0 and 65536; 0: samples");
  EXPECT_EQ(
      refusal([](SimulationOptions& o) { o.outputs.looks_range = 3; }),
      "PingSimulator: options.outputs.display_bins = 24, must be 0 with looks_range or looks_pings: a display cell "
      "is a mean of looks already");
  EXPECT_THAT(refusal([](SimulationOptions& o) { o.outputs.split_phase = true; }), HasSubstr("have no phase"));
  EXPECT_THAT(refusal([](SimulationOptions& o) { o.outputs.elements = true; }), HasSubstr("samples of pressure"));
  EXPECT_THAT(refusal([](SimulationOptions& o) { o.outputs.contributors = 2; }), HasSubstr("listed by sample"));
}

}  // namespace insonify::display_tests
