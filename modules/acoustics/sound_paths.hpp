// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <vector>

#include <Eigen/Core>

namespace insonify {

/// Paths that sound took from the head to a surface and back, structure of arrays, to be looked at.
struct SoundPaths {
  std::vector<std::vector<Eigen::Vector3d>> points;  ///< head, bounce, surface, bounce, head; world [m]
  std::vector<float> level_db;  ///< level of the echo at the head [dB re 1 uPa], absorption included
  std::vector<int> bounces;     ///< number of bounces off surface and bottom: 0, 1 or 2

  /// Returns the number of paths.
  std::size_t size() const { return points.size(); }
};

/// Adds `more` at the end of `paths`.
void append(SoundPaths& paths, const SoundPaths& more);

}  // namespace insonify
