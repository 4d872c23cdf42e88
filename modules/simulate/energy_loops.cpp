// SPDX-License-Identifier: BSD-3-Clause
#include "core/target_clones.hpp"
#include "core/vector_functions.hpp"
#include "simulate/energy_loops_internal.hpp"

namespace insonify::kernels {
namespace {

constexpr std::size_t lanes = energy_lanes;

INSONIFY_ALWAYS_INLINE void turn_on(const Turns& turns, Turns& phase) {
#pragma GCC unroll 1
  for (std::size_t l = 0; l < lanes; ++l) {
    const double re = phase.re[l], im = phase.im[l];
    phase.re[l] = re * turns.re[l] - im * turns.im[l];
    phase.im[l] = re * turns.im[l] + im * turns.re[l];
  }
}

INSONIFY_ALWAYS_INLINE Turns start() {
  Turns phase;
  for (std::size_t l = 0; l < lanes; ++l) phase.re[l] = 1, phase.im[l] = 0;
  return phase;
}

}  // namespace

INSONIFY_CLONES void add_powers(const Turns& turns, std::size_t number, std::size_t count, double* term_re,
                                double* term_im) {
  const Turns by = turns;
  Turns phase = start();
  for (std::size_t m = 0; m < count; ++m) {
    double re = term_re[m], im = term_im[m];
    for (std::size_t l = 0; l < number; ++l) re += phase.re[l], im += phase.im[l];
    term_re[m] = re, term_im[m] = im;
    turn_on(by, phase);
  }
}

INSONIFY_CLONES void sum_powers(const Turns& turns, const double* term_re, const double* term_im, std::size_t count,
                                double* sum) {
  const Turns by = turns;
  Turns phase = start();
  double all[lanes] = {};
  for (std::size_t m = 0; m < count; ++m) {
#pragma GCC unroll 1
    for (std::size_t l = 0; l < lanes; ++l) all[l] += term_re[m] * phase.re[l] - term_im[m] * phase.im[l];
    turn_on(by, phase);
  }
  for (std::size_t l = 0; l < lanes; ++l) sum[l] = all[l];
}

}  // namespace insonify::kernels
