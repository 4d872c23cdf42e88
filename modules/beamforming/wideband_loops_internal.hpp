#pragma once
#include <cstddef>
#include <cstdint>

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

/// How strongly wavefronts bend, by frequency.
struct BentLines {
  const float* phase;               ///< per square of a place in wavelengths
  const float* squared_wavelength;  ///< [m^2]
  const float* place_end;           ///< places beyond the array's ends count as these, squared [wavelengths^2]
};

/// Adds scale (i z)^n x to y, z(k, l) = place[k] lines.phase[l].
void add_power(int n, float scale, std::size_t rows, const float* place, BentLines lines, SpectrumChunk x,
               SpectrumChunk y);

/// The same with z negative, and times weight(k, l), whose rows are `stride` numbers apart.
void add_weighted_power(int n, float scale, std::size_t rows, const float* place, BentLines lines, const float* weight,
                        std::size_t stride, SpectrumChunk x, SpectrumChunk y);

/// The same along the rows for an odd function of direction: y(k) = sum_l tap[l] (x(k - l) - x(k + l)), l = 1 .. reach.
void filter_rows_odd(const float* tap, std::size_t reach, std::size_t rows, SpectrumChunk x, SpectrumChunk y);

/// Adds shift[k] (place y^2 - cubic) weight(k, l) x to y, y^2 the square of the place in metres; without `weight`, 1.
void add_cubic(const float* shift, float cubic, std::size_t rows, const float* place, BentLines lines,
               const float* weight, std::size_t stride, SpectrumChunk x, SpectrumChunk y);

/// Splits 2 lines_at_once numbers, real and imaginary in turn, times `factor`.
void split_row(const float* row, float factor, float* re, float* im);
/// Two planes become one row of numbers, real and imaginary in turn.
void merge_planes(const float* re, const float* im, std::size_t count, float* row);

/// sum(n) = scale sum_k weight[k] grid[row[k] * stride + n] for n < count, added to what is there or instead of it.
void interpolate_scaled(const float* weight, const std::uint32_t* row, std::size_t terms, const float* grid,
                        std::size_t stride, std::size_t count, double scale, bool add, double* sum);

/// For places at `range` from the array's centre in direction `u` (direction cosine along the array), as seen from `y`
/// on the array: how much longer the path is [m], range and direction cosine from there, and cosine and sine of that
/// path in waves, `waves` of them to a metre.
void see_from(double y, double waves, std::size_t count, const double* range, const double* u, double* extra,
              double* range_there, double* u_there, double* cosine, double* sine);

/// Points of an image by direction and time, in grid steps; `excess` is what the second field weighs.
struct ImagePoints {
  const double *row, *column;
  const float* excess;
};

/// Interpolates rows of complex numbers, `stride` of them apart, with an even kernel of eight steps in both directions;
/// coefficients (degree + 1) x 8 of its polynomials. Without `second` it is not added. Writes real and imaginary parts.
void interpolate_points(ImagePoints at, std::size_t count, const float* coefficient, std::size_t degree,
                        const float* field, const float* second, std::size_t stride, float* re, float* im);

/// Puts them together again.
void merge_row(const float* re, const float* im, float factor, float* row);

}  // namespace insonify::kernels
