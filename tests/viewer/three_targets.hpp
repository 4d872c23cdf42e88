#pragma once
#include "viewer/viewer_data.hpp"

namespace insonify {

/// Three targets that tell left from right and near from far, as scene, ping and contributors. The head stands at
/// (10, 20, -3), turned by 30 degrees to port; every bin but those of the targets is 60 dB weaker than they.
struct Target {
  const char* name;          ///< of its material
  double azimuth, range;     ///< of its middle [rad, m]; positive azimuth is to port
  PixelPlace place;          ///< where it is heard
  Eigen::Vector3d position;  ///< world [m]
};
struct TargetData {
  ViewerData data;
  Target port, starboard, far;
};
/// `pings` alike but for their numbers, which count from 7.
TargetData three_targets(std::size_t pings = 1, bool with_contributors = false);

}  // namespace insonify
