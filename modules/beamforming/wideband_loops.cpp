#include <cmath>
#include <numbers>

#include "beamforming/wideband_loops_internal.hpp"
#include "core/target_clones.hpp"

namespace insonify::kernels {
namespace {

constexpr std::size_t lines = lines_at_once;

#define INSONIFY_INLINE [[gnu::always_inline]] inline

using Eight = float __attribute__((vector_size(32)));

INSONIFY_INLINE void load(const float* from, Eight& eight) { __builtin_memcpy(&eight, from, sizeof eight); }

/// Filters one plane with an even or odd set of taps.
template <bool odd>
INSONIFY_INLINE void filter_plane(const float* tap, std::size_t reach, std::size_t rows, const float* x, float* y) {
  constexpr std::size_t half = lines / 2;
  for (std::size_t k = 0; k < 2 * rows; ++k) {
    const float* here = x + k * half;
    Eight sum, before, after;
    load(here, sum);
    sum *= tap[0];
    for (std::size_t l = 1; l <= reach; ++l) {
      load(here - l * lines, before);
      load(here + l * lines, after);
      sum += tap[l] * (odd ? before - after : before + after);
    }
    __builtin_memcpy(y + k * half, &sum, sizeof sum);
  }
}

/// scale z^n.
INSONIFY_INLINE void power_of(int n, float scale, float sign, float place, BentLines bent, float* power) {
  for (std::size_t c = 0; c < lines; ++c) power[c] = scale;
  float phase[lines];
  for (std::size_t c = 0; c < lines; ++c)
    phase[c] = sign * (place < bent.place_end[c] ? place : bent.place_end[c]) * bent.phase[c];
  for (int j = 0; j < n; ++j)
    for (std::size_t c = 0; c < lines; ++c) power[c] *= phase[c];
}

/// Adds i^n power x to y.
INSONIFY_INLINE void add_turned(int n, const float* power, const float* __restrict x_re, const float* __restrict x_im,
                                float* __restrict y_re, float* __restrict y_im) {
  const float cosine = n % 4 == 0 ? 1.0F : n % 4 == 2 ? -1.0F : 0.0F;
  if (n % 2 == 0) {
    for (std::size_t c = 0; c < lines; ++c) y_re[c] += cosine * power[c] * x_re[c];
    for (std::size_t c = 0; c < lines; ++c) y_im[c] += cosine * power[c] * x_im[c];
  } else {
    const float sine = n % 4 == 1 ? 1.0F : -1.0F;
    for (std::size_t c = 0; c < lines; ++c) y_re[c] -= sine * power[c] * x_im[c];
    for (std::size_t c = 0; c < lines; ++c) y_im[c] += sine * power[c] * x_re[c];
  }
}

/// sin and cos of 2 pi x by their series over half the angle, to 1e-7.
INSONIFY_INLINE void turn(double x, double* cosine, double* sine) {
  constexpr double whole = 6755399441055744.0;  // adding and subtracting this rounds to an integer
  const double h = std::numbers::pi * (x - ((x + whole) - whole)), q = h * h;
  const double s = h * (1 + q * (-1.0 / 6 + q * (1.0 / 120 + q * (-1.0 / 5040 + q * (1.0 / 362880 - q / 39916800)))));
  const double c =
      1 + q * (-0.5 + q * (1.0 / 24 + q * (-1.0 / 720 + q * (1.0 / 40320 + q * (-1.0 / 3628800 + q / 479001600)))));
  *cosine = 1 - 2 * s * s;
  *sine = 2 * s * c;
}

/// The kernel at eight places, `low` the position less half its width; returns the first place.
INSONIFY_INLINE std::size_t kernel_at(double low, const float* coefficient, std::size_t degree, Eight& value) {
  const double first = std::ceil(low);
  const auto t = static_cast<float>(2 * (first - low) - 1);
  load(coefficient, value);
  for (std::size_t k = 1; k <= degree; ++k) {
    Eight next;
    load(coefficient + 8 * k, next);
    value = value * t + next;
  }
  return static_cast<std::size_t>(first);
}

/// Adds eight rows, weighted, of eight complex numbers each.
INSONIFY_INLINE void add_rows(const Eight& weight, const float* x, std::size_t stride, Eight& low, Eight& high) {
  for (std::size_t k = 0; k < 8; ++k) {
    Eight first, second;
    load(x + 2 * k * stride, first);
    load(x + 2 * k * stride + 8, second);
    low += weight[k] * first;
    high += weight[k] * second;
  }
}

}  // namespace

INSONIFY_CLONES
void see_from(double y, double waves, std::size_t count, const double* range, const double* u, double* extra,
              double* range_there, double* u_there, double* cosine, double* sine) {
  for (std::size_t k = 0; k < count; ++k) {
    const double r = range[k], there = std::sqrt(r * r - 2 * r * y * u[k] + y * y);  // (E61)
    range_there[k] = there;
    u_there[k] = (r * u[k] - y) / there;
    extra[k] = there - r;
  }
  for (std::size_t k = 0; k < count; ++k) turn(waves * extra[k], cosine + k, sine + k);
}

INSONIFY_CLONES
void interpolate_points(ImagePoints at, std::size_t count, const float* coefficient, std::size_t degree,
                        const float* field, const float* second, std::size_t stride, float* re, float* im) {
  for (std::size_t i = 0; i < count; ++i) {
    Eight across, along, low = {}, high = {};
    const std::size_t row = kernel_at(at.row[i] - 4, coefficient, degree, across);
    const std::size_t place = 2 * (row * stride + kernel_at(at.column[i] - 4, coefficient, degree, along));
    add_rows(across, field + place, stride, low, high);
    if (second) add_rows(across * at.excess[i], second + place, stride, low, high);
    using Places = int __attribute__((vector_size(32)));
    const Eight sum = low * __builtin_shuffle(along, Places{0, 0, 1, 1, 2, 2, 3, 3}) +
                      high * __builtin_shuffle(along, Places{4, 4, 5, 5, 6, 6, 7, 7});
    re[i] = (sum[0] + sum[2]) + (sum[4] + sum[6]);
    im[i] = (sum[1] + sum[3]) + (sum[5] + sum[7]);
  }
}

INSONIFY_CLONES
void filter_rows(const float* tap, std::size_t reach, std::size_t rows, SpectrumChunk x, SpectrumChunk y) {
  filter_plane<false>(tap, reach, rows, x.re, y.re);
  filter_plane<false>(tap, reach, rows, x.im, y.im);
}

INSONIFY_CLONES
void add_power(int n, float scale, std::size_t rows, const float* place, BentLines bent, SpectrumChunk x,
               SpectrumChunk y) {
  float power[lines];
  for (std::size_t k = 0; k < rows; ++k) {
    power_of(n, scale, 1, place[k], bent, power);
    add_turned(n, power, x.re + k * lines, x.im + k * lines, y.re + k * lines, y.im + k * lines);
  }
}

INSONIFY_CLONES
void add_weighted_power(int n, float scale, std::size_t rows, const float* place, BentLines bent, const float* weight,
                        std::size_t stride, SpectrumChunk x, SpectrumChunk y) {
  float power[lines];
  for (std::size_t k = 0; k < rows; ++k) {
    power_of(n, scale, -1, place[k], bent, power);
    for (std::size_t c = 0; c < lines; ++c) power[c] *= weight[k * stride + c];
    add_turned(n, power, x.re + k * lines, x.im + k * lines, y.re + k * lines, y.im + k * lines);
  }
}

INSONIFY_CLONES
void filter_rows_odd(const float* tap, std::size_t reach, std::size_t rows, SpectrumChunk x, SpectrumChunk y) {
  filter_plane<true>(tap, reach, rows, x.re, y.re);
  filter_plane<true>(tap, reach, rows, x.im, y.im);
}

INSONIFY_CLONES
void add_cubic(const float* shift, float cubic, std::size_t rows, const float* place, BentLines bent,
               const float* weight, std::size_t stride, SpectrumChunk x, SpectrumChunk y) {
  float factor[lines];
  for (std::size_t k = 0; k < rows; ++k) {
    for (std::size_t c = 0; c < lines; ++c)
      factor[c] = shift[k] *
                  ((place[k] < bent.place_end[c] ? place[k] : bent.place_end[c]) * bent.squared_wavelength[c] - cubic);
    if (weight)
      for (std::size_t c = 0; c < lines; ++c) factor[c] *= weight[k * stride + c];
    for (std::size_t c = 0; c < lines; ++c) y.re[k * lines + c] += factor[c] * x.re[k * lines + c];
    for (std::size_t c = 0; c < lines; ++c) y.im[k * lines + c] += factor[c] * x.im[k * lines + c];
  }
}

INSONIFY_CLONES
void split_row(const float* row, float factor, float* re, float* im) {
  for (std::size_t c = 0; c < lines; ++c) {
    re[c] = factor * row[2 * c];
    im[c] = factor * row[2 * c + 1];
  }
}

INSONIFY_CLONES
void merge_planes(const float* re, const float* im, std::size_t count, float* row) {
  for (std::size_t k = 0; k < count; ++k) {
    row[2 * k] = re[k];
    row[2 * k + 1] = im[k];
  }
}

INSONIFY_CLONES
void interpolate_scaled(const float* weight, const std::uint32_t* row, std::size_t terms, const float* grid,
                        std::size_t stride, std::size_t count, double scale, bool add, double* sum) {
  // Blocks of samples stay in registers while the terms are added.
  constexpr std::size_t block = 32;
  for (std::size_t n0 = 0; n0 < count; n0 += block) {
    const std::size_t here = count - n0 < block ? count - n0 : block;
    float part[block] = {};
    if (here == block)
      for (std::size_t k = 0; k < terms; ++k)
        for (std::size_t n = 0; n < block; ++n) part[n] += weight[k] * grid[row[k] * stride + n0 + n];
    else
      for (std::size_t k = 0; k < terms; ++k)
        for (std::size_t n = 0; n < here; ++n) part[n] += weight[k] * grid[row[k] * stride + n0 + n];
    for (std::size_t n = 0; n < here; ++n)
      sum[n0 + n] = (add ? sum[n0 + n] : 0.0) + scale * static_cast<double>(part[n]);
  }
}

INSONIFY_CLONES
void merge_row(const float* re, const float* im, float factor, float* row) {
  for (std::size_t c = 0; c < lines; ++c) {
    row[2 * c] = factor * re[c];
    row[2 * c + 1] = factor * im[c];
  }
}

}  // namespace insonify::kernels
