// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>

#include "core/grid.hpp"

namespace insonify {

/// An array of a .npy file with two dimensions.
struct NpyArray {
  Grid<double> real;
  Grid<double> imaginary{};  ///< imaginary part; empty: the numbers are real
  int unsigned_bits = 0;     ///< 8 or 16 for grey values; 0 for other numbers
};

/// Returns the array of a .npy file of numpy (format 1 to 3): little-endian float32 or float64, complex64 or
/// complex128, uint8 or uint16, in the order of C or Fortran. Throws Error(file) if the file cannot be read. Throws
/// Error(content), with the remedy, if it is not such a file, is truncated, big-endian, of another type, or does not
/// have two dimensions of at least 1.
NpyArray read_npy(const std::string& path);

}  // namespace insonify
