// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "acoustics/echo_loops_internal.hpp"
#include "core/target_clones.hpp"
#include "core/vector_functions.hpp"

namespace insonify::kernels {
namespace {

constexpr double cycles_per_radian = 0.159154943091895336, ln2 = 0.693147180559945309;

}  // namespace

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
                   EchoPositions echoes) {
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

INSONIFY_CLONES
void move_echoes(const double* range, const double* azimuth, const double* elevation, std::size_t count,
                 const MovingHead& head, EchoPositions echoes, double* doppler) {
  const MovingHead h = head;
  const double *v = h.velocity, *k = h.axis, c = h.sound_speed;
  const double speed_2 = (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]) / (c * c);
#pragma GCC ivdep
  for (std::size_t i = 0; i < count; ++i) {
    double sine_azimuth, cosine_azimuth, sine_elevation, cosine_elevation, sine, cosine, sine_turn, cosine_turn;
    vec::sine_cosine(azimuth[i] * cycles_per_radian, sine_azimuth, cosine_azimuth);
    vec::sine_cosine(elevation[i] * cycles_per_radian, sine_elevation, cosine_elevation);
    const double x = cosine_elevation * cosine_azimuth, y = cosine_elevation * sine_azimuth, z = sine_elevation;
    const double closing = (v[0] * x + v[1] * y + v[2] * z) / c;

    // Out from here, back to where the head will be: a quadratic equation in the delay. (E44)
    const double r0 = range[i], delay = 2 * r0 / c * (1 - closing) / (1 - speed_2);
    const double longer = r0 * 2 * (speed_2 - closing) / (1 - speed_2), r1 = r0 + longer;
    const double bx = (r0 * x - v[0] * delay) / r1, by = (r0 * y - v[1] * delay) / r1,
                 bz = (r0 * z - v[2] * delay) / r1;

    // The way back in the axes at reception: turned against the head's turn.
    vec::sine_cosine(-h.turns_per_s * delay, sine_turn, cosine_turn);
    const double along = (k[0] * bx + k[1] * by + k[2] * bz) * (1 - cosine_turn);
    const double seen_y = by * cosine_turn + (k[2] * bx - k[0] * bz) * sine_turn + k[1] * along;
    const double seen_z = bz * cosine_turn + (k[0] * by - k[1] * bx) * sine_turn + k[2] * along;

    vec::sine_cosine(h.centre_frequency / c * longer, sine, cosine);
    const double re = echoes.amplitude[2 * i], im = echoes.amplitude[2 * i + 1], spread = r0 / r1;
    echoes.delay[i] = delay;
    echoes.u[i] = seen_y;
    echoes.v[i] = seen_z;
    echoes.amplitude[2 * i] = spread * (re * cosine - im * sine);
    echoes.amplitude[2 * i + 1] = spread * (re * sine + im * cosine);
    doppler[i] = h.centre_frequency * (closing + (v[0] * bx + v[1] * by + v[2] * bz) / c) / (1 - closing);
  }
}

}  // namespace insonify::kernels
