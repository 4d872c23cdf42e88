// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>

// Inner loops over raw pointers, compiled for several instruction sets and dispatched at run time, with the same bits
// on each. They do not include Eigen, so wide registers are safe.
namespace insonify::kernels {

/// Numbers that are treated side by side.
constexpr std::size_t energy_lanes = 16;

/// Complex numbers of unit magnitude, side by side.
struct Turns {
  double re[energy_lanes], im[energy_lanes];
};

/// Adds the m-th power of each of the first `number` turns to term m, m < count, one turn after the other.
void add_powers(const Turns& turns, std::size_t number, std::size_t count, double* term_re, double* term_im);

/// Sets sum[l] to the real part of the sum over m < count of term m times the m-th power of turn l.
void sum_powers(const Turns& turns, const double* term_re, const double* term_im, std::size_t count, double* sum);

}  // namespace insonify::kernels
