#pragma once
#include <cstddef>

// Kernels over raw pointers, compiled for several instruction sets and chosen at run time. They see no Eigen, so
// wider registers are safe here; without fused multiply-add every variant gives the same bits.
namespace insonify::kernels {

constexpr std::size_t lines_at_once = 16;  ///< neighbouring frequencies of a chunk: one row of a plane

/// A chunk of a spectrum: one plane of real and one of imaginary parts, rows x lines_at_once.
struct SpectrumChunk {
  float *re, *im;
};

/// Filter along the rows: y(k) = tap[0] x(k) + sum_l tap[l] (x(k - l) + x(k + l)), l = 1 .. reach. `x` has at least
/// `reach` rows before its first and after its last.
void filter_rows(const float* tap, std::size_t reach, std::size_t rows, SpectrumChunk x, SpectrumChunk y);

/// Adds (i z)^n / n! x to y, z(k, l) = row_factor[k] line_factor[l].
void add_power(int n, std::size_t rows, const float* row_factor, const float* line_factor, SpectrumChunk x,
               SpectrumChunk y);

/// The same with z negative, and times weight(k, l), whose rows are `stride` numbers apart.
void add_weighted_power(int n, std::size_t rows, const float* row_factor, const float* line_factor, const float* weight,
                        std::size_t stride, SpectrumChunk x, SpectrumChunk y);

/// Splits 2 lines_at_once numbers, real and imaginary in turn, times `factor`.
void split_row(const float* row, float factor, float* re, float* im);
/// Puts them together again.
void merge_row(const float* re, const float* im, float factor, float* row);

}  // namespace insonify::kernels
