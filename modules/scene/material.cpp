// SPDX-License-Identifier: BSD-3-Clause
#include "scene/material.hpp"

#include <cmath>

namespace insonify {

void require_valid(const Material& material, const char* who, ErrorKind kind) {
  for (const MaterialNumber& n : material_numbers) {
    const double value = material.*n.member;
    if (value >= 0 && value <= n.most && std::isfinite(value)) continue;
    const std::string unit = *n.unit ? std::string(" ") + n.unit : "";
    if (std::isinf(n.most))
      fail(kind, who, ": ", n.name, " of material '", material.name, "' = ", value, unit, ", must be finite and >= 0");
    fail(kind, who, ": ", n.name, " of material '", material.name, "' = ", value, unit, ", must be within 0 and ",
         n.most);
  }
}

}  // namespace insonify
