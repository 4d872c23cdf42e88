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
  if (const std::string problem = problem_of(material.law); !problem.empty())
    fail(kind, who, ": law '", name_of(material.law), "' of material '", material.name, "': ", problem);
  if (material.relief_slope > 0 && traits_of(material.law).own_slopes)
    fail(kind, who, ": relief_slope of material '", material.name, "' = ", material.relief_slope, ", must be 0: law '",
         name_of(material.law), "' has slopes of its own");
}

}  // namespace insonify
