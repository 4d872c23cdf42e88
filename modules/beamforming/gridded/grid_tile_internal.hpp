// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <memory>
#include <span>
#include <vector>

#include "beamforming/gridded/beam_transform_internal.hpp"
#include "beamforming/gridded/brick_loops_internal.hpp"
#include "beamforming/gridded/gridding_plan_internal.hpp"
#include "beamforming/pulses/gaussian_batch_internal.hpp"

namespace insonify {

/// The grid over bins, u and v of one tile of bins. The grid consists of bricks; a brick holds all bins of some columns
/// of one line. Only bricks that contain echoes exist, because surfaces fill few bricks of a planar array. A line array
/// has one line and one brick.
template <typename Real>
class GridTile {
 public:
  using List = std::span<const std::uint32_t>;

  /// Keeps a reference to `plan`.
  explicit GridTile(const GriddingPlan<Real>& plan);

  /// Grids the listed echoes (E13), in order, on the tile that begins with bin `first_bin`. Several calls give the same
  /// bits as one call with all echoes.
  void add(const Echoes& echoes, const PulseReach& reach, List list, std::size_t first_bin);
  /// Forms bins [first, last) of all beams, then empties the tile. Adds the energy of the echoes to `gridded` and the
  /// energy of the beams to `received` [Pa^2 bins].
  void form_beams(const BeamTransform<Real>& transform, std::size_t first, std::size_t last, ComplexGrid& pressure,
                  double& gridded, double& received);

 private:
  /// Real and imaginary plane, tile rows x stride numbers each.
  struct Brick {
    explicit Brick(std::size_t numbers) : sum(numbers) {}
    Aligned<Real> sum;
    std::vector<Real> flushed{};            // sums of earlier echoes, if there are many
    std::size_t since_flush = 0, line = 0;  // echoes added since sums were flushed
  };

  /// Sets the unit from the first echoes, or from later echoes that are so loud that the earlier ones do not count.
  /// Returns false if all echoes are silent.
  bool set_unit(const Echoes& echoes, List list);
  Brick& brick_at(std::size_t line, std::size_t block);
  /// Flushes the sums of a brick if single precision could not take another echo; returns the brick.
  Brick& flushed(Brick& brick);
  void add_gaussians(const Echoes& echoes, List list, std::size_t first_bin);
  /// Adds the sampled pulses to the bricks of a planar array.
  void add_to_lines(const Echoes& echoes, List list);
  // Sweeps, only their samples on this tile. Planned sweeps keep their shape under absorption; others are sampled.
  void add_planned_sweeps(const Echoes& echoes, List list, std::size_t first_bin);
  void add_sampled_sweeps(const Echoes& echoes, const PulseReach& reach, List list, std::size_t first_bin);
  /// Sets the rows of beams [first, first + rows_at_a_time) on the grid of a line array.
  void weigh_rows(std::size_t first);
  void clear();

  const GriddingPlan<Real>& plan_;
  std::size_t columns_, stride_;  // of a brick; with those that pulses of its last columns reach
  std::size_t blocks_, plane_;    // of columns; numbers in a plane of a brick
  std::vector<Brick*> brick_;     // lines x blocks; null: none
  std::vector<std::vector<Brick*>> of_block_;
  std::vector<std::unique_ptr<Brick>> room_;
  std::size_t used_ = 0;          // of room_
  double unit_ = 0, energy_ = 0;  // a power of two [Pa]; of all echoes [unit^2 bins]
  GaussianBatch<Real> pulses_;
  std::vector<Real> scratch_;
  Aligned<Real> re_, im_;  // parts of the values of planar arrays: rows x bins x columns of all blocks
  Aligned<std::complex<Real>> grid_;
};

}  // namespace insonify
