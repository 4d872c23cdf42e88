// SPDX-License-Identifier: BSD-3-Clause
#include "acoustics/scattering.hpp"

namespace insonify {

double lambert_cross_section(double lambert_mu, double cos_back, double seen_area) {
  return lambert_mu * cos_back * seen_area;  // (E4)
}

double cross_section(const Material& material, const InsonifiedPatch& patch, double /*frequency*/) {
  return lambert_cross_section(material.lambert_mu, patch.cos_back, patch.seen_area);
}

}  // namespace insonify
