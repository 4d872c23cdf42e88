#pragma once
#include <algorithm>
#include <complex>
#include <cstddef>
#include <new>
#include <vector>

#include <fftw3.h>

namespace insonify {

/// Returns the smallest even number >= `least` without a prime factor above 5, a fast length for FFTW.
std::size_t fft_length(std::size_t least);

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
  static Plan make(int n, int batch, int distance, std::complex<double>* from, std::complex<double>* to, int sign) {
    return fftw_plan_many_dft(1, &n, batch, reinterpret_cast<fftw_complex*>(from), nullptr, 1, distance,
                              reinterpret_cast<fftw_complex*>(to), nullptr, 1, distance, sign, FFTW_ESTIMATE);
  }
  static void run(Plan plan, std::complex<double>* from, std::complex<double>* to) {
    fftw_execute_dft(plan, reinterpret_cast<fftw_complex*>(from), reinterpret_cast<fftw_complex*>(to));
  }
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
  static Plan make(int n, int batch, int distance, std::complex<float>* from, std::complex<float>* to, int sign) {
    return fftwf_plan_many_dft(1, &n, batch, reinterpret_cast<fftwf_complex*>(from), nullptr, 1, distance,
                               reinterpret_cast<fftwf_complex*>(to), nullptr, 1, distance, sign, FFTW_ESTIMATE);
  }
  static void run(Plan plan, std::complex<float>* from, std::complex<float>* to) {
    fftwf_execute_dft(plan, reinterpret_cast<fftwf_complex*>(from), reinterpret_cast<fftwf_complex*>(to));
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

/// FFT of length n of `batch` series, one after another, `distance` numbers apart, from one array to another.
template <typename Real>
class FftOfRows {
 public:
  FftOfRows(std::size_t n, std::size_t batch, std::size_t distance, int sign);
  ~FftOfRows();
  FftOfRows(const FftOfRows&) = delete;
  FftOfRows& operator=(const FftOfRows&) = delete;
  /// Both from AlignedArray, or a multiple of 16 bytes into one; may be called concurrently.
  void run(std::complex<Real>* from, std::complex<Real>* to) const { Fftw<Real>::run(plan_, from, to); }

 private:
  typename Fftw<Real>::Plan plan_;
};

}  // namespace insonify
