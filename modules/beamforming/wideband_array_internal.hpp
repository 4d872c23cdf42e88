#pragma once
#include <complex>
#include <vector>

#include "beamforming/fft_along_rows_internal.hpp"
#include "beamforming/wideband_loops_internal.hpp"
#include "beamforming/wideband_plan_internal.hpp"

namespace insonify {

using WidebandSpectrum = AlignedArray<std::complex<float>, float>;  ///< rows x fine_row

/// From the spectrum of echoes to that of focused beams: what elements hear of bent wavefronts, times the array's
/// response, and what beams undo of the bend (E68). With z the phase of the bend at a place and frequency and S the
/// filter along harmonics that multiplies by its dependence on direction,
///
///   P = sum over q + q' <= order of S^q' (-i z)^q' / q'! R (i z)^q / q! S^q E
///
/// cut by the sum of the powers, so that what is cut vanishes where an echo stands in its beam.
class WidebandArray {
 public:
  explicit WidebandArray(const WidebandPlan& plan);

  /// In place. With two fields `excess` holds the echoes weighted by their excess of curvature, and is left with what
  /// beams hear less for each part of their own excess. `part`: of the array.
  void apply(std::size_t part, double curvature, const WidebandEffort& effort, WidebandSpectrum& echoes,
             WidebandSpectrum* excess);

 private:
  void apply(std::size_t first_line, const WidebandEffort& effort, WidebandSpectrum& echoes, WidebandSpectrum* excess);
  void add_second_field(int n, int order);
  void begin_cubic();
  void add_cubic(const float* weight, kernels::SpectrumChunk from, kernels::SpectrumChunk to) const;
  void bend(int n, int factorial_of, kernels::SpectrumChunk from, kernels::SpectrumChunk to) const;
  void form(int n, int factorial_of, kernels::SpectrumChunk from, kernels::SpectrumChunk to) const;
  void filter(const std::vector<float>& tap, kernels::SpectrumChunk& chunk);
  void copy(kernels::SpectrumChunk from, kernels::SpectrumChunk to) const;
  void clear(kernels::SpectrumChunk chunk) const;
  void read(const WidebandSpectrum& spectrum, kernels::SpectrumChunk to) const;
  void write(kernels::SpectrumChunk from, WidebandSpectrum& spectrum) const;

  const WidebandPlan& plan_;
  std::vector<float> room_, phase_, shift_;
  const std::vector<float>* tap_ = nullptr;
  const float* response_ = nullptr;  ///< of the part at work
  std::size_t line_ = 0;             ///< first of those at work
  // Echoes times powers of S, what elements hear, and beams; the same of the second field; third order; spare.
  kernels::SpectrumChunk echo_, received_, beam_, echo_2_, received_2_, beam_2_, arriving_, undone_, spare_;
};

}  // namespace insonify
