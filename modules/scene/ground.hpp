// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <unordered_map>
#include <vector>

#include <Eigen/Core>

#include "scene/placed_part.hpp"

namespace insonify {

/// The rest of a part of a scene on the ground. `none`: it stays where it is. `ground`: it is lowered until it
/// touches. `bed`: it is tilted with the bed under its footprint, then lowered.
enum class PartRest { none, ground, bed };

/// Height and normal of the ground at one position.
struct GroundPoint {
  double height = 0;                                  ///< world z [m]
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< unit vector, up
};

/// The ground on which parts of a scene rest: at each (x, y) the topmost surface of all parts that were added. Several
/// threads may query it at once. Copies share the parts.
class Ground {
 public:
  /// Adds the surfels of a part. A part that coincides with an earlier one costs no more time in at(). Throws
  /// Error(argument) for a part without surfels or with a pose that is not finite.
  void add(const PlacedPart& part);
  /// Returns true if there is no surfel.
  bool empty() const { return sheets_.empty(); }
  /// Returns the mean spacing of the surfels in the part with the widest spacing [m]; 0 if there is no surfel.
  double spacing() const { return spacing_; }
  /// Returns the box of the captured parts [m, world]; min > max if there are none.
  const Bounds& captured_box() const { return captured_box_; }
  /// Returns the topmost surface at `position` [m, world]. The surface is the mean of tangent planes, weighted by
  /// distance: those of the surfels of the topmost sheet within 1.25 spacings and twice their noise. A tangent plane
  /// counts no farther than that along itself, so that a cliff does not rise above itself. Surfels that lie more than a
  /// spacing and four times their noise below belong to another sheet. Returns nothing where no surfel lies within
  /// three spacings, i.e. in a hole of the scan.
  std::optional<GroundPoint> at(const Eigen::Vector2d& position) const;

 private:
  struct Sheet;
  std::vector<std::shared_ptr<const Sheet>> sheets_;
  /// Numbers of the sheets that may have ground in a square, by level, x and y of the square in units of its side of
  /// 2^level m. A sheet is listed at one level, at which it reaches into two squares along x and along y at most.
  std::map<std::array<double, 3>, std::vector<std::size_t>> squares_;
  std::set<int> levels_;
  std::unordered_map<std::size_t, std::vector<std::size_t>> by_hash_;  // numbers of sheets
  double spacing_ = 0;
  Bounds captured_box_;
};

/// Returns the part placed on the ground. A part that rests on the bed is tilted first: its z axis becomes the normal
/// of the plane fitted to the ground under its footprint. Then the part is shifted along z until its first surfel
/// touches, and lowered by `bury` [m]. Surfels below the ground are left out of PlacedPart::surfels; if all are below,
/// nothing is returned. A part with rest `none` is returned unchanged. Throws Error(content) that names the part and
/// the position where the ground has a hole: beneath the origin of its axes, or beneath more than half of its
/// footprint.
std::optional<PlacedPart> place_on_ground(PlacedPart part, const Ground& ground, PartRest rest, double bury = 0);

/// Returns the vertical distance from the lowest to the highest surfel of a part [m], at its pose.
double height_of(const PlacedPart& part);

/// Returns the largest horizontal distance of a part's surfels from the origin of the part's axes [m], at its pose.
double footprint_radius(const PlacedPart& part);

}  // namespace insonify
