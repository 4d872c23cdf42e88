// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <complex>
#include <cstddef>
#include <vector>

#include <boost/align/aligned_allocator.hpp>
#include <fftw3.h>

namespace insonify {

/// Returns the smallest length >= `least`, a multiple of 8, that FFTW transforms fast for its size: measured with
/// FFTW_ESTIMATE, others take up to twice as long.
std::size_t fft_length(std::size_t least);

/// Where the numbers of some series lie: entry k of series s at k stride + s distance.
struct FftLayout {
  std::size_t length, series = 1, stride = 1, distance = 0;
  bool in_place = true;  ///< else from one array to another
};

/// FFTW functions of one precision under common names.
template <typename Real>
struct Fftw;

template <>
struct Fftw<double> {
  using Plan = fftw_plan;
  using Number = fftw_complex;
  static constexpr auto make = fftw_plan_many_dft;
  static constexpr auto destroy = fftw_destroy_plan;
  static constexpr auto run = fftw_execute_dft;
};

template <>
struct Fftw<float> {
  using Plan = fftwf_plan;
  using Number = fftwf_complex;
  static constexpr auto make = fftwf_plan_many_dft;
  static constexpr auto destroy = fftwf_destroy_plan;
  static constexpr auto run = fftwf_execute_dft;
};

/// An array that begins with a cache line, as FFTW and vector registers like it.
template <typename T>
using Aligned = std::vector<T, boost::alignment::aligned_allocator<T, 64>>;

/// FFT of some series of one layout. Plans use FFTW_ESTIMATE, so bits do not depend on timing.
template <typename Real>
class Fft {
 public:
  /// sign   FFTW_FORWARD or FFTW_BACKWARD
  Fft(const FftLayout& layout, int sign);
  ~Fft();
  Fft(const Fft&) = delete;
  Fft& operator=(const Fft&) = delete;
  /// Transforms `data` in place, or one array to another, as the layout has it; both begin at a multiple of 16 bytes,
  /// as memory of operator new does. May be called concurrently.
  void run(std::complex<Real>* data) const { run(data, data); }
  void run(std::complex<Real>* from, std::complex<Real>* to) const { Fftw<Real>::run(plan_, raw(from), raw(to)); }

 private:
  using Number = typename Fftw<Real>::Number;
  static Number* raw(std::complex<Real>* x) { return reinterpret_cast<Number*>(x); }

  typename Fftw<Real>::Plan plan_;
};

}  // namespace insonify
