#pragma once
#include <algorithm>
#include <complex>
#include <cstddef>
#include <new>

#include <fftw3.h>

namespace insonify {

/// FFTW functions of one precision under common names.
template <typename Real>
struct Fftw;

template <>
struct Fftw<double> {
  using Plan = fftw_plan;
  static void destroy(Plan plan) { fftw_destroy_plan(plan); }
  static Plan make(int n, int batch, int stride, std::complex<double>* buffer, int sign) {
    auto* raw = reinterpret_cast<fftw_complex*>(buffer);
    return fftw_plan_many_dft(1, &n, batch, raw, nullptr, stride, 1, raw, nullptr, stride, 1, sign, FFTW_ESTIMATE);
  }
  static void run(Plan plan, std::complex<double>* data) {
    auto* raw = reinterpret_cast<fftw_complex*>(data);
    fftw_execute_dft(plan, raw, raw);
  }
  static void* allocate(std::size_t bytes) { return fftw_malloc(bytes); }
  static void release(void* p) { fftw_free(p); }
};

template <>
struct Fftw<float> {
  using Plan = fftwf_plan;
  static void destroy(Plan plan) { fftwf_destroy_plan(plan); }
  static Plan make(int n, int batch, int stride, std::complex<float>* buffer, int sign) {
    auto* raw = reinterpret_cast<fftwf_complex*>(buffer);
    return fftwf_plan_many_dft(1, &n, batch, raw, nullptr, stride, 1, raw, nullptr, stride, 1, sign, FFTW_ESTIMATE);
  }
  static void run(Plan plan, std::complex<float>* data) {
    auto* raw = reinterpret_cast<fftwf_complex*>(data);
    fftwf_execute_dft(plan, raw, raw);
  }
  static void* allocate(std::size_t bytes) { return fftwf_malloc(bytes); }
  static void release(void* p) { fftwf_free(p); }
};

/// An array with the alignment that FFTW requires.
template <typename T, typename Real>
class AlignedArray {
 public:
  explicit AlignedArray(std::size_t n) : size_(n), data_(static_cast<T*>(Fftw<Real>::allocate(n * sizeof(T)))) {
    if (!data_) throw std::bad_alloc();
    clear();
  }
  ~AlignedArray() { Fftw<Real>::release(data_); }
  AlignedArray(const AlignedArray&) = delete;
  AlignedArray& operator=(const AlignedArray&) = delete;
  T* data() { return data_; }
  const T* data() const { return data_; }
  T& operator[](std::size_t i) { return data_[i]; }
  void clear() { std::fill_n(data_, size_, T{}); }

 private:
  std::size_t size_;
  T* data_;
};

/// In-place FFT of length n of `batch` series; entry k of series s is at index k * stride + s. Plans use FFTW_ESTIMATE,
/// so bits do not depend on timing.
template <typename Real>
class FftAlongRows {
 public:
  /// stride   distance between rows, at least `batch`
  FftAlongRows(std::size_t n, std::size_t batch, std::size_t stride, int sign);
  FftAlongRows(std::size_t n, std::size_t batch, int sign) : FftAlongRows(n, batch, batch, sign) {}
  ~FftAlongRows();
  FftAlongRows(const FftAlongRows&) = delete;
  FftAlongRows& operator=(const FftAlongRows&) = delete;
  /// Transforms `data`, allocated by AlignedArray; may be called concurrently.
  void run(std::complex<Real>* data) const { Fftw<Real>::run(plan_, data); }

 private:
  typename Fftw<Real>::Plan plan_;
};

}  // namespace insonify
