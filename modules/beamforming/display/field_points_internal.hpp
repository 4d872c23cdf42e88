// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "beamforming/display/cell_row_internal.hpp"

namespace insonify {

/// Points of the surfaces of some echoes, by echoes that have equally many.
struct PointList {
  /// One point of each echo: pressures [Pa], nodes in a period of u, and cells (kernels::PointCells).
  struct Points {
    UninitializedVector<float> re, im;
    UninitializedVector<std::int32_t> node, cell;
    UninitializedVector<std::uint32_t> in_cells;
  };
  UninitializedVector<std::uint32_t> echo;  ///< number of each echo
  UninitializedVector<float> power;         ///< expected square of the pressure of each of its points [Pa^2]
  std::vector<Points> points;
};
/// Points of some echoes, and how many stand in each cell; those beside an edge of a cell stand in two.
struct DrawnPoints {
  PointList discs, single;
  std::vector<std::size_t> in_cell;
};

/// Makes the points of which the fields of cells are the sums: one of an echo, or those of its disc (E183, E228).
class FieldPointMaker {
 public:
  /// Keeps references to all arguments, which must outlive it.
  FieldPointMaker(const DisplayPlan& plan, const SurfaceEchoes& surface, const CellOptions& options);

  /// Returns the points of echoes begin .. end - 1 of surfaces that are listed: echo i is number slot[i] of `echoes`, if there
  /// are so many. Sets the pressures of these.
  DrawnPoints draw(std::size_t begin, std::size_t end, const UninitializedVector<std::uint32_t>& slot,
                   UninitializedVector<CellEcho>& echoes) const;
  /// Returns the points of all blocks of echoes by cell, each cell's in the order of the blocks.
  PointsByCell by_cell(std::vector<DrawnPoints>& blocks) const;

 private:
  struct Rings;
  /// Place of echo i [cells], and its energy in a cell that holds all of it [Pa^2].
  double place_of(std::size_t i) const;
  double energy_of(std::size_t i) const;
  /// Draws echoes that are discs into a list of as many rings of points; sets the pressures of the echoes.
  void draw_discs(const std::vector<std::size_t>& discs, const UninitializedVector<std::uint32_t>& slot,
                  UninitializedVector<CellEcho>& echoes, PointList& list) const;
  void add_rings(std::size_t i, std::uint32_t number, Rings& rings) const;
  void draw_rings(Rings& rings, std::size_t at, UninitializedVector<CellEcho>& echoes, PointList& list) const;
  /// Draws echoes that are points.
  PointList draw_single(const std::vector<std::size_t>& single, const UninitializedVector<std::uint32_t>& slot,
                        UninitializedVector<CellEcho>& echoes) const;
  /// Sets the cells of points from `at` on that are at `place` [cells].
  void place(const float* place, std::size_t count, std::size_t at, PointList::Points& points) const;

  const DisplayPlan& plan_;
  const SurfaceEchoes& surface_;
  const CellOptions& options_;
  double per_cell_length_;
};

}  // namespace insonify
