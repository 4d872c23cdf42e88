
#include <mutex>

#include "beamforming/numerics/fft_along_rows_internal.hpp"
#include "beamforming/numerics/forward_fft_internal.hpp"

namespace insonify {
namespace {

/// FFTW creates and destroys plans one at a time, for all precisions together; executing plans needs no lock.
std::mutex& fftw_planner() {
  static std::mutex planner;
  return planner;
}

void destroy_plan(fftw_plan plan) {
  const std::scoped_lock lock(fftw_planner());
  fftw_destroy_plan(plan);
}

}  // namespace

std::size_t fft_length(std::size_t least) {
  for (std::size_t n = least + least % 2;; n += 2) {
    std::size_t rest = n;
    for (const std::size_t factor : {2, 3, 5})
      while (rest % factor == 0) rest /= factor;
    if (rest == 1) return n;
  }
}

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

template <typename Real>
FftOfRows<Real>::FftOfRows(std::size_t n, std::size_t batch, std::size_t distance, int sign) {
  AlignedArray<std::complex<Real>, Real> from(batch * distance), to(batch * distance);
  const std::scoped_lock lock(fftw_planner());
  plan_ = Fftw<Real>::make(static_cast<int>(n), static_cast<int>(batch), static_cast<int>(distance), from.data(),
                           to.data(), sign);
}

template <typename Real>
FftOfRows<Real>::~FftOfRows() {
  const std::scoped_lock lock(fftw_planner());
  Fftw<Real>::destroy(plan_);
}

ForwardFft::ForwardFft(std::size_t n) : plan_(nullptr, &destroy_plan) {
  const std::scoped_lock lock(fftw_planner());
  std::vector<std::complex<double>> buffer(n);
  auto* raw = reinterpret_cast<fftw_complex*>(buffer.data());
  plan_.reset(fftw_plan_dft_1d(static_cast<int>(n), raw, raw, FFTW_FORWARD, FFTW_ESTIMATE | FFTW_UNALIGNED));
}

void ForwardFft::run(std::vector<std::complex<double>>& data) const {
  auto* raw = reinterpret_cast<fftw_complex*>(data.data());
  fftw_execute_dft(plan_.get(), raw, raw);
}

template class FftAlongRows<float>;
template class FftAlongRows<double>;
template class FftOfRows<float>;

}  // namespace insonify
