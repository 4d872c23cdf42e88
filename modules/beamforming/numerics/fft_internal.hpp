// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <complex>
#include <cstddef>
#include <new>
#include <vector>

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
  static fftw_complex* raw(std::complex<double>* x) { return reinterpret_cast<fftw_complex*>(x); }
  static void destroy(Plan plan) { fftw_destroy_plan(plan); }
  static Plan make(int n, int series, int stride, int distance, std::complex<double>* from, std::complex<double>* to,
                   int sign) {
    return fftw_plan_many_dft(1, &n, series, raw(from), nullptr, stride, distance, raw(to), nullptr, stride, distance,
                              sign, FFTW_ESTIMATE);
  }
  static void run(Plan plan, std::complex<double>* from, std::complex<double>* to) {
    fftw_execute_dft(plan, raw(from), raw(to));
  }
};

template <>
struct Fftw<float> {
  using Plan = fftwf_plan;
  static fftwf_complex* raw(std::complex<float>* x) { return reinterpret_cast<fftwf_complex*>(x); }
  static void destroy(Plan plan) { fftwf_destroy_plan(plan); }
  static Plan make(int n, int series, int stride, int distance, std::complex<float>* from, std::complex<float>* to,
                   int sign) {
    return fftwf_plan_many_dft(1, &n, series, raw(from), nullptr, stride, distance, raw(to), nullptr, stride, distance,
                               sign, FFTW_ESTIMATE);
  }
  static void run(Plan plan, std::complex<float>* from, std::complex<float>* to) {
    fftwf_execute_dft(plan, raw(from), raw(to));
  }
};

/// Memory that begins with a cache line, as FFTW and vector registers like it.
template <typename T>
struct LineAllocator {
  using value_type = T;
  LineAllocator() = default;
  template <typename Other>
  LineAllocator(const LineAllocator<Other>&) {}
  T* allocate(std::size_t n) { return static_cast<T*>(::operator new(n * sizeof(T), line)); }
  void deallocate(T* p, std::size_t) { ::operator delete(p, line); }
  bool operator==(const LineAllocator&) const { return true; }

 private:
  static constexpr std::align_val_t line{64};
};
using AlignedFloats = std::vector<float, LineAllocator<float>>;

/// An array with the alignment that FFTW requires.
template <typename T, typename Real>
class AlignedArray {
 public:
  explicit AlignedArray(std::size_t n) : data_(n) {}
  AlignedArray(const AlignedArray&) = delete;
  AlignedArray& operator=(const AlignedArray&) = delete;
  T* data() { return data_.data(); }
  const T* data() const { return data_.data(); }
  T& operator[](std::size_t i) { return data_[i]; }
  void clear() { std::fill(data_.begin(), data_.end(), T{}); }

 private:
  std::vector<T, LineAllocator<T>> data_;
};

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
  void run(std::complex<Real>* data) const { Fftw<Real>::run(plan_, data, data); }
  void run(std::complex<Real>* from, std::complex<Real>* to) const { Fftw<Real>::run(plan_, from, to); }

 private:
  typename Fftw<Real>::Plan plan_;
};

}  // namespace insonify
