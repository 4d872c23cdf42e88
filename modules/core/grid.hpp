#pragma once
#include <complex>

#include <Eigen/Core>

// Debian's PCL is built for baseline x86-64: with AVX flags its objects change size and answers go silently
// wrong. Every file that sees Eigen is therefore compiled at baseline (docs/decisions.md).
static_assert(EIGEN_MAX_ALIGN_BYTES == 16 || EIGEN_MAX_ALIGN_BYTES == 0,
              "insonify: compile without AVX flags (-march=native, -mavx...); see docs/decisions.md");

namespace insonify {

/// Rows x columns, row-major: grid(beam, bin).
template <typename T>
using Grid = Eigen::Array<T, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

using ComplexGrid = Grid<std::complex<double>>;
using ComplexGridF = Grid<std::complex<float>>;

}  // namespace insonify
