// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "core/grid.hpp"
#include "core/pose.hpp"
#include "core/units.hpp"
#include "sonar/sonar_spec.hpp"
#include "sonar/water.hpp"

namespace insonify {

/// Returns the head of the benchmarks: 512 beams over 130 x 20 degrees at 750 kHz, from 0.5 m on.
inline SonarHead wide_head(double bandwidth, double max_range) {
  SonarSpec spec;
  spec.name = "wide";
  spec.centre_frequency = 750e3, spec.bandwidth = bandwidth, spec.beams = 512;
  spec.field_of_view = radians(130), spec.beam_width = radians(1), spec.elevation_width = radians(20);
  spec.min_range = 0.5, spec.max_range = max_range;
  return make_head(spec, sound_speed(Water{}));
}

/// Returns its pose in the harbour.
inline Pose harbour_pose() { return pose_from_yaw_pitch_roll({0, 0, -3}, 0, radians(10), 0); }

/// Returns means over blocks of so many beams and bins.
inline Grid<double> mean_of(const Grid<double>& level, Eigen::Index beams, Eigen::Index bins) {
  Grid<double> mean(level.rows() / beams, level.cols() / bins);
  for (Eigen::Index b = 0; b < mean.rows(); ++b)
    for (Eigen::Index n = 0; n < mean.cols(); ++n) mean(b, n) = level.block(b * beams, n * bins, beams, bins).mean();
  return mean;
}

}  // namespace insonify
