// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "beamforming/numerics/kernel_lanes_internal.hpp"
#include "beamforming/pulses/pulse_loops_internal.hpp"
#include "core/target_clones.hpp"
#include "core/units.hpp"
#include "core/vector_functions.hpp"

namespace insonify::kernels {

template <typename Real>
INSONIFY_CLONES void place_gaussians(const EchoArrays& echoes, std::size_t count, const GaussianGrid& grid,
                                     const PulseLosses& losses, std::size_t sample, GaussianState s,
                                     GaussianPositions<Real> at) {
  const GaussianGrid g = grid;
  const PulseLosses l = losses;
  const double turn_step = 2 * pi * g.step, first = g.start + g.half, sign = g.half_positions ? 1 : 0;
  const auto later = static_cast<double>(sample);
#pragma GCC ivdep
  for (std::size_t i = 0; i < count; ++i) {
    // Where: between grid steps, with the sign of whole cycles, and between bins.
    const double cycles = g.cycles_per_u * (echoes.u[i] - g.first_u), whole = vec::floor(cycles);
    const double odd = whole - 2 * vec::floor(0.5 * whole);
    const double low_column = (cycles - whole) * g.grid - g.half_width, column = vec::ceil(low_column);
    const double row = vec::ceil((echoes.delay[i] - first) / g.step);
    at.column[i] = static_cast<std::uint32_t>(static_cast<std::int32_t>(column + g.pad));
    at.column_offset[i] = static_cast<Real>(2 * (column - low_column) - 1);
    at.row[i] = static_cast<std::uint32_t>(static_cast<std::int32_t>(row - g.first_row));

    // The pulse at this sample, and from one sample to the next. (E8)
    const double range = l.range_per_delay * echoes.delay[i];
    const double a = l.a_sent + 2 * l.a2 * range, b = 2 * l.a1 * range, per_4a = 0.25 / a;
    const double t = g.start + (row + later) * g.step - echoes.delay[i], w = 2 * pi * t;
    const double gain =
        (1 - 2 * sign * odd) * std::sqrt(l.a_sent / a) * vec::exp((b * b - w * w) * per_4a - 2 * l.a0 * range);
    const double shift = 2 * b * per_4a - echoes.doppler[i];  // of the carrier [Hz]
    double sine, cosine;
    vec::sine_cosine(shift * t, sine, cosine);
    s.re[i] = gain * (echoes.re[i] * cosine - echoes.im[i] * sine);  // (E13)
    s.im[i] = gain * (echoes.re[i] * sine + echoes.im[i] * cosine);
    vec::sine_cosine(shift * g.step, s.turn_im[i], s.turn_re[i]);
    s.power[i] = (echoes.re[i] * echoes.re[i] + echoes.im[i] * echoes.im[i]) * vec::exp(-4 * l.a0 * range);
    s.ratio[i] = vec::exp(-(2 * w + turn_step) * turn_step * per_4a);
    s.change[i] = vec::exp(-2 * turn_step * turn_step * per_4a);
  }
}

template <typename Real>
INSONIFY_CLONES void sample_gaussians(GaussianState s, std::size_t count, std::size_t rows, Real* pulse_re,
                                      Real* pulse_im) {
  for (std::size_t n = 0; n < rows; ++n) {
#pragma GCC ivdep
    for (std::size_t i = 0; i < count; ++i) {
      const double re = s.re[i], im = s.im[i], ratio = s.ratio[i];
      pulse_re[n * count + i] = static_cast<Real>(re);
      pulse_im[n * count + i] = static_cast<Real>(im);
      s.re[i] = ratio * (re * s.turn_re[i] - im * s.turn_im[i]);
      s.im[i] = ratio * (re * s.turn_im[i] + im * s.turn_re[i]);
      s.ratio[i] = ratio * s.change[i];
    }
  }
}

template <typename Real>
INSONIFY_CLONES void grid_samples(GaussianPositions<Real> at, std::size_t count, const Real* pulse_re,
                                  const Real* pulse_im, std::size_t rows, const PolynomialPieces<Real>& columns_of,
                                  Real* x_re, Real* x_im, std::size_t stride) {
  for (std::size_t i = 0; i < count; ++i)
    with_kernel(columns_of, at.column_offset[i], [&](const auto& kernel) INSONIFY_INLINE_LAMBDA {
      Real* to_re = x_re + at.row[i] * stride + at.column[i];
      Real* to_im = x_im + at.row[i] * stride + at.column[i];
      for (std::size_t n = 0; n < rows; ++n, to_re += stride, to_im += stride) {
        kernel.add(pulse_re[n * count + i], to_re);
        kernel.add(pulse_im[n * count + i], to_im);
      }
    });
}

#define INSONIFY_LOOPS(Real)                                                                                          \
  template void place_gaussians(const EchoArrays&, std::size_t, const GaussianGrid&, const PulseLosses&, std::size_t, \
                                GaussianState, GaussianPositions<Real>);                                              \
  template void sample_gaussians(GaussianState, std::size_t, std::size_t, Real*, Real*);                              \
  template void grid_samples(GaussianPositions<Real>, std::size_t, const Real*, const Real*, std::size_t,             \
                             const PolynomialPieces<Real>&, Real*, Real*, std::size_t)
INSONIFY_LOOPS(float);
INSONIFY_LOOPS(double);

INSONIFY_CLONES
void reached_bins(const double* delay, std::size_t count, const PulseAxis& axis, std::uint32_t* begin,
                  std::uint32_t* end) {
  const PulseAxis a = axis;
#pragma GCC ivdep
  for (std::size_t i = 0; i < count; ++i) {
    const double grown = 1 + a.growth * delay[i], half = a.half * std::sqrt(grown > 1 ? grown : 1);
    const double low = vec::ceil((delay[i] - half - a.start) / a.step);
    const double high = vec::floor((delay[i] + half - a.start) / a.step) + 1;
    const double from = low > a.first ? low : a.first, past = high < a.last ? high : a.last;
    begin[i] = static_cast<std::uint32_t>(static_cast<std::int32_t>(from < a.last ? from : a.last));
    end[i] = static_cast<std::uint32_t>(static_cast<std::int32_t>(past > a.first ? past : a.first));
  }
}

}  // namespace insonify::kernels
