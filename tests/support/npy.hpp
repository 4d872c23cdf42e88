// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <vector>

#include "core/grid.hpp"
#include "support/files.hpp"

namespace insonify {

/// Returns a .npy file of format 1, as numpy.save writes it.
template <typename Number>
std::string made_npy(const std::string& type, const std::string& shape, bool fortran,
                     const std::vector<Number>& numbers) {
  std::string header =
      "{'descr': '" + type + "', 'fortran_order': " + (fortran ? "True" : "False") + ", 'shape': (" + shape + "), }";
  header.append(63 - (10 + header.size()) % 64, ' ');
  header += '\n';
  std::string bytes = "\x93NUMPY";
  bytes += '\1', bytes += '\0', bytes += static_cast<char>(header.size()), bytes += '\0';
  return bytes + header + std::string(reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(Number));
}

/// Returns a .npy file of numbers in the order of C.
inline std::string npy_of(const Grid<float>& grid) {
  const std::vector<float> numbers(grid.data(), grid.data() + grid.size());
  return made_npy("<f4", std::to_string(grid.rows()) + ", " + std::to_string(grid.cols()), false, numbers);
}

}  // namespace insonify
