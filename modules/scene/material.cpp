#include "scene/material.hpp"

#include <cmath>

namespace insonify {

void require_valid(const Material& material, const char* who, ErrorKind kind) {
  const auto require = [&](bool good, const char* name, double value, const char* rule) {
    if (!good) fail(kind, who, ": ", name, " of material '", material.name, "' = ", value, rule);
  };
  const auto at_least_0 = [](double value) { return value >= 0 && std::isfinite(value); };
  require(at_least_0(material.lambert_mu), "lambert_mu", material.lambert_mu, " 1/sr, must be finite and >= 0");
  require(material.coherent_fraction >= 0 && material.coherent_fraction <= 1, "coherent_fraction",
          material.coherent_fraction, ", must be within 0 and 1");
  require(at_least_0(material.relief_slope), "relief_slope", material.relief_slope, ", must be finite and >= 0");
}

}  // namespace insonify
