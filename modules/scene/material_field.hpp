// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace insonify {

/// Interval of numbers that mean one material: `from` is included, `to` is not.
struct MaterialInterval {
  double from = -std::numeric_limits<double>::infinity();
  double to = std::numeric_limits<double>::infinity();
  std::uint16_t material = 0;  ///< index into the materials
};

/// The field of a cloud that gives the material of each point.
struct MaterialField {
  std::string name;  ///< name of the scalar field, in any case and without CloudCompare's prefix "scalar_". Empty: the
                     ///< first of label, material, class, classification that exists
  std::vector<MaterialInterval> intervals;  ///< empty: the number itself is the index
};

}  // namespace insonify
