// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "acoustics/motion.hpp"

namespace insonify {

/// Standard deviations of the errors of a vehicle's navigation.
struct NavigationNoise {
  double position = 0;           ///< each coordinate [m]
  double heading = 0;            ///< [rad]
  double attitude = 0;           ///< pitch and roll each [rad]
  double correlation_time = 60;  ///< time after which the correlation of an error is 1/e [s]
};

/// Errors of a trajectory at nodes of equal distance in time, linear between them; without nodes: no errors.
struct NavigationErrors {
  double begin = 0, step = 1;                   ///< time of the first node, and between nodes [s]
  std::vector<Eigen::Vector<double, 6>> nodes;  ///< x, y, z [m], heading, pitch, roll [rad]
};

/// Returns errors along a trajectory: a first-order Gauss-Markov process for each component (E98). From node to node
///
///   e' = e exp(-dt / T) + sigma sqrt(1 - exp(-2 dt / T)) n, dt = T / 10, n standard normal by seed, node and component
///
/// and e = sigma n at the first node. The errors depend on trajectory, noise and seed alone. Throws Error(argument) for
/// a deviation that is not finite and >= 0, a correlation time that is not > 0, or more than 10^7 nodes.
NavigationErrors navigation_errors(const Trajectory& trajectory, const NavigationNoise& noise, std::uint64_t seed);

/// Returns the pose that the navigation reports at `time`. The position is shifted by its error; the pose is turned by
/// the error of heading about the vertical, and by those of pitch and roll about the vehicle's own y and x axes.
Pose believed_pose(const NavigationErrors& errors, double time, const Pose& true_pose);

}  // namespace insonify
