#include <cmath>

#include "acoustics/echo_loops_internal.hpp"
#include "core/target_clones.hpp"
#include "core/vector_functions.hpp"

namespace insonify::kernels {
namespace {

constexpr double cycles_per_radian = 0.159154943091895336, ln2 = 0.693147180559945309;

}  // namespace

INSONIFY_CLONES
void complex_normal(const double* u, const double* turn, std::size_t count, double* re, double* im) {
#pragma GCC ivdep
  for (std::size_t i = 0; i < count; ++i) {
    double sine, cosine;
    vec::sine_cosine(turn[i], sine, cosine);
    const double magnitude = std::sqrt(-vec::log(u[i]));  // (E9)
    re[i] = magnitude * cosine;
    im[i] = magnitude * sine;
  }
}

INSONIFY_CLONES
void apply_lobe(const double* angle, std::size_t count, double axis, double width, double* gain) {
  const double per_width = 1 / width;
#pragma GCC ivdep
  for (std::size_t i = 0; i < count; ++i) {
    const double off = angle[i] - axis, turns = off * cycles_per_radian;
    const double x =
        (turns > 0.5 || turns < -0.5 ? (turns - vec::nearest(turns)) / cycles_per_radian : off) * per_width;
    gain[i] *= vec::exp(-2 * ln2 * x * x);
  }
}

INSONIFY_CLONES
void direct_echoes(const EchoPatches& patches, std::size_t count, double cycles_per_m, double sound_speed,
                   EchoPlaces echoes) {
  const EchoPatches s = patches;
#pragma GCC ivdep
  for (std::size_t i = 0; i < count; ++i) {
    double sine_azimuth, cosine_azimuth, sine_elevation, cosine_elevation, sine, cosine;
    vec::sine_cosine(s.azimuth[i] * cycles_per_radian, sine_azimuth, cosine_azimuth);
    vec::sine_cosine(s.elevation[i] * cycles_per_radian, sine_elevation, cosine_elevation);
    const double r = s.range[i], cycles = cycles_per_m * r;
    vec::sine_cosine(cycles, sine, cosine);
    const double gain = s.gain[i] / (r * r);  // (E7)
    echoes.delay[i] = 2 * r / sound_speed;
    echoes.u[i] = cosine_elevation * sine_azimuth;
    echoes.v[i] = sine_elevation;
    echoes.amplitude[2 * i] = gain * (s.xi_re[i] * cosine - s.xi_im[i] * sine);
    echoes.amplitude[2 * i + 1] = gain * (s.xi_re[i] * sine + s.xi_im[i] * cosine);
  }
}

}  // namespace insonify::kernels
