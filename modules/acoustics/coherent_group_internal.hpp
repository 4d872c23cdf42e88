// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <optional>
#include <vector>

#include "acoustics/fit_shapes.hpp"
#include "acoustics/plane_outline_internal.hpp"
#include "acoustics/shape_fits_internal.hpp"

// Private to acoustics: connected surfels of a coherent material.
namespace insonify {

/// A coherent part: what its shapes have in common, and how its surfels may stray from them.
struct CoherentGroup {
  const SurfelGroup& surfels;
  const Material& material;
  SurfelNoise noise;

  SmoothTarget target() const {
    SmoothTarget target;
    target.surface.name = material.name;
    target.surface.reflection = material.reflection, target.surface.rms_height = material.rms_height;
    target.surface.thickness = std::max(surfels.spacing(), 3 * noise.deviation);
    target.material = surfels.scene.material[surfels.members[0]];
    return target;
  }
  SmoothTarget plate(const FittedPlane& plane, const SurfelGroup& of) const {
    SmoothTarget made = target();
    made.surface = mirror_of(of, plane, material);
    return made;
  }
  bool is_nearly_all(double area) const { return area >= explained_share * surfels.area(); }
};

/// A cylinder with its ends, and how well it fits.
struct FittedCylinder {
  RoundBody body;
  std::vector<SmoothTarget> targets;
};

/// Returns the cylinder of a part whose side and ends hold nearly all of its surfels, with its ends as plates where they were
/// captured. Its axis is near one of those of the normals' distribution.
std::optional<FittedCylinder> cylinder_of(const CoherentGroup& group);

}  // namespace insonify
