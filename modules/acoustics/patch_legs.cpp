// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "acoustics/patch_legs_internal.hpp"
#include "acoustics/refracted_chain_internal.hpp"
#include "core/units.hpp"

namespace insonify {
namespace {

using Eigen::Vector3d;
using complex = std::complex<double>;

Vector3d position_of_patch(const Scatterers& patches, std::size_t i) {
  return patches.range[i] * unit_vector({patches.azimuth[i], patches.elevation[i]});
}

/// Grazing angle of a straight leg to an image at this range.
double grazing_of(const Boundary& boundary, const Vector3d& image, double range) {
  return std::asin(std::min(1.0, std::abs(boundary.normal.dot(image)) / range));
}

}  // namespace

PatchLegs::PatchLegs(const SceneCloud& scene, const std::vector<Boundary>& boundaries, const View& view,
                     const Transmission& sent, const Environment* through)
    : scene_(scene),
      boundaries_(boundaries),
      echo_options_(sent.echo_options),
      to_head_(view.world_from_head.linear().transpose()) {
  if (!through || !through->profile) return;
  const auto add_rays = [&] {
    return &*rays_.emplace_back(std::in_place, *through->profile, through->water.depth, view.world_from_head,
                                sent.medium.absorption.a0);
  };
  add_rays();
  for (const Boundary& boundary : boundaries) {
    const BoundaryTilt tilt = tilt_of(boundary);
    if (tilt == BoundaryTilt::tilted) {
      rays_.emplace_back();
      continue;
    }
    RefractedLegs* rays = add_rays();
    if (tilt == BoundaryTilt::level) *rays = rays->mirrored(boundary.head_distance, boundary.plane.normal().z() < 0);
  }
}

void PatchLegs::prepare(const Scatterers& patches) {
  std::vector<Vector3d> positions(patches.size());
  for (std::size_t k = 0; k < rays_.size(); ++k) {
    if (!rays_[k]) continue;
    for (std::size_t i = 0; i < positions.size(); ++i) {
      const Vector3d position = position_of_patch(patches, i);
      positions[i] = k == 0 ? position : boundaries_[k - 1].mirrored(position);
    }
    rays_[k]->prepare(positions, echo_options_.threads);
  }
}

std::size_t PatchLegs::find(const Scatterers& patches, std::size_t i, LegSet open, bool cosines,
                            std::vector<Leg>& legs) const {
  const std::uint32_t surfel = patches.surfel[i];
  const Vector3d position = position_of_patch(patches, i);
  const Vector3d normal = to_head_ * scene_.normal[surfel].cast<double>();
  legs.clear();
  std::size_t unreached = 0;
  if (open & direct_leg) {
    Leg& leg = legs.emplace_back();
    const bool reached = set_leg_to(surfel, position, normal, 0, leg);
    if (cosines && rays_.empty()) leg.cosine = patches.cos_incidence[i];
    unreached += !reached;
    if (!(reached && leg.cosine > 0)) legs.pop_back();
  }
  for (std::size_t b = 0; b < boundaries_.size(); ++b) {
    const Boundary& boundary = boundaries_[b];
    if (!(open & leg_by(b)) || boundary.distance(position) <= 0) continue;
    Leg& leg = legs.emplace_back();
    const bool reached =
        set_leg_to(surfel, boundary.mirrored(position), boundary.mirrored_direction(normal), b + 1, leg);
    leg.towards = boundary.mirrored_direction(leg.towards);
    unreached += !reached;
    if (!(reached && leg.cosine > 0)) legs.pop_back();
  }
  return unreached;
}

/// The way by a tilted boundary to the image of a position; its arrival is that of the image.
std::optional<PatchLegs::Path> PatchLegs::path_by_tilted_mirror_to(const Vector3d& image,
                                                                   const Boundary& boundary) const {
  const double crossing = boundary.head_distance / (boundary.head_distance - boundary.distance(image));
  const Vector3d position = boundary.mirrored(image);
  const Boundary* const plane = &boundary;
  const auto chain = refracted_chain(*rays_[0], {&plane, 1}, {crossing * image}, position);
  if (!chain) return std::nullopt;
  Path way{chain->leg};
  way.leg.arrival = boundary.mirrored_direction(way.leg.arrival);
  // Edges are those of the straight line that crosses the plane at the same position.
  const Vector3d& bounce = chain->bounces[0];
  const Vector3d end = (1 + (position - bounce).norm() / bounce.norm()) * bounce;
  way.reflection = boundary.reflection(chain->grazing_on(boundary, 0)) * boundary.edges(end);
  return way;
}

/// The leg through the profile to a position, by boundary `by` to its image; none in a shadow zone.
std::optional<PatchLegs::Path> PatchLegs::refracted_path_to(const Vector3d& position, std::size_t by) const {
  if (!rays_[by]) return path_by_tilted_mirror_to(position, boundaries_[by - 1]);
  const auto refracted = rays_[by]->to(position);
  if (!refracted) return std::nullopt;
  Path way{*refracted};
  if (by == 0) return way;
  const Boundary& boundary = boundaries_[by - 1];
  const double grazing = tilt_of(boundary) == BoundaryTilt::level
                             ? rays_[by]->grazing_at(depth_of(boundary, rays_[by]->head_depth()), way.leg.apparent)
                             : grazing_of(boundary, position, position.norm());
  way.reflection = boundary.reflection(grazing) * boundary.edges(position);
  return way;
}

void PatchLegs::set_leg(const RefractedLeg& way, double range, std::uint32_t surfel, const Vector3d& normal,
                        Leg& leg) const {
  leg.range = range;
  leg.u = way.apparent.y() / range;
  leg.v = way.apparent.z() / range;
  leg.towards = -way.arrival;
  const double cosine = -normal.dot(way.arrival);
  leg.cosine = std::min(1.0, scene_.oriented(surfel) ? cosine : std::abs(cosine));
}

void PatchLegs::set_gains(const RefractedLeg& way, complex reflection, std::size_t by, Leg& leg) const {
  leg.gain = way.pressure * one_way_pattern(echo_options_, leg.v);
  if (by > 0) leg.gain *= reflection;
  leg.sent = leg.gain * transmit_pattern(echo_options_, std::atan2(way.apparent.y(), way.apparent.x()));
  leg.by = static_cast<std::uint8_t>(by);
}

bool PatchLegs::set_leg_to(std::uint32_t surfel, const Vector3d& position, const Vector3d& normal, std::size_t by,
                           Leg& leg) const {
  if (rays_.empty()) {
    const double range = position.norm();
    const RefractedLeg straight{position, position / range, 1};
    set_leg(straight, range, surfel, normal, leg);
    if (by > 0 && !(leg.cosine > 0)) return true;  // a back, whose gains nobody asks for
    complex reflection = 1;
    if (by > 0) {
      const Boundary& boundary = boundaries_[by - 1];
      reflection = boundary.reflection(grazing_of(boundary, position, range)) * boundary.edges(position);
    }
    set_gains(straight, reflection, by, leg);
    return true;
  }
  const auto found = refracted_path_to(position, by);
  if (!found) return false;
  set_leg(found->leg, found->leg.apparent.norm(), surfel, normal, leg);
  set_gains(found->leg, found->reflection, by, leg);
  return true;
}

}  // namespace insonify
