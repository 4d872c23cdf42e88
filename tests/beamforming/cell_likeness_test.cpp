// SPDX-License-Identifier: BSD-3-Clause
// Tests how alike beams are in drawn display cells, and images before and after a move (E183): against means of samples.
#include "beamforming/cell_echoes.hpp"
#include "beamforming/synthesize.hpp"
#include "support/test.hpp"

namespace insonify::cell_tests {

/// Correlation of the intensities of two beams, over cells that all expect the same.
class BeamLikeness {
 public:
  void add(double a, double b) { a_ += a, b_ += b, aa_ += a * a, bb_ += b * b, ab_ += a * b, ++n_; }
  double value() const { return (n_ * ab_ - a_ * b_) / std::sqrt((n_ * aa_ - a_ * a_) * (n_ * bb_ - b_ * b_)); }

 private:
  double a_ = 0, b_ = 0, aa_ = 0, bb_ = 0, ab_ = 0, n_ = 0;
};

// The middle beam hears the near half of each cell from one side and the far half from the other, and the last beam the
// near half alone. Pressures summed over the whole cell are far less alike. Of 1200 pairs, 0.1 is three standard errors of
// the difference.
TEST(DisplayCells, beams_that_hear_other_ranges_are_as_alike_as_those_of_samples) {
  const SonarHead samples =
      line_head({.beams = 9, .elements = 32, .field_of_view_deg = 8, .min_range = 2, .max_range = 3});
  const SonarHead head = cells_head(samples, 12);
  SurfaceEchoes ground = even_ground(8000);
  for (std::size_t i = 0; i < ground.id.size(); ++i) {
    const double cells =
        (0.5 * lossless.sound_speed * ground.echoes.delay[i] - head.gate.min_range) / head.gate.bin_size;
    ground.echoes.u[i] = cells - std::floor(cells) < 0.5 ? 0.028 : -0.028;
  }
  BeamLikeness of_drawn, of_samples;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    const ComplexGrid p = synthesize(drawn(ground, seed), samples, lossless, SynthesisMethod::gridded);
    const Grid<double> averaged = mean_over_cells(p.abs2(), samples.gate, head.gate),
                       cells = synthesize_cells(ground, {}, head, lossless, {.seed = seed});
    for (Eigen::Index cell = 0; cell < 12; ++cell)
      of_samples.add(averaged(4, cell), averaged(8, cell)), of_drawn.add(cells(4, cell), cells(8, cell));
  }
  EXPECT_GT(of_samples.value(), 0.5);
  EXPECT_NEAR(of_drawn.value(), of_samples.value(), 0.1);
}

/// Returns a surfel in each field of a grid, at a random place in it: `along` the range [m] by `aside` in u wide, evenly over
/// range 1.9 to 3.1 m.
SurfaceEchoes wide_surfels(double along, double aside, std::uint64_t seed) {
  SurfaceEchoes s;
  std::uint64_t id = 0;
  for (double low = 1.9; low < 3.1; low += along)
    for (double u = -0.4; u < 0.4; u += aside, ++id) {
      const auto at = random_uniform(seed, RandomStage::scene_points, {id, 0, 0});
      const double range = low + along * at[0];
      s.echoes.delay.push_back(2 * range / lossless.sound_speed);
      s.echoes.u.push_back(u + aside * at[1]);
      s.echoes.amplitude.push_back(std::polar(1.0, 4 * pi * range * centre / lossless.sound_speed));
      s.id.push_back(id);
    }
  s.power.assign(id, 1), s.depth.assign(id, static_cast<float>(along / 2));
  s.width.assign(id, static_cast<float>(aside / 2));
  constexpr double box = 0.866;  // half width of the box with the variance of a disc, in its radius
  s.disc.assign(id, {{static_cast<float>(0.5 * along / box), 0}, {0, static_cast<float>(0.5 * aside / box)}, true});
  return s;
}

// Surfels are nearly as long as a cell and as wide as a beam. As points they would leave 0.375 for 0.346 of samples, whose
// beams hear many echoes; as discs (E228) they leave 0.325. The standard error is 0.009.
TEST(DisplayCells, of_wide_surfels_have_beams_as_alike_as_samples_of_ground) {
  const SonarHead samples =
      line_head({.beams = 9, .elements = 32, .field_of_view_deg = 14, .min_range = 2, .max_range = 3});
  const SonarHead head = cells_head(samples, 12);
  const SurfaceEchoes ground = even_ground(20000);
  BeamLikeness of_drawn, of_samples;
  for (std::uint64_t seed = 1; seed <= 400; ++seed) {
    const SurfaceEchoes surfels = wide_surfels(0.8 * head.gate.bin_size, 0.06, seed);
    const ComplexGrid p = synthesize(drawn(ground, seed), samples, lossless, SynthesisMethod::gridded);
    const Grid<double> averaged = mean_over_cells(p.abs2(), samples.gate, head.gate),
                       cells = synthesize_cells(surfels, {}, head, lossless, {.seed = seed});
    for (Eigen::Index cell = 0; cell < 12; ++cell)
      for (Eigen::Index beam = 0; beam < 7; ++beam) {
        of_samples.add(averaged(beam, cell), averaged(beam + 2, cell));
        of_drawn.add(cells(beam, cell), cells(beam + 2, cell));
      }
  }
  EXPECT_NEAR(of_drawn.value(), of_samples.value(), 0.025);
}

// Echoes pass from one third of a cell to the next by and by, and keep their amplitudes. Thirds with amplitudes of their own
// leave 0.62 of the likeness after half a third, and those that echoes pass into at once 0.37, for 0.82 of samples.
TEST(DisplayCells, after_a_move_of_ranges_are_as_alike_as_samples) {
  const SonarHead samples =
      line_head({.beams = 9, .elements = 32, .field_of_view_deg = 24, .min_range = 2, .max_range = 3});
  const SonarHead head = cells_head(samples, 6);
  for (const double move : {0.25, 0.5, 1.0}) {
    BeamLikeness of_drawn, of_samples;
    for (std::uint64_t seed = 1; seed <= 40; ++seed) {
      SurfaceEchoes ground = even_ground(20000, seed);
      for (double& u : ground.echoes.u) u *= 0.3;
      const auto cells = [&] { return synthesize_cells(ground, {}, head, lossless, {.seed = seed}); };
      const auto averaged = [&] {
        const ComplexGrid p = synthesize(drawn(ground, seed), samples, lossless, SynthesisMethod::gridded);
        return mean_over_cells(p.abs2(), samples.gate, head.gate);
      };
      const Grid<double> before = cells(), before_of_samples = averaged();
      for (double& delay : ground.echoes.delay) delay += 2 * move * head.gate.bin_size / 3 / lossless.sound_speed;
      const Grid<double> after = cells(), after_of_samples = averaged();
      for (Eigen::Index cell = 0; cell < 6; ++cell)
        for (Eigen::Index beam = 0; beam < 9; ++beam) {
          of_drawn.add(before(beam, cell), after(beam, cell));
          of_samples.add(before_of_samples(beam, cell), after_of_samples(beam, cell));
        }
    }
    EXPECT_NEAR(of_drawn.value(), of_samples.value(), 0.05) << "thirds of a cell: " << move;
  }
}

}  // namespace insonify::cell_tests
