#include <utility>

#include "beamforming/target_clones_internal.hpp"
#include "beamforming/wideband_loops_internal.hpp"

namespace insonify::kernels {
namespace {

constexpr std::size_t lines = lines_at_once;

#define INSONIFY_INLINE [[gnu::always_inline]] inline

INSONIFY_INLINE void filter_plane(const float* tap, std::size_t reach, std::size_t rows, const float* __restrict x,
                                  float* __restrict y) {
  for (std::size_t k = 0; k < rows; ++k) {
    const float* here = x + k * lines;
    float sum[lines];
    for (std::size_t c = 0; c < lines; ++c) sum[c] = tap[0] * here[c];
    for (std::size_t l = 1; l <= reach; ++l) {
      const float *before = here - l * lines, *after = here + l * lines;
      for (std::size_t c = 0; c < lines; ++c) sum[c] += tap[l] * (before[c] + after[c]);
    }
    for (std::size_t c = 0; c < lines; ++c) y[k * lines + c] = sum[c];
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

}  // namespace

INSONIFY_CLONES
void filter_rows(const float* tap, std::size_t reach, std::size_t rows, SpectrumChunk x, SpectrumChunk y) {
  filter_plane(tap, reach, rows, x.re, y.re);
  filter_plane(tap, reach, rows, x.im, y.im);
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
  for (const auto& [from, to] : {std::pair{x.re, y.re}, std::pair{x.im, y.im}})
    for (std::size_t k = 0; k < rows; ++k) {
      float sum[lines] = {};
      for (std::size_t l = 1; l <= reach; ++l) {
        const float *here = from + k * lines, *before = here - l * lines, *after = here + l * lines;
        for (std::size_t c = 0; c < lines; ++c) sum[c] += tap[l] * (before[c] - after[c]);
      }
      for (std::size_t c = 0; c < lines; ++c) to[k * lines + c] = sum[c];
    }
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
