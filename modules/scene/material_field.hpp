// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace insonify {

/// Numbers from `from` up to, but not including, `to` mean this material.
struct MaterialInterval {
  double from = -std::numeric_limits<double>::infinity();
  double to = std::numeric_limits<double>::infinity();
  std::uint16_t material = 0;  ///< index into the materials
};

/// Which number of a cloud's point says what material it is of.
struct MaterialField {
  std::string name;  ///< of the scalar field, whatever its case and CloudCompare's prefix "scalar_"; empty: the first
                     ///< of label, material, class, classification
  std::vector<MaterialInterval> intervals;  ///< empty: the number itself is the index
};

}  // namespace insonify
