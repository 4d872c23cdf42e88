// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "core/parallel.hpp"
#include "sampling/tilt_by_relief_internal.hpp"
#include "sonar/beam_fan.hpp"

namespace insonify {
namespace {

using Eigen::Vector3d;

constexpr std::size_t scatterers_at_once = 1024;
constexpr double edge_on = 1e-9;  // surfaces with a smaller cosine of incidence are edge-on and invisible

struct Tilter {
  const SceneCloud& scene;
  const Pose& world_from_head;
  const SceneRelief& relief;

  void tilt(Scatterers& s, std::size_t i) const {
    const Vector3d outward = world_from_head.linear() * unit_vector({s.azimuth[i], s.elevation[i]});
    const Vector3d position = world_from_head.translation() + s.range[i] * outward;
    const Vector3d normal = scene.normal[s.surfel[i]].cast<double>().normalized();
    const Vector3d facet = relief.facet_of(scene, s.surfel[i], scene.materials[s.material[i]].relief_slope, position);

    // A surface with unoriented normals presents the side that faces the head, with its relief.
    const double smooth = -normal.dot(outward);
    const bool seen = scene.oriented(s.surfel[i]) ? smooth > edge_on : std::abs(smooth) > edge_on;
    const double tilted = std::clamp(smooth < 0 ? facet.dot(outward) : -facet.dot(outward), 0.0, 1.0);
    const double gain = seen ? tilted / std::abs(smooth) : 0;
    s.cos_incidence[i] = static_cast<float>(seen ? tilted : 0);
    s.projected_area[i] = static_cast<float>(s.projected_area[i] * gain);  // (E52)
  }
};

}  // namespace

void tilt_by_relief(const SceneCloud& scene, const Pose& world_from_head, const SceneRelief& relief, int threads,
                    Scatterers& scatterers) {
  const Tilter tilter{scene, world_from_head, relief};
  parallel_blocks(scatterers.size(), scatterers_at_once, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      if (scene.materials[scatterers.material[i]].relief_slope > 0) tilter.tilt(scatterers, i);
  });
}

}  // namespace insonify
