// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "beamforming/pulses/gaussian_batch_internal.hpp"

namespace insonify {
namespace {

constexpr std::size_t at_once = 32;  // samples by recurrence: its error grows with the square of their number

}  // namespace

template <typename Real>
double GaussianBatch<Real>::sample(const kernels::GaussianGrid& grid, const EchoShapes& shapes, const Medium& medium,
                                   const Echoes& echoes, std::span<const std::uint32_t> list, double unit,
                                   std::size_t rows) {
  // Amplitudes and places, gathered; their arrays lie side by side.
  std::array<double, 12 * most> numbers;
  const auto array = [&](std::size_t k) { return numbers.data() + k * most; };
  double *delay = array(0), *u = array(1), *amplitude_re = array(2), *amplitude_im = array(3), *doppler = array(4);
  double power = 0, latest = 0;
  for (std::size_t k = 0; k < list.size(); ++k) {
    const std::uint32_t i = list[k];
    delay[k] = echoes.delay[i];
    u[k] = echoes.u[i];
    amplitude_re[k] = echoes.amplitude[i].real() / unit;
    amplitude_im[k] = echoes.amplitude[i].imag() / unit;
    doppler[k] = echoes.doppler_of(i);
    latest = std::max(latest, delay[k]);
  }
  shapes.of(latest);
  const Absorption& absorption = medium.absorption;
  const kernels::PulseLosses losses{shapes.of(0).a, 0.5 * medium.sound_speed, absorption.a0, absorption.a1,
                                    absorption.a2};
  const kernels::GaussianState state{array(5), array(6), array(7), array(8), array(9), array(10), array(11)};
  re.resize(most * rows);
  im.resize(most * rows);
  for (std::size_t n = 0; n < rows; n += at_once) {
    kernels::place_gaussians({delay, u, amplitude_re, amplitude_im, doppler}, list.size(), grid, losses, n, state,
                             positions());
    kernels::sample_gaussians(state, list.size(), std::min(at_once, rows - n), re.data() + n * list.size(),
                              im.data() + n * list.size());
  }
  for (std::size_t k = 0; k < list.size(); ++k) power += state.power[k];
  return power;
}

template struct GaussianBatch<float>;
template struct GaussianBatch<double>;

}  // namespace insonify
