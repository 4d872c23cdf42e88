#pragma once
#include <cstddef>
#include <cstdint>

// Kernels over raw pointers, compiled for several instruction sets and chosen at run time. They see no Eigen, so
// wider registers are safe here; without fused multiply-add every variant gives the same bits.
namespace insonify::kernels {

/// Polynomials for all columns or rows of one echo: (degree + 1) x lanes, highest power first.
template <typename Real>
struct Pieces {
  const Real* coefficient;
  std::size_t degree, lanes;
};

/// Where and how strongly echoes are gridded: one entry per echo in every array.
template <typename Real>
struct GridPlaces {
  const std::uint32_t* row;     ///< first row
  const std::uint32_t* column;  ///< first column
  const Real* row_offset;       ///< t in [-1, 1] for the row polynomials
  const Real* column_offset;    ///< t in [-1, 1] for the column polynomials
  const Real *re, *im;          ///< amplitude
};

/// Adds amplitude x pulse(row) x kernel(column) to the planes x_re, x_im (rows x stride), over `rows` rows and the
/// columns' lanes, 8 or 16. `scratch` holds rows.lanes numbers.
void grid(const GridPlaces<float>& grids, std::size_t count, Pieces<float> rows_of, std::size_t rows,
          Pieces<float> columns_of, float* scratch, float* x_re, float* x_im, std::size_t stride);
void grid(const GridPlaces<double>& grids, std::size_t count, Pieces<double> rows_of, std::size_t rows,
          Pieces<double> columns_of, double* scratch, double* x_re, double* x_im, std::size_t stride);

/// One echo of a complex pulse, of which only the rows [first, first + rows) are gridded, onto x_re, x_im from the first of
/// them on. `scratch` holds 2 (rows + 16) numbers.
void grid_rows(float re, float im, float row_offset, float column_offset, Pieces<float> pulse_re,
               Pieces<float> pulse_im, std::size_t first, std::size_t rows, Pieces<float> columns_of, float* scratch,
               float* x_re, float* x_im, std::size_t stride);
void grid_rows(double re, double im, double row_offset, double column_offset, Pieces<double> pulse_re,
               Pieces<double> pulse_im, std::size_t first, std::size_t rows, Pieces<double> columns_of, double* scratch,
               double* x_re, double* x_im, std::size_t stride);

/// The same for one echo whose pulse is given sample by sample, complex.
void grid_pulse(const double* pulse_re, const double* pulse_im, std::size_t rows, float column_offset,
                Pieces<float> columns_of, float* x_re, float* x_im, std::size_t stride);
void grid_pulse(const double* pulse_re, const double* pulse_im, std::size_t rows, double column_offset,
                Pieces<double> columns_of, double* x_re, double* x_im, std::size_t stride);

/// sum(n) = sum_k weight[k] grid[row[k] * stride + n] for n < count: one beam from the rows of a grid.
void interpolate(const float* weight, const std::uint32_t* row, std::size_t terms, const float* grid,
                 std::size_t stride, std::size_t count, double* sum);
void interpolate(const double* weight, const std::uint32_t* row, std::size_t terms, const double* grid,
                 std::size_t stride, std::size_t count, double* sum);

/// Where samples of pulses, complex, go: first bin, bins, and first number among the samples; one entry per echo in
/// every array.
struct PulsePlaces {
  const std::uint32_t *start, *count, *place;
};

/// Adds weight[i] x pulse i to `row`, real and imaginary in turn, one echo after the other.
void add_pulses(const double* weight, PulsePlaces places, const double* sample, std::size_t echoes, double* row);

}  // namespace insonify::kernels
