// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "scene/material.hpp"

namespace insonify {

/// A patch of a surface as the legs out and back of one echo meet it.
struct InsonifiedPatch {
  double cos_out = 1;    ///< cosine between the normal and the leg out, in [0, 1]
  double cos_back = 1;   ///< the same for the leg back
  double seen_area = 0;  ///< [m^2], as seen along the leg out: cos_out dS, or solid angle of a ray x range^2
};

/// Cross-section [m^2] of a patch of `material` for sound of `frequency` [Hz]: the one place where a material model is
/// computed. Today it is Lambert's law (E4), mu cos_out cos_back dS, the same at all frequencies.
double cross_section(const Material& material, const InsonifiedPatch& patch, double frequency);

/// Lambert's law alone [m^2] (E4): lambert_mu cos_back seen_area. The area as seen holds one cosine already, so that
/// this is mu cos^2 dS for a surfel whose legs out and back are one line, and mu cos r^2 dOmega for a ray.
double lambert_cross_section(double lambert_mu, double cos_back, double seen_area);

}  // namespace insonify
