#pragma once
#include <cstddef>
#include <cstdint>

// Kernels over raw pointers, compiled for several instruction sets and chosen at run time. They see no Eigen, so
// wider registers are safe here; without fused multiply-add every variant gives the same bits.
namespace insonify::kernels {

constexpr std::size_t lines_at_once = 8;  ///< neighbouring frequencies of a chunk

/// A complex factor along a row of places that depends on time: polynomials of it, highest power first, each a plane of
/// real and one of imaginary parts, `stride` numbers long.
struct TimeFactor {
  const float* power;
  std::size_t powers, stride;
};

/// line(g) = factor(g, t) (re(g) + i im(g)), real and imaginary in turn; `count` a multiple of 8.
void weigh_row(TimeFactor factor, float t, const float* re, const float* im, std::size_t count, float* line);

/// Adds to re + i im what `factor` makes of a line of complex numbers.
void weigh_back(TimeFactor factor, float t, const float* line, std::size_t count, float* re, float* im);

/// Sums of complex rows, eight numbers at a time: out o = sum over i < ins[o] of factor(o, i) in i. `factor` has, by eight
/// numbers, out and in (of which there are `stride`), each real part twice, then of each imaginary part -im and im.
struct RowMix {
  const float* factor;
  std::size_t outs;
  const std::size_t* ins;
  std::size_t stride;
};

/// `in` and `out` are planes of `times` rows, `row` numbers apart; only numbers 8 first to 8 last are made.
struct MixedPlanes {
  const float* in;
  float* out;
  std::size_t in_plane, out_plane, row, times, first, last;
};
void mix_rows(RowMix mix, MixedPlanes planes);

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

/// Sums lines of complex numbers `plane` numbers apart, one for each power of frequency, times those powers, in the chunks
/// of `chunk`: of each lines_at_once real parts and as many imaginary ones, `stride` numbers apart.
void sum_powers(LinePowers powers, const float* line, std::size_t plane, const std::size_t* chunk, std::size_t count,
                float* to, std::size_t stride);

/// Adds to the rows `to` of a chunk, each lines_at_once real parts and as many imaginary ones, what elements give that
/// take it from `rows`, times `factor` by element and line.
void through_elements(ElementTaps taps, const float* factor, const float* rows, float* to);

/// Adds `count` rows of a chunk, times each power of frequency, to rows of complex numbers `stride` of them apart, and
/// `plane` of them from power to power.
void add_powers(LinePowers powers, const float* rows, std::size_t count, float* to, std::size_t stride,
                std::size_t plane);

/// A beam at `count` numbers, a multiple of 8: rows of a grid, `stride` apart, interpolated by weights.
void take_beam(const float* weight, const std::uint32_t* row, std::size_t terms, const float* grid, std::size_t stride,
               std::size_t count, float* beam);

}  // namespace insonify::kernels
