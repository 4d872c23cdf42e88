// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <cstdint>

// Kernels over raw pointers, compiled for several instruction sets and chosen at run time. They see no Eigen, so
// wider registers are safe here; without fused multiply-add every variant gives the same bits.
namespace insonify::kernels {

constexpr std::size_t lines_at_once = 8;   ///< neighbouring frequencies of a chunk
constexpr std::size_t times_at_once = 16;  ///< rows of a tile

/// Complex factors along a row of places, as polynomials of time. The highest power comes first; each power has a plane
/// of real and a plane of imaginary parts, `stride` numbers long.
struct TimeFactor {
  const float* power;
  std::size_t powers, stride;
};

/// line(n, g) = factor(g, time[n]) (re(n, g) + i im(n, g)), real and imaginary in turn, for a tile of times whose rows
/// have `stride` numbers; `count` a multiple of 8.
void weigh(TimeFactor factor, const float* time, const float* re, const float* im, std::size_t count,
           std::size_t stride, float* line);

/// Writes sum over `terms` of factor(g, time[n]) line(n, g), the inverse step of weigh. The lines of the terms lie
/// `plane` numbers apart, and the factors of the terms follow one another. The result holds the times of each position g
/// one after another, real and imaginary in turn.
void weigh_back(TimeFactor factor, const float* time, const float* line, std::size_t terms, std::size_t plane,
                std::size_t count, std::size_t stride, float* across);

/// Sums of complex rows, eight numbers at a time: out o = sum over i < ins[o] of factor(o, i) in i. `factor` is ordered
/// by group of eight numbers, out, and in (`stride` of them); each entry holds eight real and eight imaginary parts.
struct RowMix {
  const float* factor;
  std::size_t outs;
  const std::size_t* ins;
  std::size_t stride;
};

/// A tile by time and place, several planes of it.
struct TimePlanes {
  float* value;
  std::size_t positions, row, plane;  ///< a multiple of 8; numbers from row to row, and from plane to plane
};
/// Rows of places by time, several planes of them: place g is row[g], or `none`, which is one, too.
struct PositionRows {
  float* value;
  const std::uint32_t* row;
  std::uint32_t none;
  std::size_t length, plane;  ///< numbers from row to row, and from plane to plane
};
/// Mixes a tile into rows, or rows into a tile. `workspace` holds 2 * times_at_once * 8 numbers for each `in`.
void mix_to_rows(RowMix mix, TimePlanes from, PositionRows to, float* workspace);
void mix_from_rows(RowMix mix, PositionRows from, TimePlanes to, float* workspace);

/// Interpolation of a chunk of frequencies from harmonics to elements: element m takes `taps` rows from row[m] on.
struct ElementTaps {
  std::size_t elements, taps;
  const std::uint32_t* row;  ///< the first row of the taps of each element
  const float* weight;       ///< weights by element, tap and line
};

/// Powers of frequency at the lines of chunks.
struct LinePowers {
  std::size_t powers, stride;  ///< number of powers in use, and of powers stored per chunk
  const float* power;          ///< powers of frequency by chunk, power and line
};

/// Sums lines of complex numbers, one line per power of frequency, times those powers, for the chunks listed in
/// `chunk`. The lines lie `plane` numbers apart. Each chunk of the result holds lines_at_once real parts, then as many
/// imaginary ones; chunks are `stride` numbers apart.
void sum_powers(LinePowers powers, const float* line, std::size_t plane, const std::size_t* chunk, std::size_t count,
                float* to, std::size_t stride);

/// Passes a chunk through the elements: interpolates each element from `rows`, multiplies it by `factor` (by element
/// and line), and adds it to the rows `to`. A row holds lines_at_once real parts, then as many imaginary ones.
void through_elements(ElementTaps taps, const float* factor, const float* rows, float* to);

/// Adds one power of frequency of the chunks, laid out as by sum_powers, to a line of complex numbers. Chunk i begins
/// at number place[i] of the line.
void add_power(const float* line, std::size_t count, const float* power, std::size_t stride,
               const std::uint32_t* position, float* to);

}  // namespace insonify::kernels
