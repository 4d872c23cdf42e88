// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "viewer/viewer_data.hpp"

namespace insonify {

/// Three targets that distinguish left from right and near from far, as scene, ping and contributors. The head is at
/// (10, 20, -3) with 30 degrees of yaw; all bins except those of the targets are 60 dB weaker.
struct Target {
  const char* name;          ///< name of its material
  double azimuth, range;     ///< azimuth and range of its centre [rad, m]; positive to port
  PixelPosition pixel;       ///< sample of its echo
  Eigen::Vector3d position;  ///< world [m]
};
struct TargetData {
  ViewerData data;
  std::vector<Ping> pings;  ///< those of `data`
  Target port, starboard, far;
};
/// Returns a reel of pings that are in memory.
LazyPings reel_in_memory(std::vector<Ping> pings);

/// Returns `pings` identical pings with numbers 7, 8, ...
TargetData three_targets(std::size_t pings = 1, bool with_contributors = false);

}  // namespace insonify
