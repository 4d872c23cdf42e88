// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <vector>

#include "acoustics/double_echoes.hpp"
#include "acoustics/pair_legs_internal.hpp"

namespace insonify {

using Eigen::Vector3d;

PairLegs::PairLegs(const SceneCloud& scene, std::span<const std::uint32_t> seen, const View& view,
                   const Transmission& sent, const Environment* through)
    : options_(sent.echo_options),
      head_(view.world_from_head.translation() - scene.origin),
      to_head_(view.world_from_head.linear().transpose()) {
  if (!through || !through->profile) return;
  rays_.emplace(*through->profile, through->water.depth, view.world_from_head, sent.medium.absorption.a0);
  std::vector<Vector3d> positions;
  positions.reserve(seen.size());
  for (const std::uint32_t i : seen) positions.emplace_back(to_head_ * (scene.point[i].cast<double>() - head_));
  rays_->prepare(positions, sent.echo_options.threads);
}

std::optional<HeadLeg> PairLegs::leg_to(const Vector3d& position) const {
  HeadLeg leg;
  const Vector3d from_head = position - head_;
  leg.range = from_head.norm();
  leg.to_head = -from_head / leg.range;
  Vector3d direction = to_head_ * from_head / leg.range;
  double pressure = 1;
  if (rays_) {
    const auto refracted = rays_->to(to_head_ * from_head);
    if (!refracted) return std::nullopt;
    leg.range = refracted->apparent.norm();
    leg.to_head = to_head_.transpose() * -refracted->arrival;
    direction = refracted->apparent / leg.range, pressure = refracted->pressure;
  }
  leg.u = direction.y(), leg.v = direction.z();
  leg.gain = pressure * one_way_pattern(options_, leg.v);
  leg.sent = leg.gain * transmit_pattern(options_, std::atan2(direction.y(), direction.x()));
  return leg;
}

std::optional<PairPath> PairLegs::by(const PairEnd& first, const PairEnd& last, const Vector3d& direction,
                                     double distance) const {
  const auto out = leg_to(first.position), back = leg_to(last.position);
  if (!out || !back) return std::nullopt;
  PairPath way{*out, *back, first.straight, last.straight, 0, 1};
  way.path = way.out.range + distance + way.back.range;
  if (!rays_) return way;
  const Vector3d from = to_head_ * (first.position - head_);
  const auto between = rays_->between(from, from + distance * (to_head_ * direction));
  if (!between) return std::nullopt;
  const Vector3d leaves = to_head_.transpose() * between->leaves, arrives = to_head_.transpose() * between->arrives;
  way.path += between->apparent - distance;
  way.pressure = between->pressure;  // (E178)
  way.here = {first.normal.dot(way.out.to_head), first.normal.dot(leaves), way.out.to_head.dot(leaves)};
  way.there = {last.normal.dot(way.back.to_head), -last.normal.dot(arrives), -arrives.dot(way.back.to_head)};
  if (!(std::min({way.here.cos_in, way.here.cos_out, way.there.cos_in, way.there.cos_out}) > 0)) way.pressure = 0;
  return way;
}

std::vector<RefractedPair> refracted_pairs(std::span<const SurfacePoint> positions, const Environment& environment,
                                           const Pose& world_from_head, const Medium& medium) {
  std::vector<RefractedPair> pairs;
  if (!environment.profile) return pairs;
  const RefractedLegs rays(*environment.profile, environment.water.depth, world_from_head, medium.absorption.a0);
  std::vector<std::optional<RefractedLeg>> legs;
  for (const SurfacePoint& position : positions) legs.push_back(rays.to(position.at));
  const auto add = [&](std::size_t i, std::size_t j, const RayPiece& between, double distance) {
    const Vector3d from_head = -legs[i]->arrival, to_head = -legs[j]->arrival;
    const Vector3d &normal = positions[i].normal, &normal_there = positions[j].normal;
    const double apparent = legs[i]->apparent.norm() + between.apparent + legs[j]->apparent.norm();
    const double straight = positions[i].at.norm() + distance + positions[j].at.norm();
    const double spread =
        positions[i].at.norm() * positions[j].at.norm() / legs[i]->apparent.norm() / legs[j]->apparent.norm();
    pairs.push_back({i,
                     j,
                     {normal.dot(from_head), normal.dot(between.leaves), from_head.dot(between.leaves)},
                     {-normal_there.dot(between.arrives), normal_there.dot(to_head), -between.arrives.dot(to_head)},
                     apparent - straight,
                     legs[j]->apparent.normalized().y() - positions[j].at.normalized().y(),
                     legs[i]->pressure * legs[j]->pressure * between.pressure * spread});
  };
  for (std::size_t i = 0; i < positions.size(); ++i)
    for (std::size_t j = 0; j < positions.size(); ++j) {
      const Vector3d way = positions[j].at - positions[i].at;
      if (i == j || !legs[i] || !legs[j] || !(positions[i].normal.dot(way) > 0) || !(positions[j].normal.dot(way) < 0))
        continue;
      if (const auto between = rays.between(positions[i].at, positions[j].at)) add(i, j, *between, way.norm());
    }
  return pairs;
}

}  // namespace insonify
