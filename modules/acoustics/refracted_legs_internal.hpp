// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <complex>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "acoustics/boundary_internal.hpp"
#include "acoustics/refraction_table_internal.hpp"
#include "acoustics/sound_speed_profile.hpp"
#include "core/pose.hpp"

// Private to acoustics: legs of sound through a profile, to places and to their images in boundaries. Head axes [m].
namespace insonify {

/// Where a leg seems to come from, how it arrives, and what it makes of spherical spreading over the apparent range.
struct RefractedLeg {
  Eigen::Vector3d apparent;  ///< place at the apparent range, in the direction at the head
  Eigen::Vector3d arrival;   ///< unit vector along the ray at the position
  double pressure = 1;       ///< factor on 1 / apparent range: tube (E167), and absorption of the true distance
};

/// A ray between two positions, neither of them the head.
struct RayPiece {
  Eigen::Vector3d leaves, arrives;  ///< unit vectors along the ray at its ends
  double apparent = 0;              ///< travel time at the sound speed of the head [m]
  double pressure =
      1;  ///< factor on 1 / straight distance: tube (E167), and absorption of straight less apparent distance
};

/// The legs from a head through a profile, and through its image in a level boundary.
class RefractedLegs {
 public:
  /// `head_depth`: depth of the head's origin [m]; `absorption`: of amplitude [Np/m].
  RefractedLegs(const SoundSpeedProfile& profile, double head_depth, const Pose& world_from_head, double absorption);

  /// Returns legs through water whose profile is mirrored in a level boundary at `distance` [m] above or below the
  /// head.
  RefractedLegs mirrored(double distance, bool above) const;

  /// Builds a table for legs to many positions; without it each ray is solved.
  void prepare(std::span<const Eigen::Vector3d> positions, int threads);

  /// Returns the leg to a position; none in a shadow zone.
  std::optional<RefractedLeg> to(const Eigen::Vector3d& position) const;

  /// Returns the ray between two positions by an eigenray of its own; none in a shadow zone, or if they are one position.
  std::optional<RayPiece> between(const Eigen::Vector3d& from, const Eigen::Vector3d& to) const;

  /// Returns the sound speed at a position over that at the head.
  double relative_speed(const Eigen::Vector3d& position) const;

  /// Grazing angle [rad] on a level boundary at this depth of the ray that leaves the head towards `apparent`.
  double grazing_at(double depth, const Eigen::Vector3d& apparent) const;
  double head_depth() const { return head_depth_; }

 private:
  std::shared_ptr<const SoundSpeedProfile> profile_;  // shared, since the table refers to it when legs are moved
  double head_depth_, absorption_;
  Pose world_from_head_;
  std::unique_ptr<RefractionTable> table_;
};

/// How legs by a boundary run through a profile.
enum class BoundaryTilt { upright, level, tilted };
/// Upright and level within one degree.
BoundaryTilt tilt_of(const Boundary& boundary);
/// Depth [m] of a level boundary under or over a head.
double depth_of(const Boundary& boundary, double head_depth);

}  // namespace insonify
