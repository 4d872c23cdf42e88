#include "beamforming/wideband_loops_internal.hpp"
#include "core/target_clones.hpp"

namespace insonify::kernels {
namespace {

constexpr std::size_t lines = lines_at_once;

#define INSONIFY_INLINE [[gnu::always_inline]] inline

using Eight = float __attribute__((vector_size(32)));
using Places = int __attribute__((vector_size(32)));
constexpr Places real_parts = {0, 2, 4, 6, 8, 10, 12, 14}, imaginary_parts = {1, 3, 5, 7, 9, 11, 13, 15};
constexpr Places low_mixed = {0, 8, 1, 9, 2, 10, 3, 11}, high_mixed = {4, 12, 5, 13, 6, 14, 7, 15};

INSONIFY_INLINE void load(const float* from, Eight& eight) { __builtin_memcpy(&eight, from, sizeof eight); }
INSONIFY_INLINE void store(const Eight& eight, float* to) { __builtin_memcpy(to, &eight, sizeof eight); }

/// The factor of an element at all lines.
INSONIFY_INLINE void factor_of(const ElementTurns& turns, std::size_t m, Eight& re, Eight& im) {
  Eight step_re, step_im;
  load(turns.step + 2 * m * lines, step_re);
  load(turns.step + (2 * m + 1) * lines, step_im);
  const float start_re = turns.start[2 * m], start_im = turns.start[2 * m + 1];
  re = start_re * step_re - start_im * step_im;
  im = start_re * step_im + start_im * step_re;
  if (!turns.rest) return;
  Eight t, rest_re = {}, rest_im = {};
  load(turns.t, t);
  const float* power = turns.rest + 2 * m * turns.powers;
  for (std::size_t k = 0; k < turns.powers; ++k) {
    rest_re = rest_re * t + power[2 * k];
    rest_im = rest_im * t + power[2 * k + 1];
  }
  const Eight turned = re * rest_re - im * rest_im;
  im = re * rest_im + im * rest_re;
  re = turned;
}

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
void split_chunks(const float* line, const std::size_t* chunk, std::size_t count, float* to, std::size_t stride) {
  for (std::size_t i = 0; i < count; ++i, to += stride) {
    Eight low, high;
    load(line + 2 * lines * chunk[i], low);
    load(line + 2 * lines * chunk[i] + lines, high);
    store(__builtin_shuffle(low, high, real_parts), to);
    store(__builtin_shuffle(low, high, imaginary_parts), to + lines);
  }
}

INSONIFY_CLONES
void gather_elements(ElementTaps taps, ElementTurns turns, const float* rows, float* x) {
  for (std::size_t m = 0; m < taps.elements; ++m) {
    Eight re = {}, im = {}, weight, row_re, row_im;
    const float* from = rows + 2 * lines * taps.row[m];
    for (std::size_t k = 0; k < taps.taps; ++k, from += 2 * lines) {
      load(taps.weight + (m * taps.taps + k) * lines, weight);
      load(from, row_re);
      load(from + lines, row_im);
      re += weight * row_re;
      im += weight * row_im;
    }
    Eight factor_re, factor_im, x_re, x_im;
    factor_of(turns, m, factor_re, factor_im);
    load(x + 2 * m * lines, x_re);
    load(x + (2 * m + 1) * lines, x_im);
    store(x_re + (factor_re * re - factor_im * im), x + 2 * m * lines);
    store(x_im + (factor_re * im + factor_im * re), x + (2 * m + 1) * lines);
  }
}

INSONIFY_CLONES
void scatter_elements(ElementTaps taps, ElementTurns turns, const float* x, float* rows) {
  for (std::size_t m = 0; m < taps.elements; ++m) {
    Eight factor_re, factor_im, x_re, x_im, weight, row_re, row_im;
    factor_of(turns, m, factor_re, factor_im);
    load(x + 2 * m * lines, x_re);
    load(x + (2 * m + 1) * lines, x_im);
    const Eight re = factor_re * x_re - factor_im * x_im, im = factor_re * x_im + factor_im * x_re;
    float* to = rows + 2 * lines * taps.row[m];
    for (std::size_t k = 0; k < taps.taps; ++k, to += 2 * lines) {
      load(taps.weight + (m * taps.taps + k) * lines, weight);
      load(to, row_re);
      load(to + lines, row_im);
      store(row_re + weight * re, to);
      store(row_im + weight * im, to + lines);
    }
  }
}

INSONIFY_CLONES
void add_chunk(const float* rows, const float* factor, std::size_t count, float* to, std::size_t stride) {
  for (std::size_t r = 0; r < count; ++r, rows += 2 * lines, to += 2 * stride) {
    Eight re, im, low, high;
    load(rows, re);
    load(rows + lines, im);
    load(to, low);
    load(to + lines, high);
    store(low + factor[r] * __builtin_shuffle(re, im, low_mixed), to);
    store(high + factor[r] * __builtin_shuffle(re, im, high_mixed), to + lines);
  }
}

INSONIFY_CLONES
void add_beam(const float* weight, const std::uint32_t* row, std::size_t terms, const float* grid, std::size_t stride,
              TimeFactor factor, const float* t, std::size_t count, float* sum) {
  for (std::size_t n = 0; n < count; n += 8) {
    Eight low = {}, high = {}, first, second, times, factor_re = {}, factor_im = {};
    for (std::size_t k = 0; k < terms; ++k) {
      const float* from = grid + 2 * (row[k] * stride + n);
      load(from, first);
      load(from + 8, second);
      low += weight[k] * first;
      high += weight[k] * second;
    }
    load(t + n, times);
    for (std::size_t k = 0; k < factor.powers; ++k) {
      factor_re = factor_re * times + factor.power[2 * k * factor.stride];
      factor_im = factor_im * times + factor.power[(2 * k + 1) * factor.stride];
    }
    const Eight re = __builtin_shuffle(low, high, real_parts), im = __builtin_shuffle(low, high, imaginary_parts);
    const Eight y_re = factor_re * re - factor_im * im, y_im = factor_re * im + factor_im * re;
    load(sum + 2 * n, first);
    load(sum + 2 * n + 8, second);
    store(first + __builtin_shuffle(y_re, y_im, low_mixed), sum + 2 * n);
    store(second + __builtin_shuffle(y_re, y_im, high_mixed), sum + 2 * n + 8);
  }
}

}  // namespace insonify::kernels
