#include <cmath>

#include "core/target_clones.hpp"
#include "core/vector_functions.hpp"
#include "simulate/narrow_band_loops_internal.hpp"

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
    vec::sine_cosine(-e.cycles_per_m * y[m] * (e.u - e.u_beam), p.sine[p.narrow][m], p.cosine[p.narrow][m]);
    vec::sine_cosine(carrier, p.sine[p.carrier][m], p.cosine[p.carrier][m]);
    vec::sine_cosine(e.cycles_per_m * (there - way_to(y[m], e.nearer, e.u_beam)), p.sine[p.before][m],
                     p.cosine[p.before][m]);
    vec::sine_cosine(e.cycles_per_m * (there - way_to(y[m], e.farther, e.u_beam)), p.sine[p.behind][m],
                     p.cosine[p.behind][m]);
    vec::sine_cosine(carrier * e.near_off, p.sine[p.near_off][m], p.cosine[p.near_off][m]);
    vec::sine_cosine(carrier * e.far_off, p.sine[p.far_off][m], p.cosine[p.far_off][m]);
  }
}

}  // namespace insonify::kernels
