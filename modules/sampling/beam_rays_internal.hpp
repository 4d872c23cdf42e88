// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <vector>

#include <Eigen/Core>

#include "core/pose.hpp"
#include "sampling/find_scatterers.hpp"

namespace insonify {

/// The part of the insonified sector covered by the rays of one beam.
struct BeamCell {
  double min_azimuth = 0, max_azimuth = 0;      ///< bounds of the cones [rad]
  double min_elevation = 0, max_elevation = 0;  ///< [rad]
};

/// Returns the parts of the sector that belong to the beams. They tile `sector`: in cones cut at the midpoints between
/// neighbouring columns of beams, in elevation at the midpoints between the beams of a column. Every direction thus
/// belongs to exactly one beam, also for staggered rows or beams that all differ in azimuth; each ray contributes to
/// all beams.
std::vector<BeamCell> beam_cells(const BeamFan& fan, const Sector& sector);

/// A ray from the head.
struct Ray {
  Direction direction;
  Eigen::Vector3f along;   ///< unit vector
  double solid_angle = 0;  ///< solid angle that the ray represents [sr]
};

/// Returns options.rays_per_beam rays per beam, beam by beam and upwards: one per equal interval of turn in its cone,
/// jittered within it by options.seed, with cones from the golden-ratio sequence; solid angle |cos(cone)| dcone dturn.
std::vector<Ray> beam_rays(const std::vector<BeamCell>& shares, const SamplingOptions& options);

}  // namespace insonify
