// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "acoustics/find_legs_internal.hpp"
#include "core/units.hpp"
#include "sampling/seen_surfels.hpp"
#include "sonar/elevation_pattern.hpp"

namespace insonify {
namespace {

constexpr double pattern_floor_db = -80;  // of one way

/// The surfels that a leg by a boundary can meet: the scene on the water's side, and behind it its image.
struct MirroredScene {
  SceneCloud cloud;                   // real surfels, then images
  std::vector<std::uint32_t> surfel;  // of each image, its index in the scene
  std::vector<std::uint8_t> queried;  // 1 for the images
};

void append(const SceneCloud& from, std::size_t i, SceneCloud& to) {
  to.point.push_back(from.point[i]);
  to.normal.push_back(from.normal[i]);
  to.area.push_back(from.area[i]);
  to.material.push_back(from.material[i]);
  to.id.push_back(from.id[i]);
  if (!from.noise.empty()) to.noise.push_back(from.noise[i]);
  if (!from.unevenness.empty()) to.unevenness.push_back(from.unevenness[i]);
  if (!from.facet.empty()) to.facet.push_back(Facet(from.facet[i]));
  if (!from.part.empty()) to.part.push_back(from.part[i]);
}

bool out_of_water(const std::vector<Boundary>& boundaries, const Eigen::Vector3d& world) {
  return std::any_of(boundaries.begin(), boundaries.end(),
                     [&](const Boundary& b) { return b.ends_water && b.plane.signedDistance(world) < -b.thickness; });
}

// Returns true if neither a surfel nor its image can come within the gate: both stand as far from the head across.
bool out_of_reach(const SceneCloud& scene, std::size_t i, const View& view, const Eigen::Vector3d& normal) {
  const Eigen::Vector3d from_head = scene.origin - view.world_from_head.translation() + scene.point[i].cast<double>();
  const double disc = view.sampling.footprint * std::sqrt(static_cast<double>(scene.area[i]));
  return (from_head - normal.dot(from_head) * normal).norm() > (view.gate.max_range + disc) * (1 + 1e-6);
}

MirroredScene mirrored_scene(const SceneCloud& scene, const View& view, const Boundary& boundary,
                             const std::vector<Boundary>& boundaries) {
  MirroredScene all;
  SceneCloud& cloud = all.cloud;
  cloud.origin = scene.origin;
  cloud.materials = scene.materials;
  cloud.normals_oriented = scene.normals_oriented;
  cloud.parts = scene.parts;
  for (ScenePart& part : cloud.parts) part.own.reset();  // images stand elsewhere than their parts
  const Eigen::Vector3d& normal = boundary.plane.normal();
  const MirrorPlane plane(normal, boundary.plane.offset() + normal.dot(scene.origin));  // from the origin
  for (std::size_t i = 0; i < scene.size(); ++i) {
    const Eigen::Vector3d point = scene.point[i].cast<double>();
    const double into_water = plane.signedDistance(point);
    if (into_water <= 0 || boundary.holds(into_water, normal.dot(scene.normal[i].cast<double>()))) continue;
    if (out_of_water(boundaries, point + scene.origin) || out_of_reach(scene, i, view, normal)) continue;
    append(scene, i, cloud);
    all.surfel.push_back(static_cast<std::uint32_t>(i));
  }
  const std::size_t real = cloud.size();
  const auto mirror = [&](Eigen::Vector3f& point) { point = mirrored_in(plane, point.cast<double>()).cast<float>(); };
  for (std::size_t k = 0; k < real; ++k) {
    append(cloud, k, cloud);
    mirror(cloud.point.back());
    const Eigen::Vector3d side = cloud.normal[k].cast<double>();
    cloud.normal.back() = (side - 2 * normal.dot(side) * normal).cast<float>();
    if (!cloud.facet.empty())
      for (Eigen::Vector3f& corner : cloud.facet.back()) mirror(corner);
  }
  all.queried.assign(real, 0);
  all.queried.resize(2 * real, 1);
  return all;
}

void find_bounces(const SceneCloud& scene, const View& view, const std::vector<Boundary>& boundaries, std::size_t b,
                  FoundLegs& found) {
  if (boundaries[b].strongest_bounce(view.gate.max_range) < amplitude_from_db(pattern_floor_db)) return;
  const MirroredScene all = mirrored_scene(scene, view, boundaries[b], boundaries);
  const auto visibility =
      find_visibility(all.cloud, view.world_from_head, view.fan, view.gate, all.queried, view.sampling);
  const std::size_t real = all.surfel.size();
  for (std::size_t k = 0; k < real; ++k) {
    if (visibility[real + k] == Visibility::seen) found.legs[all.surfel[k]] |= leg_by(b);
    found.hidden += visibility[real + k] == Visibility::hidden;
  }
}

}  // namespace

double extent_of_legs(const EchoOptions& echo_options) {
  if (!(echo_options.elevation_width > 0)) return pi / 2;
  return elevation_half_extent(echo_options.elevation_shape, echo_options.elevation_width, 2 * pattern_floor_db);
}

FoundLegs find_legs(const SceneCloud& scene, const View& view, const std::vector<Boundary>& boundaries,
                    const std::vector<std::uint8_t>& seen_directly) {
  FoundLegs found;
  found.legs.assign(scene.size(), 0);
  for (std::size_t b = 0; b < boundaries.size(); ++b) find_bounces(scene, view, boundaries, b, found);

  // Directly the head may have looked at fewer elevations than count here.
  std::vector<std::uint8_t> queried(scene.size());
  for (std::size_t i = 0; i < scene.size(); ++i) queried[i] = found.legs[i] && !seen_directly[i];
  if (std::any_of(queried.begin(), queried.end(), [](std::uint8_t a) { return a; })) {
    const auto visibility = find_visibility(scene, view.world_from_head, view.fan, view.gate, queried, view.sampling);
    for (std::size_t i = 0; i < scene.size(); ++i)
      if (visibility[i] == Visibility::seen) found.legs[i] |= direct_leg;
  }
  for (std::size_t i = 0; i < scene.size(); ++i)
    if (seen_directly[i]) found.legs[i] |= direct_leg;
  return found;
}

}  // namespace insonify
