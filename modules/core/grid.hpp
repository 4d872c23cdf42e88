// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <complex>

#include <Eigen/Core>

// Debian builds PCL for baseline x86-64. With AVX flags Eigen objects change alignment and size across that binary
// interface, and results are silently wrong. Every file that includes Eigen is therefore compiled for the baseline
// (docs/decisions.md).
static_assert(EIGEN_MAX_ALIGN_BYTES == 16 || EIGEN_MAX_ALIGN_BYTES == 0,
              "insonify: compile without AVX flags (-march=native, -mavx...); see docs/decisions.md");

namespace insonify {

/// Row-major array, indexed grid(row, column), e.g. grid(beam, bin).
template <typename T>
using Grid = Eigen::Array<T, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Complex numbers in double precision, for synthesis.
using ComplexGrid = Grid<std::complex<double>>;
/// Complex numbers in single precision, as pings store them.
using ComplexGridF = Grid<std::complex<float>>;

}  // namespace insonify
