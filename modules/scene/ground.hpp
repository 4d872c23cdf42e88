// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <memory>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "scene/placed_part.hpp"

namespace insonify {

/// How a part of a scene comes to stand on what is beneath: not at all; lowered until it touches; tilted with the bed
/// under its footprint, then lowered.
enum class PartRest { none, ground, bed };

/// A place of the ground.
struct GroundPlace {
  double height = 0;                                  ///< world z [m]
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< unit vector, up
};

/// Heights of what parts of a scene rest on: at each (x, y) the topmost surface of all parts that were added. Queries
/// are const and may run concurrently. Copies share the parts.
class Ground {
 public:
  /// Adds the surfels of a part. Throws Error(argument) for a part without surfels or with a pose that is not finite.
  void add(const PlacedPart& part);
  /// True if there is no surfel.
  bool empty() const { return sheets_.empty(); }
  /// Returns the mean spacing of its surfels [m], of the part where they are widest; 0 if it is empty.
  double spacing() const;
  /// Returns the box of the captured parts [m, world]; min > max if there are none.
  const Bounds& captured_box() const { return captured_box_; }
  /// Returns the topmost surface at a place [m, world]: the mean of the tangent planes of the surfels of the topmost
  /// sheet within 1.25 spacings and twice their noise, weighted by distance; surfels that lie more than a spacing and four times their noise
  /// below are another sheet. Nothing where no surfel lies within three spacings: a hole of the scan.
  std::optional<GroundPlace> at(const Eigen::Vector2d& place) const;

 private:
  struct Sheet;
  std::vector<std::shared_ptr<const Sheet>> sheets_;
  Bounds captured_box_;
};

/// Places a part on the ground: tilted if it rests on the bed, so that its z axis is the normal of the plane fitted to the
/// ground under its footprint; shifted along z until the first of its surfels touches; then `bury` [m] lower. Its
/// surfels below the ground are left out of PlacedPart::surfels; nothing is returned if that is all of them. Rest of
/// `none` changes nothing. Throws Error(content) that names the part and the place where the ground is a hole: beneath
/// the origin of its axes, or beneath more than half of its footprint.
std::optional<PlacedPart> place_on_ground(PlacedPart part, const Ground& ground, PartRest rest, double bury = 0);

/// Returns how far a part reaches from the lowest to the highest of its surfels [m], at its pose.
double height_of(const PlacedPart& part);

/// Returns the largest horizontal distance of its surfels from the origin of its axes [m], at its pose.
double footprint_radius(const PlacedPart& part);

}  // namespace insonify
