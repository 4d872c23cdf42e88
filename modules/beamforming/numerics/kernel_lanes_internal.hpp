// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>

#include "beamforming/numerics/gridding_kernel_internal.hpp"
#include "core/vector_functions.hpp"

namespace insonify::kernels {

/// A vector of `bytes` bytes; the compiler maps it to one register, or to several narrower ones. Compilers break loops
/// over plain arrays of eight numbers into single numbers if the numbers stay the same from row to row; this type
/// prevents that.
template <typename Real, std::size_t bytes = 32>
struct Register {
  typedef Real Type __attribute__((vector_size(bytes)));
};

/// Kernel of one echo across `lanes` columns, kept in registers.
template <std::size_t lanes, typename Real>
struct KernelLanes {
  using Part = typename Register<Real>::Type;
  static constexpr std::size_t at_once = sizeof(Part) / sizeof(Real), parts = lanes / at_once;
  Part part[parts];

  /// The polynomials of all lanes at t, by Horner's rule.
  [[gnu::always_inline]] KernelLanes(const PolynomialPieces<Real>& p, Real t) {
    const Real* coefficient = p.coefficient.data();
    __builtin_memcpy(part, coefficient, sizeof part);
    for (std::size_t k = 1; k <= p.degree; ++k) {
      coefficient += lanes;
      for (std::size_t l = 0; l < parts; ++l) {
        Part next;
        __builtin_memcpy(&next, coefficient + l * at_once, sizeof next);
        part[l] = part[l] * t + next;
      }
    }
  }
  [[gnu::always_inline]] void store(Real* to) const { __builtin_memcpy(to, part, sizeof part); }
  /// to(l) += factor kernel(l).
  [[gnu::always_inline]] void add(Real factor, Real* to) const {
    for (std::size_t l = 0; l < parts; ++l) {
      Part sum;
      __builtin_memcpy(&sum, to + l * at_once, sizeof sum);
      sum += factor * part[l];
      __builtin_memcpy(to + l * at_once, &sum, sizeof sum);
    }
  }
};

/// A lambda that is compiled for the instruction set of the variant that calls it.
#define INSONIFY_INLINE_LAMBDA __attribute__((always_inline))

/// Calls use(kernel) with the KernelLanes of polynomials with 8 or 16 lanes at t.
template <typename Real, typename Use>
INSONIFY_ALWAYS_INLINE void with_kernel(const PolynomialPieces<Real>& p, Real t, const Use& use) {
  if (p.lanes == 8)
    use(KernelLanes<8, Real>(p, t));
  else
    use(KernelLanes<16, Real>(p, t));
}

}  // namespace insonify::kernels
