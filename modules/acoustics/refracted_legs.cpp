// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "acoustics/ray_families_internal.hpp"
#include "acoustics/refract_paths.hpp"
#include "acoustics/refracted_legs_internal.hpp"
#include "acoustics/shoot_ray.hpp"

namespace insonify {
namespace {

using Eigen::Vector3d;

/// The water's side of a level boundary and its image on the other side.
SoundSpeedProfile mirrored_at(const SoundSpeedProfile& profile, double depth, bool above) {
  SoundSpeedProfile half{{depth}, {sound_speed_at(profile, depth)}};  // from the boundary into the water
  const auto add = [&](std::size_t k) {
    if (above ? profile.depth[k] > depth : profile.depth[k] < depth)
      half.depth.push_back(profile.depth[k]), half.sound_speed.push_back(profile.sound_speed[k]);
  };
  const std::size_t n = profile.depth.size();
  for (std::size_t k = 0; k < n; ++k) add(above ? k : n - 1 - k);
  std::vector<std::pair<double, double>> both;
  for (std::size_t k = 0; k < half.depth.size(); ++k) {
    both.emplace_back(half.depth[k], half.sound_speed[k]);
    if (k > 0) both.emplace_back(2 * depth - half.depth[k], half.sound_speed[k]);
  }
  std::sort(both.begin(), both.end());
  SoundSpeedProfile whole;
  for (const auto& [z, c] : both) whole.depth.push_back(z), whole.sound_speed.push_back(c);
  return whole;
}

}  // namespace

RefractedLegs::RefractedLegs(const SoundSpeedProfile& profile, double head_depth, const Pose& world_from_head,
                             double absorption)
    : profile_(std::make_shared<const SoundSpeedProfile>(profile)),
      head_depth_(head_depth),
      absorption_(absorption),
      world_from_head_(world_from_head) {
  prepare({}, 1);
}

RefractedLegs RefractedLegs::mirrored(double distance, bool above) const {
  const double depth = above ? head_depth_ - distance : head_depth_ + distance;
  return {mirrored_at(*profile_, depth, above), head_depth_, world_from_head_, absorption_};
}

void RefractedLegs::prepare(std::span<const Vector3d> positions, int threads) {
  DepthBox box{HUGE_VAL, -HUGE_VAL, HUGE_VAL, -HUGE_VAL, positions.size()};
  for (const Vector3d& position : positions) {
    const Vector3d way = world_from_head_.linear() * position;
    const double depth = head_depth_ - way.z(), out = std::hypot(way.x(), way.y());
    box.min_depth = std::min(box.min_depth, depth), box.max_depth = std::max(box.max_depth, depth);
    box.min_horizontal = std::min(box.min_horizontal, out), box.max_horizontal = std::max(box.max_horizontal, out);
  }
  table_ = std::make_unique<RefractionTable>(*profile_, head_depth_, box, threads);
}

std::optional<RefractedLeg> RefractedLegs::to(const Vector3d& position) const {
  const Vector3d way = world_from_head_.linear() * position;
  const double out = std::hypot(way.x(), way.y()), straight = position.norm();
  const auto seen = table_->apparent(head_depth_ - way.z(), out);
  if (!seen || !(straight > 0)) return std::nullopt;
  RefractedLeg leg{seen->range / straight * position, position / straight, 1};
  leg.pressure = std::exp(0.5 * seen->gain - absorption_ * (straight - seen->range));  // (E167)
  if (out == 0) return leg;
  const Vector3d ahead(way.x() / out, way.y() / out, 0);
  const auto in_head = [&](double horizontal, double up) -> Vector3d {
    return world_from_head_.linear().transpose() * (horizontal * ahead + up * Vector3d::UnitZ());
  };
  leg.apparent = seen->range * in_head(seen->horizontal, seen->up);
  leg.arrival = in_head(std::cos(seen->arrival), std::sin(seen->arrival));
  return leg;
}

std::optional<RayPiece> RefractedLegs::between(const Vector3d& from, const Vector3d& to) const {
  const Vector3d way = world_from_head_.linear() * (to - from);
  const double out = std::hypot(way.x(), way.y()), straight = way.norm();
  const double depth = head_depth_ - world_from_head_.linear().row(2).dot(from), depth_there = depth - way.z();
  const auto ray = eigenray_between(*profile_, depth, depth_there, out);
  if (!ray || !(straight > 0)) return std::nullopt;
  const RayTube tube = shoot_tube(*profile_, depth, ray->elevation, ray->travel_time);
  const double spreading = tube.spreading(sound_speed_at(*profile_, depth), sound_speed_at(*profile_, depth_there));
  Vector3d ahead = Vector3d::Zero();
  if (out > 0) ahead = {way.x() / out, way.y() / out, 0};
  const auto in_head = [&](double elevation) -> Vector3d {
    return world_from_head_.linear().transpose() *
           (std::cos(elevation) * ahead + std::sin(elevation) * Vector3d::UnitZ());
  };
  RayPiece piece{in_head(ray->elevation), in_head(tube.end.elevation), 0, 1};
  piece.apparent = sound_speed_at(*profile_, head_depth_) * ray->travel_time;
  piece.pressure = std::sqrt(std::min(straight * straight * spreading, most_focusing)) *
                   std::exp(-absorption_ * (straight - piece.apparent));  // (E167)
  return piece;
}

double RefractedLegs::relative_speed(const Vector3d& position) const {
  const double depth = head_depth_ - world_from_head_.linear().row(2).dot(position);
  return sound_speed_at(*profile_, depth) / sound_speed_at(*profile_, head_depth_);
}

double RefractedLegs::grazing_at(double depth, const Vector3d& apparent) const {
  const double up = world_from_head_.linear().row(2).dot(apparent.normalized());
  const double cosine = std::sqrt(std::max(0.0, (1 - up) * (1 + up))) * sound_speed_at(*profile_, depth) /
                        sound_speed_at(*profile_, head_depth_);  // Snell's law
  return std::acos(std::min(1.0, cosine));
}

BoundaryTilt tilt_of(const Boundary& boundary) {
  constexpr double one_degree = 0.01745;
  const double up = std::abs(boundary.plane.normal().z());
  if (up < one_degree) return BoundaryTilt::upright;
  return up > 1 - 0.5 * one_degree * one_degree ? BoundaryTilt::level : BoundaryTilt::tilted;
}

double depth_of(const Boundary& boundary, double head_depth) {
  return head_depth + (boundary.plane.normal().z() < 0 ? -1 : 1) * boundary.head_distance;
}

}  // namespace insonify
