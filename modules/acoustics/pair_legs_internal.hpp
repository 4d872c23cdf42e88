// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <complex>
#include <cstdint>
#include <optional>
#include <span>

#include "acoustics/bent_legs_internal.hpp"
#include "acoustics/surface_scattering.hpp"

// Private to acoustics: legs of echoes by way of two places of a scene, straight or through a profile. World axes,
// relative to the scene's origin [m].
namespace insonify {

/// The leg between the head and a place on a surface.
struct HeadLeg {
  Eigen::Vector3d to_head;          ///< unit vector along it at the place
  double range;                     ///< [m], through a profile the apparent one
  double u, v;                      ///< direction cosines of the place, through a profile of the ray to it
  std::complex<double> gain, sent;  ///< one-way pattern; with the transmitter's in azimuth
};

/// The way from the head by two places and back.
struct PairWay {
  HeadLeg out, back;
  PathAngles here, there;  ///< angles at both: in from the head, out to the other place
  double path = 0;         ///< length of all three legs, apparent through a profile [m]
  double pressure = 1;     ///< pressure by the leg between the two, over that by a straight one; 0: behind a surface
};

/// One of the two places, and the angles of the straight way there.
struct PairEnd {
  const Eigen::Vector3d& place;
  const Eigen::Vector3d& normal;
  const PathAngles& straight;
};

/// The legs of a view.
class PairLegs {
 public:
  /// With `through` legs run through its profile, if it has one.
  PairLegs(const SceneCloud& scene, std::span<const std::uint32_t> seen, const View& view, const Transmission& sent,
           const Environment* through);

  /// Returns the unit vector from a place straight to the head.
  Eigen::Vector3d straight_to_head(const Eigen::Vector3d& place) const { return (head_ - place).normalized(); }

  /// Returns the way by two places that are `distance` apart in `direction`; none if a leg is in a shadow zone.
  std::optional<PairWay> by(const PairEnd& first, const PairEnd& last, const Eigen::Vector3d& direction,
                            double distance) const;

 private:
  std::optional<HeadLeg> leg_to(const Eigen::Vector3d& place) const;

  const EchoOptions& options_;
  Eigen::Vector3d head_;
  Eigen::Matrix3d to_head_;
  std::optional<BentLegs> rays_;
};

}  // namespace insonify
