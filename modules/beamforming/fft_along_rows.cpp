
#include "beamforming/fft_along_rows_internal.hpp"
#include "beamforming/fftw_planner_internal.hpp"

namespace insonify {

template <typename Real>
FftAlongRows<Real>::FftAlongRows(std::size_t n, std::size_t batch, std::size_t stride, int sign) {
  AlignedArray<std::complex<Real>, Real> buffer(n * stride);
  const std::scoped_lock lock(fftw_planner());
  plan_ = Fftw<Real>::make(static_cast<int>(n), static_cast<int>(batch), static_cast<int>(stride), buffer.data(), sign);
}

template <typename Real>
FftAlongRows<Real>::~FftAlongRows() {
  const std::scoped_lock lock(fftw_planner());
  Fftw<Real>::destroy(plan_);
}

template class FftAlongRows<float>;
template class FftAlongRows<double>;

}  // namespace insonify
