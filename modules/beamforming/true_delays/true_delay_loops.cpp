// SPDX-License-Identifier: BSD-3-Clause
#include "beamforming/true_delays/true_delay_loops_internal.hpp"
#include "core/target_clones.hpp"

namespace insonify::kernels {
namespace {

constexpr std::size_t lines = lines_at_once;

#define INSONIFY_INLINE [[gnu::always_inline]] inline

using Eight = float __attribute__((vector_size(32)));
using Positions = int __attribute__((vector_size(32)));
constexpr Positions real_parts = {0, 2, 4, 6, 8, 10, 12, 14}, imaginary_parts = {1, 3, 5, 7, 9, 11, 13, 15};
constexpr Positions low_mixed = {0, 8, 1, 9, 2, 10, 3, 11}, high_mixed = {4, 12, 5, 13, 6, 14, 7, 15};

INSONIFY_INLINE void load(const float* from, Eight& eight) { __builtin_memcpy(&eight, from, sizeof eight); }
INSONIFY_INLINE void store(const Eight& eight, float* to) { __builtin_memcpy(to, &eight, sizeof eight); }

constexpr std::size_t four = 4;  // times whose numbers stay in registers
// Numbers by time, real and imaginary, and eight places; turned, by place and time.
using FourTimes = Eight[2 * four];

INSONIFY_INLINE void turn(FourTimes& x) {
  constexpr Positions low1 = {0, 8, 1, 9, 4, 12, 5, 13}, high1 = {2, 10, 3, 11, 6, 14, 7, 15};
  constexpr Positions low2 = {0, 1, 8, 9, 4, 5, 12, 13}, high2 = {2, 3, 10, 11, 6, 7, 14, 15};
  constexpr Positions low4 = {0, 1, 2, 3, 8, 9, 10, 11}, high4 = {4, 5, 6, 7, 12, 13, 14, 15};
  FourTimes y, z;
  for (int k = 0; k < 4; ++k) {
    y[2 * k] = __builtin_shuffle(x[2 * k], x[2 * k + 1], low1);
    y[2 * k + 1] = __builtin_shuffle(x[2 * k], x[2 * k + 1], high1);
  }
  for (int k = 0; k < 8; k += 4)
    for (int j = 0; j < 2; ++j) {
      z[k + 2 * j] = __builtin_shuffle(y[k + j], y[k + j + 2], low2);
      z[k + 2 * j + 1] = __builtin_shuffle(y[k + j], y[k + j + 2], high2);
    }
  for (int k = 0; k < 4; ++k) {
    x[k] = __builtin_shuffle(z[k], z[k + 4], low4);
    x[k + 4] = __builtin_shuffle(z[k], z[k + 4], high4);
  }
}

INSONIFY_INLINE void factors_at(TimeFactor factor, const float* power, const float* time, FourTimes& at) {
  Eight next;
  for (Eight& x : at) x = Eight{};
  for (std::size_t k = 0; k < factor.powers; ++k, power += 2 * factor.stride) {
    load(power, next);
    for (std::size_t n = 0; n < four; ++n) at[2 * n] = at[2 * n] * time[n] + next;
    load(power + factor.stride, next);
    for (std::size_t n = 0; n < four; ++n) at[2 * n + 1] = at[2 * n + 1] * time[n] + next;
  }
}

/// One out of a mix at four times, of numbers by in, time, and real and imaginary part.
INSONIFY_INLINE void mix_four(const float* factor, std::size_t ins, const float* in, FourTimes& sum) {
  Eight by_re, by_im, re, im;
  for (Eight& x : sum) x = Eight{};
  for (std::size_t i = 0; i < ins; ++i, factor += 16, in += 16 * times_at_once) {
    load(factor, by_re);
    load(factor + 8, by_im);
    for (std::size_t n = 0; n < four; ++n) {
      load(in + 16 * n, re);
      load(in + 16 * n + 8, im);
      sum[2 * n] += by_re * re - by_im * im;
      sum[2 * n + 1] += by_re * im + by_im * re;
    }
  }
}

INSONIFY_INLINE bool holds_rows(PositionRows rows, std::size_t g) {
  for (std::size_t k = 0; k < 8; ++k)
    if (rows.row[g + k] != rows.none) return true;
  return false;
}

/// Fetches the rows of eight places into the cache: one after another they are far apart in memory.
INSONIFY_INLINE void fetch_rows(PositionRows rows, std::size_t g, std::size_t planes) {
  for (std::size_t o = 0; o < planes; ++o)
    for (std::size_t k = 0; k < 8; ++k) {
      const float* row = rows.value + o * rows.plane + rows.row[g + k] * rows.length;
      __builtin_prefetch(row);
      __builtin_prefetch(row + times_at_once);
    }
}

INSONIFY_INLINE void store_in_turn(const Eight& re, const Eight& im, float* to) {
  store(__builtin_shuffle(re, im, low_mixed), to);
  store(__builtin_shuffle(re, im, high_mixed), to + 8);
}

INSONIFY_INLINE void load_in_turn(const float* from, Eight& re, Eight& im) {
  Eight low, high;
  load(from, low);
  load(from + 8, high);
  re = __builtin_shuffle(low, high, real_parts), im = __builtin_shuffle(low, high, imaginary_parts);
}

}  // namespace

INSONIFY_CLONES
void weigh(TimeFactor factor, const float* time, const float* re, const float* im, std::size_t count,
           std::size_t stride, float* line) {
  for (std::size_t g = 0; g < count; g += 8)
    for (std::size_t n0 = 0; n0 < times_at_once; n0 += four) {
      FourTimes by;
      factors_at(factor, factor.power + g, time + n0, by);
      for (std::size_t n = 0; n < four; ++n) {
        const std::size_t at = (n0 + n) * stride + g;
        Eight x_re, x_im;
        load(re + at, x_re);
        load(im + at, x_im);
        store_in_turn(by[2 * n] * x_re - by[2 * n + 1] * x_im, by[2 * n] * x_im + by[2 * n + 1] * x_re, line + 2 * at);
      }
    }
}

INSONIFY_CLONES
void weigh_back(TimeFactor factor, const float* time, const float* line, std::size_t terms, std::size_t plane,
                std::size_t count, std::size_t stride, float* across) {
  for (std::size_t g = 0; g < count; g += 8)
    for (std::size_t n0 = 0; n0 < times_at_once; n0 += four) {
      FourTimes sum = {};
      const float* power = factor.power + g;
      for (std::size_t q = 0; q < terms; ++q, power += 2 * factor.powers * factor.stride) {
        FourTimes by;
        factors_at(factor, power, time + n0, by);
        for (std::size_t n = 0; n < four; ++n) {
          Eight re, im;
          load_in_turn(line + q * plane + 2 * ((n0 + n) * stride + g), re, im);
          sum[2 * n] += by[2 * n] * re - by[2 * n + 1] * im;
          sum[2 * n + 1] += by[2 * n] * im + by[2 * n + 1] * re;
        }
      }
      turn(sum);
      for (std::size_t k = 0; k < 8; ++k) store(sum[k], across + 2 * ((g + k) * times_at_once + n0));
    }
}

INSONIFY_CLONES
void mix_to_rows(RowMix mix, TimePlanes from, PositionRows to, float* workspace) {
  for (std::size_t g = 0; g < from.positions; g += 8) {
    if (!holds_rows(to, g)) continue;
    fetch_rows(to, g, mix.outs);
    for (std::size_t i = 0; i < mix.stride; ++i)
      for (std::size_t n = 0; n < times_at_once; ++n) {
        Eight re, im;
        load_in_turn(from.value + i * from.plane + n * from.row + 2 * g, re, im);
        store(re, workspace + 16 * (i * times_at_once + n));
        store(im, workspace + 16 * (i * times_at_once + n) + 8);
      }
    for (std::size_t o = 0; o < mix.outs; ++o) {
      float* plane = to.value + o * to.plane;
      for (std::size_t n = 0; n < times_at_once; n += four) {
        FourTimes sum;
        mix_four(mix.factor + 2 * (g * mix.outs + 8 * o) * mix.stride, mix.ins[o], workspace + 16 * n, sum);
        turn(sum);
        for (std::size_t k = 0; k < 8; ++k) store(sum[k], plane + to.row[g + k] * to.length + 2 * n);
      }
    }
  }
}

INSONIFY_CLONES
void mix_from_rows(RowMix mix, PositionRows from, TimePlanes to, float* workspace) {
  for (std::size_t g = 0; g < to.positions; g += 8) {
    const bool any = holds_rows(from, g);
    if (g + 8 < to.positions) fetch_rows(from, g + 8, mix.stride);
    for (std::size_t i = 0; any && i < mix.stride; ++i)
      for (std::size_t n = 0; n < times_at_once; n += four) {
        FourTimes in;
        for (std::size_t k = 0; k < 8; ++k)
          load(from.value + i * from.plane + from.row[g + k] * from.length + 2 * n, in[k]);
        turn(in);
        for (std::size_t k = 0; k < 8; ++k) store(in[k], workspace + 16 * (i * times_at_once + n) + 8 * k);
      }
    for (std::size_t o = 0; o < mix.outs; ++o)
      for (std::size_t n0 = 0; n0 < times_at_once; n0 += four) {
        FourTimes sum = {};
        if (any) mix_four(mix.factor + 2 * (g * mix.outs + 8 * o) * mix.stride, mix.ins[o], workspace + 16 * n0, sum);
        for (std::size_t n = 0; n < four; ++n)
          store_in_turn(sum[2 * n], sum[2 * n + 1], to.value + o * to.plane + (n0 + n) * to.row + 2 * g);
      }
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
void add_power(const float* line, std::size_t count, const float* power, std::size_t stride,
               const std::uint32_t* position, float* to) {
  for (std::size_t i = 0; i < count; ++i, line += 2 * lines, power += stride) {
    Eight re, im, times, low, high;
    float* at = to + 2 * position[i];
    load(line, re);
    load(line + lines, im);
    load(power, times);
    load(at, low);
    load(at + lines, high);
    re *= times, im *= times;
    store(low + __builtin_shuffle(re, im, low_mixed), at);
    store(high + __builtin_shuffle(re, im, high_mixed), at + lines);
  }
}

}  // namespace insonify::kernels
