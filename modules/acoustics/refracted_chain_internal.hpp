// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <optional>
#include <span>
#include <vector>

#include "acoustics/refracted_legs_internal.hpp"

// Private to acoustics: rays from a head through a profile by planes of any tilt. Head axes [m].
namespace insonify {

/// A ray from the head by planes, one after the other, to a position.
struct RefractedChain {
  Eigen::Vector3d sent;  ///< unit vector along the ray where it leaves the head
  RefractedLeg leg;  ///< all pieces as one leg to the position: `apparent` along `sent`, `arrival` of the last piece
  std::vector<Eigen::Vector3d> bounces, meets;  ///< where it meets the planes, and unit vectors along it just before

  /// Returns the grazing angle [rad] on the k-th plane.
  double grazing_on(const Boundary& plane, std::size_t k) const;
};

/// Returns the ray by `planes` near a straight way that meets them at `bounces`: the way of stationary travel time (E177).
/// Its pressure is that of pieces of ray tubes (E167) joined by stationary phase over the planes, at most most_focusing in
/// intensity. None in a shadow zone, if the search does not end, or if two bounces are within a millimetre of each other.
std::optional<RefractedChain> refracted_chain(const RefractedLegs& rays, std::span<const Boundary* const> planes,
                                              std::vector<Eigen::Vector3d> bounces, const Eigen::Vector3d& position);

}  // namespace insonify
