// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <cstdint>

// Kernels over raw pointers, compiled for several instruction sets and chosen at run time. They see no Eigen, so
// wider registers are safe here; without fused multiply-add every variant gives the same bits.
namespace insonify::kernels {

constexpr std::size_t lines_at_once = 8;   ///< neighbouring frequencies of a chunk
constexpr std::size_t times_at_once = 16;  ///< rows of a tile

/// Complex factors along a row of places that depend on time: polynomials of it, highest power first, each a plane of
/// real and one of imaginary parts, `stride` numbers long.
struct TimeFactor {
  const float* power;
  std::size_t powers, stride;
};

/// line(n, g) = factor(g, time[n]) (re(n, g) + i im(n, g)), real and imaginary in turn, for a tile of times whose rows
/// have `stride` numbers; `count` a multiple of 8.
void weigh(TimeFactor factor, const float* time, const float* re, const float* im, std::size_t count,
           std::size_t stride, float* line);

/// Sums over `terms`, whose lines lie `plane` numbers apart, of factor(g, time[n]) line(n, g): of each place g the
/// times one after another, real and imaginary in turn. The factors of terms follow one another.
void weigh_back(TimeFactor factor, const float* time, const float* line, std::size_t terms, std::size_t plane,
                std::size_t count, std::size_t stride, float* across);

/// Sums of complex rows, eight numbers at a time: out o = sum over i < ins[o] of factor(o, i) in i. `factor` has, by
/// eight numbers, out and in (of which there are `stride`), eight real parts and eight imaginary ones.
struct RowMix {
  const float* factor;
  std::size_t outs;
  const std::size_t* ins;
  std::size_t stride;
};

/// A tile by time and place, several planes of it.
struct TimePlanes {
  float* value;
  std::size_t places, row, plane;  ///< a multiple of 8; numbers from row to row, and from plane to plane
};
/// Rows of places by time, several planes of them: place g is row[g], or `none`, which is one, too.
struct PlaceRows {
  float* value;
  const std::uint32_t* row;
  std::uint32_t none;
  std::size_t length, plane;  ///< numbers from row to row, and from plane to plane
};
/// Mixes a tile into rows, or rows into a tile; `room` for 2 * times_at_once * 8 numbers of each in.
void mix_to_rows(RowMix mix, TimePlanes from, PlaceRows to, float* room);
void mix_from_rows(RowMix mix, PlaceRows from, TimePlanes to, float* room);

/// How a chunk of frequencies is interpolated between harmonics to elements: `taps` rows from row[m] on, by line.
struct ElementTaps {
  std::size_t elements, taps;
  const std::uint32_t* row;  ///< by element
  const float* weight;       ///< by element, tap and line
};

/// Powers of frequency at the lines of chunks.
struct LinePowers {
  std::size_t powers, stride;  ///< how many, and of how many by chunk
  const float* power;          ///< by chunk, power and line
};

/// Sums lines of complex numbers `plane` numbers apart, one for each power of frequency, times those powers, in the
/// chunks of `chunk`: of each lines_at_once real parts and as many imaginary ones, `stride` numbers apart.
void sum_powers(LinePowers powers, const float* line, std::size_t plane, const std::size_t* chunk, std::size_t count,
                float* to, std::size_t stride);

/// Adds to the rows `to` of a chunk, each lines_at_once real parts and as many imaginary ones, what elements give that
/// take it from `rows`, times `factor` by element and line.
void through_elements(ElementTaps taps, const float* factor, const float* rows, float* to);

/// Adds lines of complex numbers, as sum_powers makes them, times one power of frequency, to a line, each chunk from
/// number place[i] on.
void add_power(const float* line, std::size_t count, const float* power, std::size_t stride, const std::uint32_t* place,
               float* to);

/// A beam at `count` numbers, a multiple of 8: rows of a grid, `stride` apart, interpolated by weights.
void take_beam(const float* weight, const std::uint32_t* row, std::size_t terms, const float* grid, std::size_t stride,
               std::size_t count, float* beam);

}  // namespace insonify::kernels
