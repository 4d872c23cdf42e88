#pragma once
#include <cmath>
#include <cstdint>
#include <vector>

#include "core/units.hpp"
#include "scene/scene_cloud.hpp"
#include "view/show_scene.hpp"

namespace insonify::test {

/// Adds a sphere of about `count` surfels with outward normals (a Fibonacci lattice).
inline void add_sphere(SceneCloud& scene, const Eigen::Vector3d& centre, double radius, int count) {
  const double golden = pi * (3 - std::sqrt(5.0));
  for (int i = 0; i < count; ++i) {
    const double z = 1 - (2.0 * i + 1) / count, r = std::sqrt(1 - z * z);
    const Eigen::Vector3d normal(r * std::cos(golden * i), r * std::sin(golden * i), z);
    add_surfel(scene, centre + radius * normal, normal, 4 * pi * radius * radius / count);
  }
}

/// Adds a horizontal square of side x side surfels, normals up, with its first corner at `corner`.
inline void add_floor(SceneCloud& scene, const Eigen::Vector3d& corner, int side, double spacing) {
  for (int i = 0; i < side; ++i)
    for (int k = 0; k < side; ++k)
      add_surfel(scene, corner + Eigen::Vector3d((i + 0.5) * spacing, (k + 0.5) * spacing, 0), {0, 0, 1},
                 spacing * spacing);
}

/// A head with a fan of 61 beams.
inline SceneHead head_at(const Pose& world_from_head, double field_of_view_deg = 90, double max_range = 15) {
  return {world_from_head, make_fan(61, radians(field_of_view_deg), radians(2), radians(20)), {1, max_range, 0.05}};
}

}  // namespace insonify::test
