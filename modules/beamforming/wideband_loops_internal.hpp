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

/// How a chunk of frequencies is interpolated between harmonics to elements: `taps` rows from row[m] on, by line.
struct ElementTaps {
  std::size_t elements, taps;
  const std::uint32_t* row;  ///< by element
  const float* weight;       ///< by element, tap and line
};

/// Complex factors of elements and lines: start(m) step(m, l) rest(m, t(l)), the last a polynomial of `powers` complex
/// coefficients, highest first; none: 1.
struct ElementTurns {
  const float* start;  ///< by element: real, imaginary
  const float* step;   ///< by element: lines_at_once real parts, as many imaginary ones
  const float* rest;   ///< by element
  std::size_t powers;
  const float* t;  ///< by line
};

/// Chunks of a line of complex numbers, those of `chunk`: of each lines_at_once real parts and as many imaginary ones,
/// `stride` numbers apart.
void split_chunks(const float* line, const std::size_t* chunk, std::size_t count, float* to, std::size_t stride);

/// Adds what elements take from the rows of a chunk, each lines_at_once real parts and as many imaginary ones, times their
/// factors, to `x`: by element, in the same order.
void gather_elements(ElementTaps taps, ElementTurns turns, const float* rows, float* x);

/// The reverse: adds `x`, times its factors, to the rows.
void scatter_elements(ElementTaps taps, ElementTurns turns, const float* x, float* rows);

/// Adds the rows of a chunk, times a factor each, to rows of complex numbers `stride` of them apart.
void add_chunk(const float* rows, const float* factor, std::size_t count, float* to, std::size_t stride);

/// Adds to `sum` a beam at `count` (at most 32) times: the row of a grid interpolated by weights, times a polynomial
/// of time, `stride` of `factor` apart.
void add_beam(const float* weight, const std::uint32_t* row, std::size_t terms, const float* grid, std::size_t stride,
              TimeFactor factor, const float* t, std::size_t count, float* sum);

}  // namespace insonify::kernels
