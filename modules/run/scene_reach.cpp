// SPDX-License-Identifier: BSD-3-Clause
#include "run/scene_reach.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "core/units.hpp"

namespace insonify {
namespace {

using Eigen::Vector3d;

struct NearestSurfel {
  std::size_t surfel = 0;
  Vector3d to_head = Vector3d::Zero();  ///< [m]
};

std::optional<NearestSurfel> nearest_surfel(const SceneCloud& cloud, const Vector3d& head) {
  if (cloud.size() == 0) return {};
  const Eigen::Vector3f at = (head - cloud.origin).cast<float>();
  const auto nearest = std::min_element(cloud.point.begin(), cloud.point.end(), [&](const auto& a, const auto& b) {
    return (a - at).squaredNorm() < (b - at).squaredNorm();
  });
  const auto surfel = static_cast<std::size_t>(nearest - cloud.point.begin());
  return NearestSurfel{surfel, head - cloud.origin - nearest->cast<double>()};
}

/// A head within the disc of a surfel, or straight behind the nearest one; beside an edge of the scan it is neither.
std::string buried_note(const SceneCloud& cloud, const Vector3d& head) {
  const auto nearest = nearest_surfel(cloud, head);
  if (!nearest) return {};
  const double distance = nearest->to_head.norm(), radius = std::sqrt(cloud.area[nearest->surfel] / pi);
  if (distance < radius)
    return fmt::format(
        "the head is within the surface of the scene, {:.2g} m from the middle of a surfel of {:.2g} m radius; move "
        "the head away by --pose",
        distance, radius);
  constexpr double straight = 0.7;  // cosine
  const double before = nearest->to_head.dot(cloud.normal[nearest->surfel].cast<double>());
  if (!cloud.normals_oriented || before > -straight * distance) return {};
  return fmt::format(
      "the head is {:.3g} m behind the nearest surface and hears the back of the scene; move the head by --pose to the "
      "side to which the normals point, or orient the normals by --viewpoint",
      distance);
}

}  // namespace

double reach_of(const Bounds& box, const Vector3d& head, const Environment& environment) {
  double reach = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const Vector3d at((corner & 1 ? box.max : box.min).x(), (corner & 2 ? box.max : box.min).y(),
                      (corner & 4 ? box.max : box.min).z());
    if (box.min.x() > box.max.x()) return 0;
    const auto by_way_of = [&](double height) { return Vector3d(at.x(), at.y(), 2 * height - at.z()); };
    reach = std::max(reach, (at - head).norm());
    if (environment.surface) reach = std::max(reach, (by_way_of(environment.surface->height) - head).norm());
    if (environment.bottom) reach = std::max(reach, (by_way_of(environment.bottom->height) - head).norm());
  }
  return reach;
}

double height_over(const Bounds& box) {
  const double z = box.max.z() + 0.1 * (box.max - box.min).head<2>().maxCoeff();
  return box.max.z() <= 0 && z > 0 ? box.max.z() : z;
}

double end_of_range(double reach) {
  constexpr double margin = 1.01;  // a cell beyond the last surfel
  const double step = std::pow(10, std::floor(std::log10(margin * reach)) - 1);
  return std::ceil(margin * reach / step - 1e-9) * step;
}

std::string range_text(double min, double max) { return fmt::format("{:g}:{:g}", min, max); }

void end_range_with_scene(PingSetup& setup, const Bounds& box, const Pose& pose) {
  if (!setup.range_is_own) return;
  const double reach = reach_of(box, pose.translation(), setup.environment);
  if (!(reach > setup.spec.min_range)) return;
  setup.spec.max_range = std::min(setup.spec.max_range, end_of_range(reach));
  setup.head = make_head(setup.spec, slowest_sound(setup.environment));
}

std::string far_range_note(const PingSetup& setup, double reach) {
  const RangeGate& gate = setup.head.gate;
  constexpr double far = 2;
  if (!mirrors_of(setup.environment).empty()) return {};  // echoes by way of walls fill any range
  if (setup.environment.volume_scattering_db || !(reach > gate.min_range) || gate.max_range < far * end_of_range(reach))
    return {};
  const double end = end_of_range(reach), bytes = 8.0 * static_cast<double>(gate.bins() * setup.head.fan.beams());
  return fmt::format(
      "the range ends at {:g} m, but the scene reaches only to {:.3g} m from the head: {:.3g} MB of the {:.3g} MB of a "
      "ping stay empty; range {} holds the whole scene",
      gate.max_range, reach, 1e-6 * bytes * (gate.max_range - end) / (gate.max_range - gate.min_range), 1e-6 * bytes,
      range_text(gate.min_range, end));
}

std::string shallow_profile_note(const PingSetup& setup, const Bounds& box, const Vector3d& head) {
  constexpr double least_missing = 0.5, part_missing = 0.1;  // [m], of the depth
  const auto surface = surface_height(setup.environment);
  if (!setup.environment.profile || !surface || box.min.z() > box.max.z()) return {};
  const double deepest = *surface - std::max(box.min.z(), head.z() - setup.head.gate.max_range);
  const double end = setup.environment.profile->depth.back();
  if (!(deepest - end > std::max(least_missing, part_missing * deepest))) return {};
  return fmt::format(
      "the sound-speed profile ends at a depth of {:.3g} m, but the scene is heard down to {:.3g} m: its last sound "
      "speed is taken for all below; give a profile that reaches the bed",
      end, deepest);
}

std::vector<std::string> fit_notes(const SceneCloud& cloud, const Bounds& box, const PingSetup& setup) {
  const Vector3d head = setup.event.world_from_head.translation();
  std::vector<std::string> notes;
  for (const std::string& note : {far_range_note(setup, reach_of(box, head, setup.environment)),
                                  shallow_profile_note(setup, box, head), buried_note(cloud, head)})
    if (!note.empty()) notes.push_back(note);
  return notes;
}

std::string pose_text(const Vector3d& position, double yaw, double pitch) {
  const auto rounded = [](double value, double step) { return std::round(value / step) * step + 0.0; };
  std::string text;
  for (const double metres : position) text += fmt::format("{:.10g},", rounded(metres, 1e-3));
  return text + fmt::format("{:.6g},{:.6g},0", rounded(degrees(yaw), 0.01), rounded(degrees(pitch), 0.01));
}

}  // namespace insonify
