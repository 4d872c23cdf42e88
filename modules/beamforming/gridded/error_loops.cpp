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
EchoSums sum_phasors(const double* y, const double* shading, std::size_t count, const BeamEcho& echo) {
  enum Row { narrow, carrier, before, behind, near_off, far_off, rows };
  constexpr std::size_t lanes = phasor_lanes, sums = sizeof(EchoSums) / sizeof(double);
  const BeamEcho e = echo;
  double sum[sums][lanes] = {};
  for (std::size_t m = 0; m < count; m += lanes) {
    double cosine[rows][lanes], sine[rows][lanes];
    for (std::size_t l = 0; l < lanes; ++l) {
      const double at = y[m + l], there = way_to(at, e.range, e.u);
      const double cycles = e.cycles_per_m * (there - way_to(at, e.range, e.u_beam));
      vec::sine_cosine(-e.narrow_cycles * at * (e.u - e.u_beam), sine[narrow][l], cosine[narrow][l]);
      vec::sine_cosine(cycles, sine[carrier][l], cosine[carrier][l]);
      vec::sine_cosine(e.cycles_per_m * (there - way_to(at, e.nearer, e.u_beam)), sine[before][l], cosine[before][l]);
      vec::sine_cosine(e.cycles_per_m * (there - way_to(at, e.farther, e.u_beam)), sine[behind][l], cosine[behind][l]);
      vec::sine_cosine(cycles * e.near_off, sine[near_off][l], cosine[near_off][l]);
      vec::sine_cosine(cycles * e.far_off, sine[far_off][l], cosine[far_off][l]);
    }
    for (std::size_t l = 0; l < lanes; ++l) {
      const double w = shading[m + l], re = w * cosine[carrier][l], im = w * sine[carrier][l];
      for (std::size_t row = 0; row < near_off; ++row) {
        sum[2 * row][l] += w * cosine[row][l];
        sum[2 * row + 1][l] += w * sine[row][l];
      }
      for (std::size_t k = 0; k < 2; ++k) {
        sum[8 + 2 * k][l] += re * cosine[near_off + k][l];
        sum[9 + 2 * k][l] += im * cosine[near_off + k][l];
        sum[12 + 2 * k][l] -= im * sine[near_off + k][l];
        sum[13 + 2 * k][l] += re * sine[near_off + k][l];
      }
    }
  }
  const auto number = [&](std::size_t s) {
    std::complex<double> all = 0;
    for (std::size_t l = 0; l < lanes; ++l) all += std::complex(sum[2 * s][l], sum[2 * s + 1][l]);
    return all;
  };
  return {number(0), number(1), number(2), number(3), number(4), number(5), number(6), number(7)};
}

}  // namespace insonify::kernels
