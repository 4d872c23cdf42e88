// SPDX-License-Identifier: BSD-3-Clause
// Implements SurfaceRays for builds without Embree.
#include "core/error.hpp"
#include "scene/surface_rays.hpp"

namespace insonify {

bool SurfaceRays::available() { return false; }

SurfaceRays::SurfaceRays(const SceneCloud&, double) {
  fail(ErrorKind::runtime, "SurfaceRays: this build of insonify has no rays from surface to surface; install ",
       "libembree-dev, and build it again");
}

SurfaceRayEnd SurfaceRays::first_hit(const SurfaceRay&) const { return {}; }

}  // namespace insonify
