#include "beamforming/wideband_loops_internal.hpp"
#include "core/target_clones.hpp"

namespace insonify::kernels {
namespace {

constexpr std::size_t lines = lines_at_once;

#define INSONIFY_INLINE [[gnu::always_inline]] inline

using Eight = float __attribute__((vector_size(32)));
using Places = int __attribute__((vector_size(32)));
constexpr Places real_parts = {0, 2, 4, 6, 8, 10, 12, 14}, imaginary_parts = {1, 3, 5, 7, 9, 11, 13, 15};
constexpr Places swapped = {1, 0, 3, 2, 5, 4, 7, 6};
constexpr Places low_mixed = {0, 8, 1, 9, 2, 10, 3, 11}, high_mixed = {4, 12, 5, 13, 6, 14, 7, 15};

INSONIFY_INLINE void load(const float* from, Eight& eight) { __builtin_memcpy(&eight, from, sizeof eight); }
INSONIFY_INLINE void store(const Eight& eight, float* to) { __builtin_memcpy(to, &eight, sizeof eight); }

}  // namespace

INSONIFY_CLONES
void weigh_row(TimeFactor factor, float t, const float* re, const float* im, std::size_t count, float* line) {
  for (std::size_t g = 0; g < count; g += 8) {
    Eight factor_re = {}, factor_im = {}, next, x_re, x_im;
    const float* power = factor.power + g;
    for (std::size_t k = 0; k < factor.powers; ++k, power += 2 * factor.stride) {
      load(power, next);
      factor_re = factor_re * t + next;
      load(power + factor.stride, next);
      factor_im = factor_im * t + next;
    }
    load(re + g, x_re);
    load(im + g, x_im);
    const Eight y_re = factor_re * x_re - factor_im * x_im, y_im = factor_re * x_im + factor_im * x_re;
    store(__builtin_shuffle(y_re, y_im, low_mixed), line + 2 * g);
    store(__builtin_shuffle(y_re, y_im, high_mixed), line + 2 * g + 8);
  }
}

INSONIFY_CLONES
void weigh_back(TimeFactor factor, float t, const float* line, std::size_t count, float* re, float* im) {
  for (std::size_t g = 0; g < count; g += 8) {
    Eight factor_re = {}, factor_im = {}, next, low, high, sum_re, sum_im;
    const float* power = factor.power + g;
    for (std::size_t k = 0; k < factor.powers; ++k, power += 2 * factor.stride) {
      load(power, next);
      factor_re = factor_re * t + next;
      load(power + factor.stride, next);
      factor_im = factor_im * t + next;
    }
    load(line + 2 * g, low);
    load(line + 2 * g + 8, high);
    const Eight x_re = __builtin_shuffle(low, high, real_parts), x_im = __builtin_shuffle(low, high, imaginary_parts);
    load(re + g, sum_re);
    load(im + g, sum_im);
    store(sum_re + (factor_re * x_re - factor_im * x_im), re + g);
    store(sum_im + (factor_re * x_im + factor_im * x_re), im + g);
  }
}

INSONIFY_CLONES
void mix_rows(RowMix mix, MixedPlanes planes) {
  for (std::size_t eight = planes.first; eight < planes.last; ++eight)
    for (std::size_t o = 0; o < mix.outs; ++o)
      for (std::size_t n = 0; n < planes.times; ++n) {
        const float* factor = mix.factor + (eight * mix.outs + o) * mix.stride * 32;
        const float* in = planes.in + n * planes.row + 16 * eight;
        Eight low = {}, high = {}, x, y, times;
        for (std::size_t i = 0; i < mix.ins[o]; ++i, in += planes.in_plane, factor += 32) {
          load(in, x);
          load(in + 8, y);
          load(factor, times);
          low += times * x;
          load(factor + 8, times);
          high += times * y;
          load(factor + 16, times);
          low += times * __builtin_shuffle(x, swapped);
          load(factor + 24, times);
          high += times * __builtin_shuffle(y, swapped);
        }
        float* out = planes.out + o * planes.out_plane + n * planes.row + 16 * eight;
        store(low, out);
        store(high, out + 8);
      }
}

INSONIFY_CLONES
void sum_powers(LinePowers powers, const float* line, std::size_t plane, const std::size_t* chunk, std::size_t count,
                float* to, std::size_t stride) {
  for (std::size_t i = 0; i < count; ++i, to += stride) {
    Eight re = {}, im = {}, low, high, power;
    const float* from = line + 2 * lines * chunk[i];
    for (std::size_t s = 0; s < powers.powers; ++s, from += plane) {
      load(from, low);
      load(from + lines, high);
      load(powers.power + (i * powers.stride + s) * lines, power);
      re += power * __builtin_shuffle(low, high, real_parts);
      im += power * __builtin_shuffle(low, high, imaginary_parts);
    }
    store(re, to);
    store(im, to + lines);
  }
}

INSONIFY_CLONES
void through_elements(ElementTaps taps, const float* factor, const float* rows, float* to) {
  for (std::size_t m = 0; m < taps.elements; ++m) {
    Eight re = {}, im = {}, weight, row_re, row_im;
    const float* from = rows + 2 * lines * taps.row[m];
    const float* weights = taps.weight + m * taps.taps * lines;
    for (std::size_t k = 0; k < taps.taps; ++k, from += 2 * lines) {
      load(weights + k * lines, weight);
      load(from, row_re);
      load(from + lines, row_im);
      re += weight * row_re;
      im += weight * row_im;
    }
    load(factor + m * lines, weight);
    re *= weight;
    im *= weight;
    float* back = to + 2 * lines * taps.row[m];
    for (std::size_t k = 0; k < taps.taps; ++k, back += 2 * lines) {
      load(weights + k * lines, weight);
      load(back, row_re);
      load(back + lines, row_im);
      store(row_re + weight * re, back);
      store(row_im + weight * im, back + lines);
    }
  }
}

INSONIFY_CLONES
void add_powers(LinePowers powers, const float* rows, std::size_t count, float* to, std::size_t stride,
                std::size_t plane) {
  for (std::size_t r = 0; r < count; ++r, rows += 2 * lines, to += 2 * stride) {
    Eight re, im, low, high, power;
    load(rows, re);
    load(rows + lines, im);
    float* back = to;
    for (std::size_t s = 0; s < powers.powers; ++s, back += 2 * plane) {
      __builtin_prefetch(back + 16 * stride, 1);
      load(powers.power + s * lines, power);
      const Eight part_re = power * re, part_im = power * im;
      load(back, low);
      load(back + lines, high);
      store(low + __builtin_shuffle(part_re, part_im, low_mixed), back);
      store(high + __builtin_shuffle(part_re, part_im, high_mixed), back + lines);
    }
  }
}

INSONIFY_CLONES
void take_beam(const float* weight, const std::uint32_t* row, std::size_t terms, const float* grid, std::size_t stride,
               std::size_t count, float* beam) {
  for (std::size_t n = 0; n < count; n += 8) {
    Eight sum = {}, x;
    for (std::size_t k = 0; k < terms; ++k) {
      load(grid + row[k] * stride + n, x);
      sum += weight[k] * x;
    }
    store(sum, beam + n);
  }
}

}  // namespace insonify::kernels
