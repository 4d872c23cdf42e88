#pragma once
#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace insonify {

/// Detected points as a structure of arrays: the returns as a 3-D point cloud.
struct Soundings {
  std::vector<Eigen::Vector3d> position;  ///< world frame [m]
  std::vector<float> level_db;            ///< dB re 1 uPa
  std::vector<float> range;               ///< [m]
  std::vector<float> azimuth;             ///< of the beam [rad]
  std::vector<float>
      elevation;  ///< of the strongest contributor [rad], as ground truth: a head of one row does not measure it
  std::vector<std::uint32_t> ping;
  std::vector<std::uint32_t> beam;
  std::vector<std::uint32_t> bin;
  std::vector<std::uint32_t> material;  ///< of the strongest contributor

  /// Returns the number of soundings.
  std::size_t size() const { return position.size(); }
};

}  // namespace insonify
