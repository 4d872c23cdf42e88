// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>

// Loops over points of echoes, as those of looks_loops_internal.hpp.
namespace insonify::kernels {

/// Sets re and im to complex normal numbers of mean power 1, one for each id: from 64 mixed bits twice, for noise that
/// needs no counter of its own (E187).
void draw_normals(std::uint64_t seed, const std::uint64_t* id, std::size_t count, double* re, double* im);

/// Points of a disc whose echoes make up that of the disc: two on each of two axes at right angles.
constexpr std::size_t points_of_disc = 4;
/// Echoes of discs: place of the middle [cells], u, phase, root of the energy of a point, and how place, phase [cycles] and u
/// change from the middle to the edge along two axes of each.
struct Discs {
  const double *place, *u, *re, *im, *root;
  std::array<const double*, 2> cycles, to_edge;
  double cells_per_cycle, nodes_per_u, last_node;
};
/// Points of discs: random pressures, places [cells] and nodes of u.
struct DiscPoints {
  std::array<float*, points_of_disc> re, im, place;
  std::array<std::int32_t*, points_of_disc> node;
};
/// Sets the points of discs, `count` in all. They are so far from the middle that they have the variance of the disc, in
/// directions that follow from seed and id, as their amplitudes do (E228).
void draw_discs(std::uint64_t seed, const std::uint64_t* id, const Discs& discs, std::size_t count,
                const DiscPoints& points);

/// Rules for places of points: cells and the nodes of a period of u.
struct PlaceRule {
  std::int32_t last_cell;
  float edge;                        ///< half the way from a cell to the next [cells]
  float steps_per_cell, last_share;  ///< steps and last index of the table of shares (E183)
  std::int32_t period;               ///< [nodes]
  const float* turn;                 ///< factors of pressures by nodes, real and imaginary parts in turn; nullptr: 1
};
/// The cell of each point, -1 if it is in none; and as one number where it is in there, and in a cell beside (InCells).
struct PointCells {
  std::int32_t* cell;
  std::uint32_t* in_cells;
};
/// Places of a point in the table of shares: in its cell, and in the cell before (-1) or behind (1); 0: only in its own.
struct InCells {
  std::uint32_t share, share_beside;
  std::int32_t beside;
  static constexpr int bits = 15;
  static InCells of(std::uint32_t packed) {
    constexpr std::uint32_t mask = (1U << bits) - 1;
    return {packed & mask, packed >> bits & mask, static_cast<std::int32_t>(packed >> 2 * bits) - 1};
  }
};
/// Sets the cells of points at `place` [cells], `count` in all. Turns their pressures re and im, and takes whole periods from
/// their nodes.
void place_points(const float* place, std::size_t count, const PlaceRule& rule, std::int32_t* node, float* re,
                  float* im, const PointCells& to);

}  // namespace insonify::kernels
