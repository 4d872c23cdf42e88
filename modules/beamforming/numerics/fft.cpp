// SPDX-License-Identifier: BSD-3-Clause

#include <bit>

#include "beamforming/numerics/fft_internal.hpp"

namespace insonify {
namespace {

/// Lets FFTW create and destroy plans one at a time, by its own lock: each extension of Python has a copy of this file,
/// and all of the process share the planners of FFTW. Executing plans needs no lock.
void lock_planners() {
  static const bool locked = (fftw_make_planner_thread_safe(), fftwf_make_planner_thread_safe(), true);
  static_cast<void>(locked);
}

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
  AlignedArray<std::complex<Real>, Real> from(numbers), to(layout.in_place ? 0 : numbers);
  lock_planners();
  plan_ = Fftw<Real>::make(static_cast<int>(layout.length), static_cast<int>(layout.series),
                           static_cast<int>(layout.stride), static_cast<int>(layout.distance), from.data(),
                           layout.in_place ? from.data() : to.data(), sign);
}

template <typename Real>
Fft<Real>::~Fft() {
  Fftw<Real>::destroy(plan_);
}

template class Fft<float>;
template class Fft<double>;

}  // namespace insonify
