// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>

// Kernels over raw pointers, compiled for several instruction sets and dispatched at run time. They do not include
// Eigen, so wide registers are safe; without fused multiply-add all variants give the same bits.
namespace insonify::kernels {

/// Writes the phasors exp(i step (m - (N-1)/2)) of the N elements for one echo, as real and imaginary parts. Relative
/// error below 1e-13.
void element_phases(double step, std::size_t elements, double* re, double* im);

/// Computes beam(n) = sum_m steering(m) x(m, n) for `bins` <= 64 samples; x is elements x stride, one row per element.
void sum_elements(const double* s_re, const double* s_im, std::size_t elements, const double* x_re, const double* x_im,
                  std::size_t stride, std::size_t bins, double* beam_re, double* beam_im);

}  // namespace insonify::kernels
