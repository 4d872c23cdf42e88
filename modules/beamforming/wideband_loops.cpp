#include "beamforming/wideband_loops_internal.hpp"

#include "beamforming/target_clones_internal.hpp"

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

/// (i z)^n / n! without the power of i.
INSONIFY_INLINE void power_of(int n, float row_factor, const float* line_factor, float* power) {
  for (std::size_t c = 0; c < lines; ++c) power[c] = 1;
  for (int j = 1; j <= n; ++j) {
    const float factor = row_factor / static_cast<float>(j);
    for (std::size_t c = 0; c < lines; ++c) power[c] *= factor * line_factor[c];
  }
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
void add_power(int n, std::size_t rows, const float* row_factor, const float* line_factor, SpectrumChunk x,
               SpectrumChunk y) {
  float power[lines];
  for (std::size_t k = 0; k < rows; ++k) {
    power_of(n, row_factor[k], line_factor, power);
    add_turned(n, power, x.re + k * lines, x.im + k * lines, y.re + k * lines, y.im + k * lines);
  }
}

INSONIFY_CLONES
void add_weighted_power(int n, std::size_t rows, const float* row_factor, const float* line_factor, const float* weight,
                        std::size_t stride, SpectrumChunk x, SpectrumChunk y) {
  float power[lines];
  for (std::size_t k = 0; k < rows; ++k) {
    power_of(n, -row_factor[k], line_factor, power);
    for (std::size_t c = 0; c < lines; ++c) power[c] *= weight[k * stride + c];
    add_turned(n, power, x.re + k * lines, x.im + k * lines, y.re + k * lines, y.im + k * lines);
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
void merge_row(const float* re, const float* im, float factor, float* row) {
  for (std::size_t c = 0; c < lines; ++c) {
    row[2 * c] = factor * re[c];
    row[2 * c + 1] = factor * im[c];
  }
}

}  // namespace insonify::kernels
