// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/grid.hpp"

namespace insonify {

/// An array of numpy under a name.
struct NamedArray {
  std::string name;
  std::string type;  ///< "f4" or "f8"
  Eigen::Index rows, columns;
  std::string bytes;  ///< little-endian, row by row
};

/// Returns an array of float32.
NamedArray named_array(const std::string& name, const Grid<float>& values);
/// Returns an array of float64.
NamedArray named_array(const std::string& name, const Eigen::Matrix4d& values);

/// Writes a dictionary of arrays as a pickle of Python 3 (protocol 3), which pickle.load returns as {name: numpy array}.
/// Throws Error(argument) for an array of 4 GiB or more, Error(file) if it cannot write.
void write_pickle(const std::string& path, const std::vector<NamedArray>& arrays);

}  // namespace insonify
