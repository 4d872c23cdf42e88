// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "beamforming/true_delays/beam_table_loops_internal.hpp"
#include "core/target_clones.hpp"
#include "core/units.hpp"
#include "core/vector_functions.hpp"

namespace insonify::kernels {
namespace {

using Eight = float __attribute__((vector_size(32)));

/// Sums `eights` times eight numbers of all rows, which stay in registers. Rows of one direction are summed first, so
/// that additions need not wait for those of other directions.
template <std::size_t eights>
[[gnu::always_inline]] inline void sum_eights(const float* first, const ResponseTaps& taps, float* response) {
  Eight sum[eights] = {}, row;
  for (std::size_t c = 0; c < taps.ranges; ++c)
    for (std::size_t g = 0; g < direction_taps; ++g) {
      const float* at = first + c * taps.plane + g * taps.line;
      const float here = taps.range[c] * taps.direction[g];
      Eight of_direction[eights] = {};
      for (std::size_t q = 0; q < time_taps; ++q, at += taps.row)
        for (std::size_t k = 0; k < eights; ++k) {
          __builtin_memcpy(&row, at + 8 * k, sizeof row);
          of_direction[k] += taps.time[q] * row;
        }
      for (std::size_t k = 0; k < eights; ++k) sum[k] += here * of_direction[k];
    }
  __builtin_memcpy(response, sum, sizeof sum);
}

}  // namespace

INSONIFY_CLONES
void focus_at(const ElementFocus& focus, std::size_t count, double* path) {
  const double range = focus.range, step = focus.step, y = focus.y, twice = 2 * focus.u * focus.y;
#pragma GCC ivdep
  for (std::size_t j = 0; j < count; ++j) {
    const double wanted = range + static_cast<double>(j) * step, r = wanted < 1e-3 ? 1e-3 : wanted;
    const double squared = y * y - twice * r, sum = r * r + squared;
    path[j] = squared / (std::sqrt(sum < 0 ? 0 : sum) + r);
  }
}

INSONIFY_CLONES
void add_element(const ElementPulse& pulse, const double* focus, double path, double weight, std::size_t begin,
                 std::size_t end, double* re, double* im) {
  const double per_speed = 1 / pulse.speed, decay = -pi * pi / pulse.a, turn = 0.5 * pulse.b / pulse.a;
  const double start = pulse.start + pulse.late, step = pulse.step, carrier = pulse.carrier,
               after = carrier * pulse.late;
#pragma GCC ivdep
  for (std::size_t j = begin; j < end; ++j) {
    const double early = (focus[j] - path) * per_speed, t = start + static_cast<double>(j) * step + early;
    double sine, cosine;
    vec::sine_cosine(turn * t - carrier * early - after, sine, cosine);
    const double magnitude = weight * vec::exp(decay * t * t);
    re[j] += magnitude * cosine;
    im[j] += magnitude * sine;
  }
}

INSONIFY_CLONES
void sum_response(const float* first, const ResponseTaps& taps, float* response) {
  std::size_t left = taps.eights;
  for (; left >= 4; left -= 4, first += 32, response += 32) sum_eights<4>(first, taps, response);
  for (; left >= 2; left -= 2, first += 16, response += 16) sum_eights<2>(first, taps, response);
  if (left == 1) sum_eights<1>(first, taps, response);
}

}  // namespace insonify::kernels
