// SPDX-License-Identifier: BSD-3-Clause
// Tests how alike beams are in drawn display cells (E183): against means of samples.
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
// near half alone. Pressures summed over the whole cell are far less alike.
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

}  // namespace insonify::cell_tests
