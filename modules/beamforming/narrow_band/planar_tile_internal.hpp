#pragma once
#include <memory>
#include <span>
#include <vector>

#include "beamforming/narrow_band/beam_transform_internal.hpp"
#include "beamforming/narrow_band/grid_echoes_internal.hpp"
#include "beamforming/narrow_band/planar_loops_internal.hpp"
#include "beamforming/narrow_band/planar_plan_internal.hpp"

namespace insonify {

/// The grid over bins, u and v of one tile of bins. It consists of bricks, each all bins of some columns of one line,
/// which are there where echoes are: surfaces fill few of them.
template <typename Real>
class PlanarTile {
 public:
  /// Keeps a reference to `plan`.
  explicit PlanarTile(const PlanarPlan<Real>& plan);

  /// Grids the listed echoes (E13), which have v, in order, on the tile that begins with bin `first_bin`; returns their
  /// energy [input.unit^2 bins].
  double add(const GriddingInput& input, std::span<const std::uint32_t> list, std::size_t first_bin);
  /// Forms all beams and returns their energy, as BeamTransform; then the tile is empty.
  double form_beams(const BeamTransform<Real>& transform, double unit, std::size_t first, std::size_t last,
                    ComplexGrid& pressure);

 private:
  /// Real and imaginary plane, tile rows x brick_stride numbers each.
  struct Brick {
    explicit Brick(std::size_t numbers) : sum(numbers) {}
    AlignedArray<Real, Real> sum;
    std::vector<Real> flushed{};  // sums of earlier echoes, if there are many
    std::size_t since_flush = 0;
    std::size_t line = 0;
  };

  Brick& brick_at(std::size_t line, std::size_t block);
  void add_batch(const Echoes& echoes, std::span<const std::uint32_t> list);
  /// Sets the rows of beams [first, first + rows_at_a_time) on the grid of a line array.
  void weigh_rows(std::size_t first);
  void clear();

  const PlanarPlan<Real>& plan_;
  std::size_t blocks_, plane_;  // of columns; numbers in a plane of a brick
  std::vector<Brick*> brick_;   // lines x blocks; null: none
  std::vector<std::vector<Brick*>> of_block_;
  std::vector<std::unique_ptr<Brick>> room_;
  std::size_t used_ = 0;  // of room_
  GaussianBatch<Real> pulses_;
  AlignedArray<Real, Real> re_, im_;  // rows x bins x columns of all blocks
  AlignedArray<std::complex<Real>, Real> grid_;
};

}  // namespace insonify
