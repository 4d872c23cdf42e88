// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace insonify {

/// Detected points as a structure of arrays: the returns as a 3-D point cloud. What a sonar measures is level, range
/// and the direction of the beam; the columns true_... hold what only the simulator knows, and decide nothing.
struct Soundings {
  static constexpr std::uint32_t none = 0xffffffff;  ///< of true_surfel and true_material: no surfel contributes

  /// World [m]: at the measured range, towards the strongest contributor, so that the cloud lies on the scene; without
  /// one (noise, reverberation, side lobes) on the axis of the beam.
  std::vector<Eigen::Vector3d> position;
  std::vector<float> level_db;   ///< dB re 1 uPa
  std::vector<float> range;      ///< [m]
  std::vector<float> azimuth;    ///< of the beam [rad]
  std::vector<float> elevation;  ///< of the beam [rad]: a head of one row does not measure more
  std::vector<std::uint32_t> ping;
  std::vector<std::uint32_t> beam;
  std::vector<std::uint32_t> bin;
  std::vector<float> true_elevation;         ///< of the strongest contributor [rad]; NaN: none
  std::vector<std::uint32_t> true_surfel;    ///< its id in the scene
  std::vector<std::uint32_t> true_material;  ///< index into the scene's materials
  /// Surfaces that the strongest contributor met: 1, or 2 for an echo by way of two, where true_surfel is the last. Empty
  /// if no such echoes were computed.
  std::vector<std::uint32_t> true_order{};

  /// Returns the number of soundings.
  std::size_t size() const { return position.size(); }
};

}  // namespace insonify
