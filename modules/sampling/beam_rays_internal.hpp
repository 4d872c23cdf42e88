#pragma once
#include <vector>

#include <Eigen/Core>

#include "core/pose.hpp"
#include "sampling/find_scatterers.hpp"

namespace insonify {

/// The part of the insonified sector that one beam's rays cover.
struct BeamShare {
  double min_azimuth = 0, max_azimuth = 0;      ///< of cones [rad]
  double min_elevation = 0, max_elevation = 0;  ///< [rad]
};

/// Shares of all beams: they tile `sector` in cones, cut at the midpoints between neighbouring beams. Beams
/// of one azimuth share the sector's elevations in the same way. So every direction belongs to one beam, also when
/// rows are staggered or no two beams have an azimuth in common: rays serve all beams, not only their own.
std::vector<BeamShare> beam_shares(const BeamFan& fan, const Sector& sector);

/// A direction in which a beam looks.
struct Ray {
  Direction direction;
  Eigen::Vector3f along;   ///< unit vector
  double solid_angle = 0;  ///< its part of the beam's share [sr]
};

/// options.rays_per_beam rays in each beam's share, beam by beam and upwards: one per equal interval of turn in its cone,
/// jittered in it by options.seed, spread over cones by the golden ratio; solid angle |cos(cone)| dcone dturn.
std::vector<Ray> beam_rays(const std::vector<BeamShare>& shares, const SamplingOptions& options);

}  // namespace insonify
