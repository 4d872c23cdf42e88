// SPDX-License-Identifier: BSD-3-Clause
#include "acoustics/trace_paths.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "acoustics/boundary_internal.hpp"
#include "core/error.hpp"
#include "core/units.hpp"

namespace insonify {
namespace {

using Eigen::Vector3d;

double amplitude_of(const Echoes& echoes, std::size_t i, const Medium& medium) {
  return std::abs(echoes.amplitude[i]) * std::exp(-medium.absorption.a0 * medium.sound_speed * echoes.delay[i]);
}

/// The loudest echo of each of `count` intervals of u among those that `in_group` takes; in the order of u.
template <typename InGroup>
std::vector<std::size_t> loudest(const Echoes& echoes, const Medium& medium, std::size_t count, InGroup in_group) {
  if (count < 1) fail(ErrorKind::argument, "SoundPaths: count = 0, must be at least 1");
  std::map<std::size_t, std::size_t> of_interval;
  for (std::size_t i = 0; i < echoes.size(); ++i) {
    if (!in_group(i)) continue;
    const double position = std::floor(0.5 * (echoes.u[i] + 1) * static_cast<double>(count));
    const auto interval = static_cast<std::size_t>(std::clamp(position, 0.0, static_cast<double>(count - 1)));
    const auto [held, is_new] = of_interval.emplace(interval, i);
    if (!is_new && amplitude_of(echoes, i, medium) > amplitude_of(echoes, held->second, medium)) held->second = i;
  }
  std::vector<std::size_t> found;
  for (const auto& [interval, i] : of_interval) found.push_back(i);
  return found;
}

void add_path(SoundPaths& paths, std::vector<Vector3d> points, double amplitude, int bounces) {
  paths.points.push_back(std::move(points));
  paths.level_db.push_back(static_cast<float>(pressure_level_db(amplitude)));
  paths.bounces.push_back(bounces);
}

/// Where the leg from `head` to the image of `position` in a plane meets it.
Vector3d bounce_of(const Vector3d& head, const Vector3d& position, const MirrorPlane& plane) {
  const Vector3d image = mirrored_in(plane, position), &normal = plane.normal();
  return head - plane.signedDistance(head) / (normal.dot(image) - normal.dot(head)) * (image - head);
}

}  // namespace

SoundPaths direct_paths(const Scatterers& scatterers, const Echoes& echoes, const Pose& world_from_head,
                        const Medium& medium, std::size_t count) {
  SoundPaths paths;
  const Vector3d head = world_from_head.translation();
  for (const std::size_t i : loudest(echoes, medium, count, [](std::size_t) { return true; })) {
    const Vector3d position =
        world_from_head * Vector3d(scatterers.range[i] * unit_vector({scatterers.azimuth[i], scatterers.elevation[i]}));
    add_path(paths, {head, position, head}, amplitude_of(echoes, i, medium), 0);
  }
  return paths;
}

SoundPaths multipath_paths(const Multipath& multipath, const SceneCloud& scene, const View& view, const Medium& medium,
                           std::size_t count) {
  const auto boundaries = static_cast<std::uint8_t>(multipath.planes.size());

  SoundPaths paths;
  const Vector3d head = view.world_from_head.translation();
  for (std::uint8_t out = 0; out <= boundaries; ++out)
    for (std::uint8_t back = 0; back <= boundaries; ++back) {
      const LegPair legs{out, back};
      const auto in_group = [&](std::size_t i) { return multipath.legs[i] == legs; };
      for (const std::size_t i : loudest(multipath.echoes, medium, count, in_group)) {
        const Vector3d position = scene.origin + scene.point[multipath.surfel[i]].cast<double>();
        std::vector<Vector3d> points = {head};
        if (out > 0) points.push_back(bounce_of(head, position, multipath.planes[out - 1]));
        points.push_back(position);
        if (back > 0) points.push_back(bounce_of(head, position, multipath.planes[back - 1]));
        points.push_back(head);
        add_path(paths, std::move(points), amplitude_of(multipath.echoes, i, medium), legs.bounces());
      }
    }
  return paths;
}

void append(SoundPaths& paths, const SoundPaths& more) {
  paths.points.insert(paths.points.end(), more.points.begin(), more.points.end());
  paths.level_db.insert(paths.level_db.end(), more.level_db.begin(), more.level_db.end());
  paths.bounces.insert(paths.bounces.end(), more.bounces.begin(), more.bounces.end());
}

}  // namespace insonify
