// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <complex>
#include <cstdint>
#include <optional>
#include <span>

#include "acoustics/refracted_legs_internal.hpp"
#include "acoustics/surface_scattering.hpp"

// Private to acoustics: legs of echoes by way of two positions of a scene, straight or through a profile. World axes,
// relative to the scene's origin [m].
namespace insonify {

/// The leg between the head and a position on a surface.
struct HeadLeg {
  Eigen::Vector3d to_head;          ///< unit vector along it at the position
  double range;                     ///< [m], through a profile the apparent one
  double u, v;                      ///< direction cosines of the position, through a profile of the ray to it
  std::complex<double> gain, sent;  ///< one-way pattern; with the transmitter's in azimuth
};

/// The way from the head by two positions and back.
struct PairPath {
  HeadLeg out, back;
  PathAngles here, there;  ///< angles at both: in from the head, out to the other position
  double path = 0;         ///< length of all three legs, apparent through a profile [m]
  double pressure = 1;     ///< pressure by the leg between the two, over that by a straight one; 0: behind a surface
};

/// One of the two positions, and the angles of the straight way there.
struct PairEnd {
  const Eigen::Vector3d& position;
  const Eigen::Vector3d& normal;
  const PathAngles& straight;
};

/// The legs of a view.
class PairLegs {
 public:
  /// With `through` legs run through its profile, if it has one.
  PairLegs(const SceneCloud& scene, std::span<const std::uint32_t> seen, const View& view, const Transmission& sent,
           const Environment* through);

  /// Returns the unit vector from a position straight to the head.
  Eigen::Vector3d straight_to_head(const Eigen::Vector3d& position) const { return (head_ - position).normalized(); }

  /// Returns the way by two positions that are `distance` apart in `direction`; none if a leg is in a shadow zone.
  std::optional<PairPath> by(const PairEnd& first, const PairEnd& last, const Eigen::Vector3d& direction,
                             double distance) const;

 private:
  std::optional<HeadLeg> leg_to(const Eigen::Vector3d& position) const;

  const EchoOptions& options_;
  Eigen::Vector3d head_;
  Eigen::Matrix3d to_head_;
  std::optional<RefractedLegs> rays_;
};

}  // namespace insonify
