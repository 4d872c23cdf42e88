// SPDX-License-Identifier: BSD-3-Clause

#include <bit>

#include "beamforming/numerics/fft_internal.hpp"

namespace insonify {
namespace {

/// FFTW makes and destroys plans one at a time, by its own lock, from before main() on: all of a process share its
/// planners, those of a program that plans for itself, too. Executing plans needs no lock.
const bool planners_are_locked = (fftw_make_planner_thread_safe(), fftwf_make_planner_thread_safe(), true);

}  // namespace

std::size_t fft_length(std::size_t least) {
  for (const std::size_t length : {16, 24, 32, 40, 48, 64, 80, 96, 120, 128, 144, 160, 192, 240, 256, 320, 384, 400})
    if (length >= least) return length;
  const std::size_t power = std::bit_ceil(least);
  for (const std::size_t length : {power / 8 * 5, power / 4 * 3})
    if (length >= least) return length;
  return power;
}

template <typename Real>
Fft<Real>::Fft(const FftLayout& layout, int sign) {
  const std::size_t numbers = layout.length * layout.stride + layout.series * layout.distance;
  Aligned<std::complex<Real>> from(numbers), to(layout.in_place ? 0 : numbers);
  const auto stride = static_cast<int>(layout.stride), distance = static_cast<int>(layout.distance),
             length = static_cast<int>(layout.length);
  plan_ =
      Fftw<Real>::make(1, &length, static_cast<int>(layout.series), raw(from.data()), nullptr, stride, distance,
                       raw(layout.in_place ? from.data() : to.data()), nullptr, stride, distance, sign, FFTW_ESTIMATE);
}

template <typename Real>
Fft<Real>::~Fft() {
  Fftw<Real>::destroy(plan_);
}

template class Fft<float>;
template class Fft<double>;

}  // namespace insonify
