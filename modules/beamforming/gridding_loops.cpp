#include "beamforming/gridding_loops_internal.hpp"
#include "core/target_clones.hpp"

namespace insonify::kernels {
namespace {

#define INSONIFY_INLINE [[gnu::always_inline]] inline

/// Evaluates the polynomials of all lanes by Horner's rule.
template <std::size_t lanes, typename Real>
INSONIFY_INLINE void evaluate(Pieces<Real> p, Real t, Real* value) {
  for (std::size_t l = 0; l < lanes; ++l) value[l] = p.coefficient[l];
  for (std::size_t k = 1; k <= p.degree; ++k)
    for (std::size_t l = 0; l < lanes; ++l) value[l] = value[l] * t + p.coefficient[k * lanes + l];
}

template <std::size_t lanes, typename Real>
INSONIFY_INLINE void add_row(Real g_re, Real g_im, const Real* kernel, Real* __restrict x_re, Real* __restrict x_im) {
  for (std::size_t l = 0; l < lanes; ++l) x_re[l] += g_re * kernel[l];
  for (std::size_t l = 0; l < lanes; ++l) x_im[l] += g_im * kernel[l];
}

template <std::size_t lanes, typename Real>
INSONIFY_INLINE void grid_all(const GridTargets<Real>& s, std::size_t count, Pieces<Real> rows_of, std::size_t rows,
                              Pieces<Real> columns_of, Real* __restrict pulse, Real* x_re, Real* x_im,
                              std::size_t stride) {
  for (std::size_t i = 0; i < count; ++i) {
    Real kernel[lanes];
    evaluate<lanes>(columns_of, s.column_offset[i], kernel);
    for (std::size_t first = 0; first < rows_of.lanes; first += 8) {
      // The polynomials of eight rows at a time; their coefficients are rows_of.lanes apart.
      Real value[8];
      for (std::size_t l = 0; l < 8; ++l) value[l] = rows_of.coefficient[first + l];
      for (std::size_t k = 1; k <= rows_of.degree; ++k)
        for (std::size_t l = 0; l < 8; ++l)
          value[l] = value[l] * s.row_offset[i] + rows_of.coefficient[k * rows_of.lanes + first + l];
      for (std::size_t l = 0; l < 8; ++l) pulse[first + l] = value[l];
    }
    const std::size_t start = s.row[i] * stride + s.column[i];
    for (std::size_t n = 0; n < rows; ++n)
      add_row<lanes>(s.re[i] * pulse[n], s.im[i] * pulse[n], kernel, x_re + start + n * stride,
                     x_im + start + n * stride);
  }
}

/// Evaluates the polynomials of `count` lanes from `first` on, eight at a time.
template <typename Real>
INSONIFY_INLINE void evaluate_some(Pieces<Real> p, std::size_t first, std::size_t count, Real t, Real* value) {
  for (std::size_t l0 = 0; l0 < count; l0 += 8) {
    const Real* c = p.coefficient + first + l0;
    Real eight[8];
    for (std::size_t l = 0; l < 8; ++l) eight[l] = c[l];
    for (std::size_t k = 1; k <= p.degree; ++k)
      for (std::size_t l = 0; l < 8; ++l) eight[l] = eight[l] * t + c[k * p.lanes + l];
    for (std::size_t l = 0; l < 8; ++l) value[l0 + l] = eight[l];
  }
}

template <std::size_t lanes, typename Real>
INSONIFY_INLINE void grid_some(Real re, Real im, Real row_offset, Real column_offset, Pieces<Real> pulse_re,
                               Pieces<Real> pulse_im, std::size_t first, std::size_t rows, Pieces<Real> columns_of,
                               Real* __restrict scratch, Real* x_re, Real* x_im, std::size_t stride) {
  Real kernel[lanes];
  evaluate<lanes>(columns_of, column_offset, kernel);
  Real *g_re = scratch, *g_im = scratch + rows + 16;
  evaluate_some(pulse_re, first, rows, row_offset, g_re);
  evaluate_some(pulse_im, first, rows, row_offset, g_im);
  for (std::size_t n = 0; n < rows; ++n)
    add_row<lanes>(re * g_re[n] - im * g_im[n], re * g_im[n] + im * g_re[n], kernel, x_re + n * stride,
                   x_im + n * stride);
}

template <std::size_t lanes, typename Real>
INSONIFY_INLINE void grid_samples(const double* pulse_re, const double* pulse_im, std::size_t rows, Real offset,
                                  Pieces<Real> columns_of, Real* x_re, Real* x_im, std::size_t stride) {
  Real kernel[lanes];
  evaluate<lanes>(columns_of, offset, kernel);
  for (std::size_t n = 0; n < rows; ++n)
    add_row<lanes>(static_cast<Real>(pulse_re[n]), static_cast<Real>(pulse_im[n]), kernel, x_re + n * stride,
                   x_im + n * stride);
}

template <typename Real>
INSONIFY_INLINE void interpolate_rows(const Real* weight, const std::uint32_t* row, std::size_t terms, const Real* grid,
                                      std::size_t stride, std::size_t count, double* sum) {
  // Blocks of samples stay in registers while the terms are added.
  constexpr std::size_t block = 32;
  std::size_t n = 0;
  for (; n + block <= count; n += block) {
    Real part[block] = {};
    for (std::size_t k = 0; k < terms; ++k) {
      const Real* x = grid + row[k] * stride + n;
      for (std::size_t l = 0; l < block; ++l) part[l] += weight[k] * x[l];
    }
    for (std::size_t l = 0; l < block; ++l) sum[n + l] = static_cast<double>(part[l]);
  }
  for (; n < count; ++n) {
    Real part = 0;
    for (std::size_t k = 0; k < terms; ++k) part += weight[k] * grid[row[k] * stride + n];
    sum[n] = static_cast<double>(part);
  }
}

}  // namespace

INSONIFY_CLONES
void grid_pulses(const GridTargets<float>& s, std::size_t count, Pieces<float> rows_of, std::size_t rows,
                 Pieces<float> columns_of, float* scratch, float* x_re, float* x_im, std::size_t stride) {
  if (columns_of.lanes == 8)
    grid_all<8>(s, count, rows_of, rows, columns_of, scratch, x_re, x_im, stride);
  else
    grid_all<16>(s, count, rows_of, rows, columns_of, scratch, x_re, x_im, stride);
}

INSONIFY_CLONES
void grid_pulses(const GridTargets<double>& s, std::size_t count, Pieces<double> rows_of, std::size_t rows,
                 Pieces<double> columns_of, double* scratch, double* x_re, double* x_im, std::size_t stride) {
  if (columns_of.lanes == 8)
    grid_all<8>(s, count, rows_of, rows, columns_of, scratch, x_re, x_im, stride);
  else
    grid_all<16>(s, count, rows_of, rows, columns_of, scratch, x_re, x_im, stride);
}

INSONIFY_CLONES
void grid_pulse_rows(float re, float im, float row_offset, float column_offset, Pieces<float> pulse_re,
                     Pieces<float> pulse_im, std::size_t first, std::size_t rows, Pieces<float> columns_of,
                     float* scratch, float* x_re, float* x_im, std::size_t stride) {
  if (columns_of.lanes == 8)
    grid_some<8>(re, im, row_offset, column_offset, pulse_re, pulse_im, first, rows, columns_of, scratch, x_re, x_im,
                 stride);
  else
    grid_some<16>(re, im, row_offset, column_offset, pulse_re, pulse_im, first, rows, columns_of, scratch, x_re, x_im,
                  stride);
}

INSONIFY_CLONES
void grid_pulse_rows(double re, double im, double row_offset, double column_offset, Pieces<double> pulse_re,
                     Pieces<double> pulse_im, std::size_t first, std::size_t rows, Pieces<double> columns_of,
                     double* scratch, double* x_re, double* x_im, std::size_t stride) {
  if (columns_of.lanes == 8)
    grid_some<8>(re, im, row_offset, column_offset, pulse_re, pulse_im, first, rows, columns_of, scratch, x_re, x_im,
                 stride);
  else
    grid_some<16>(re, im, row_offset, column_offset, pulse_re, pulse_im, first, rows, columns_of, scratch, x_re, x_im,
                  stride);
}

INSONIFY_CLONES
void grid_sampled_pulse(const double* pulse_re, const double* pulse_im, std::size_t rows, float offset,
                        Pieces<float> columns_of, float* x_re, float* x_im, std::size_t stride) {
  if (columns_of.lanes == 8)
    grid_samples<8>(pulse_re, pulse_im, rows, offset, columns_of, x_re, x_im, stride);
  else
    grid_samples<16>(pulse_re, pulse_im, rows, offset, columns_of, x_re, x_im, stride);
}

INSONIFY_CLONES
void grid_sampled_pulse(const double* pulse_re, const double* pulse_im, std::size_t rows, double offset,
                        Pieces<double> columns_of, double* x_re, double* x_im, std::size_t stride) {
  if (columns_of.lanes == 8)
    grid_samples<8>(pulse_re, pulse_im, rows, offset, columns_of, x_re, x_im, stride);
  else
    grid_samples<16>(pulse_re, pulse_im, rows, offset, columns_of, x_re, x_im, stride);
}

INSONIFY_CLONES
void interpolate(const float* weight, const std::uint32_t* row, std::size_t terms, const float* grid,
                 std::size_t stride, std::size_t count, double* sum) {
  interpolate_rows(weight, row, terms, grid, stride, count, sum);
}

INSONIFY_CLONES
void interpolate(const double* weight, const std::uint32_t* row, std::size_t terms, const double* grid,
                 std::size_t stride, std::size_t count, double* sum) {
  interpolate_rows(weight, row, terms, grid, stride, count, sum);
}

INSONIFY_CLONES
void add_pulses(const double* weight, PulsePlaces places, const double* sample, std::size_t echoes, double* row) {
  for (std::size_t i = 0; i < echoes; ++i) {
    double* __restrict to = row + 2 * places.start[i];
    const double* __restrict from = sample + places.place[i];
    for (std::size_t k = 0; k < 2 * places.count[i]; ++k) to[k] += weight[i] * from[k];
  }
}

}  // namespace insonify::kernels
