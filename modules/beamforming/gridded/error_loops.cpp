// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "beamforming/gridded/error_loops_internal.hpp"
#include "core/target_clones.hpp"
#include "core/vector_functions.hpp"

namespace insonify::kernels {
namespace {

/// How much longer the way to an element at y is than to the middle of the array.
INSONIFY_ALWAYS_INLINE double way_to(double y, double range, double u) {
  const double squared = y * y - 2 * range * y * u, all = range * range + squared;
  return squared / (std::sqrt(all > 0 ? all : 0) + range);
}

}  // namespace

INSONIFY_CLONES
void echo_phasors(const double* y, std::size_t count, const BeamEcho& echo, EchoPhasors phasors) {
  const BeamEcho e = echo;
  const EchoPhasors p = phasors;
#pragma GCC ivdep
  for (std::size_t m = 0; m < count; ++m) {
    const double there = way_to(y[m], e.range, e.u);
    const double carrier = e.cycles_per_m * (there - way_to(y[m], e.range, e.u_beam));
    vec::sine_cosine(-e.narrow_cycles * y[m] * (e.u - e.u_beam), p.sine[p.narrow][m], p.cosine[p.narrow][m]);
    vec::sine_cosine(carrier, p.sine[p.carrier][m], p.cosine[p.carrier][m]);
    vec::sine_cosine(e.cycles_per_m * (there - way_to(y[m], e.nearer, e.u_beam)), p.sine[p.before][m],
                     p.cosine[p.before][m]);
    vec::sine_cosine(e.cycles_per_m * (there - way_to(y[m], e.farther, e.u_beam)), p.sine[p.behind][m],
                     p.cosine[p.behind][m]);
    vec::sine_cosine(carrier * e.near_off, p.sine[p.near_off][m], p.cosine[p.near_off][m]);
    vec::sine_cosine(carrier * e.far_off, p.sine[p.far_off][m], p.cosine[p.far_off][m]);
  }
}

INSONIFY_CLONES
PhasorSums sum_phasors(const double* shading, std::size_t count, const EchoPhasors& phasors) {
  constexpr std::size_t lanes = phasor_lanes, sums = sizeof(PhasorSums) / sizeof(double);
  const EchoPhasors p = phasors;
  double sum[sums][lanes] = {};
  for (std::size_t m = 0; m < count; m += lanes)
    for (std::size_t l = 0; l < lanes; ++l) {
      const double w = shading[m + l];
      for (std::size_t row = 0; row < 4; ++row) {
        sum[2 * row][l] += w * p.cosine[row][m + l];
        sum[2 * row + 1][l] += w * p.sine[row][m + l];
      }
      const double re = w * p.cosine[p.carrier][m + l], im = w * p.sine[p.carrier][m + l];
      for (std::size_t k = 0; k < 2; ++k) {
        const double cosine = p.cosine[p.near_off + k][m + l], sine = p.sine[p.near_off + k][m + l];
        sum[8 + 2 * k][l] += re * cosine;
        sum[9 + 2 * k][l] += im * cosine;
        sum[12 + 2 * k][l] -= im * sine;
        sum[13 + 2 * k][l] += re * sine;
      }
    }
  double all[sums];
  for (std::size_t s = 0; s < sums; ++s) {
    all[s] = 0;
    for (std::size_t l = 0; l < lanes; ++l) all[s] += sum[s][l];
  }
  return {{{all[0], all[1]}, {all[2], all[3]}, {all[4], all[5]}, {all[6], all[7]}},
          {{all[8], all[9]}, {all[10], all[11]}},
          {{all[12], all[13]}, {all[14], all[15]}}};
}

}  // namespace insonify::kernels
