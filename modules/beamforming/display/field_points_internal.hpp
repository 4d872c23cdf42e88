// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "beamforming/display/cell_row_internal.hpp"
#include "beamforming/display/looks_loops_internal.hpp"

namespace insonify {

/// A point in a cell.
struct PlacedPoint {
  FieldPoint point;
  std::uint32_t cell;
};
/// Points of some echoes; those beside an edge of a cell stand for each of two.
using PlacedPoints = UninitializedVector<PlacedPoint>;

/// Makes the points of which the fields of cells are the sums: one of an echo, or those of its disc (E183, E228).
class FieldPointMaker {
 public:
  /// Keeps references to all arguments, which must outlive it.
  FieldPointMaker(const DisplayPlan& plan, const SurfaceEchoes& surface, const CellOptions& options);

  /// Adds the points of echoes begin .. end - 1 of surfaces that are listed: echo i is number slot[i] of `echoes`, if there
  /// are so many. Sets the pressures of these.
  void add(std::size_t begin, std::size_t end, const std::vector<std::uint32_t>& slot,
           UninitializedVector<CellEcho>& echoes, PlacedPoints& points) const;

 private:
  struct DiscList;

  /// Place of echo i [cells], and its energy in a cell that holds all of it [Pa^2].
  double place_of(std::size_t i) const;
  double energy_of(std::size_t i) const;
  void list_disc(std::size_t i, std::uint32_t number, DiscList& discs) const;
  void add_discs(const DiscList& discs, UninitializedVector<CellEcho>& echoes, PlacedPoints& points) const;
  /// Adds echoes that are points.
  void add_single(const std::vector<std::size_t>& single, const std::vector<std::uint32_t>& slot,
                  UninitializedVector<CellEcho>& echoes, PlacedPoints& points) const;
  /// Adds a point at a place [cells] to its cell, and to the one beside it if it is near the edge.
  void add_point(float place, std::size_t node, const std::complex<float>& pressure, float power, std::uint32_t number,
                 PlacedPoints& points) const;

  const DisplayPlan& plan_;
  const SurfaceEchoes& surface_;
  const CellOptions& options_;
  double per_cell_length_;
  float edge_;  ///< half the way from a cell to the next [cells]
};

/// Returns the points of all blocks by cell, each cell's in the order of the blocks.
PointsByCell points_by_cell(const std::vector<PlacedPoints>& blocks, std::size_t cells, int threads);

}  // namespace insonify
