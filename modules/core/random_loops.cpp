// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "core/random.hpp"
#include "core/target_clones.hpp"
#include "core/vector_functions.hpp"

namespace insonify {

INSONIFY_CLONES
void complex_normals(const double* u, const double* turn, std::size_t count, double* re, double* im) {
#pragma GCC ivdep
  for (std::size_t i = 0; i < count; ++i) {
    double sine, cosine;
    vec::sine_cosine(turn[i], sine, cosine);
    const double magnitude = std::sqrt(-vec::log(u[i]));  // (E9)
    re[i] = magnitude * cosine;
    im[i] = magnitude * sine;
  }
}

}  // namespace insonify
