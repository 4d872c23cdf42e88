#pragma once
#include <cstddef>

// Kernels over raw pointers, compiled for several instruction sets and chosen at run time. They see no Eigen, so
// wider registers are safe here; without fused multiply-add every variant gives the same bits.
namespace insonify::kernels {

/// Phases exp(i step (m - (N-1)/2)) of the N elements for one echo, as two rows of N. Relative error below 1e-13.
void element_phases(double step, std::size_t elements, double* re, double* im);

/// beam(n) = sum_m steering(m) x(m, n) for `bins` <= 64 samples; x is elements x stride, one row per element.
void sum_elements(const double* s_re, const double* s_im, std::size_t elements, const double* x_re, const double* x_im,
                  std::size_t stride, std::size_t bins, double* beam_re, double* beam_im);

}  // namespace insonify::kernels
