// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace insonify {

/// Detected points as a structure of arrays: the returns as a 3-D point cloud. A sonar measures level, range and the
/// direction of the beam. The columns true_... hold facts that only the simulator knows; no detection depends on them.
struct Soundings {
  static constexpr std::uint32_t none =
      0xffffffff;  ///< value of true_surfel and true_material if no surfel contributes

  /// [m], world. The point lies at the measured range in the direction of the strongest contributor, so that the cloud
  /// lies on the scene. Without a contributor (noise, reverberation, side lobes) it lies on the axis of the beam.
  std::vector<Eigen::Vector3d> position;
  std::vector<float> level_db;   ///< dB re 1 uPa
  std::vector<float> range;      ///< [m]
  std::vector<float> azimuth;    ///< azimuth of the beam [rad]
  std::vector<float> elevation;  ///< elevation of the beam [rad]; a head with one row cannot measure that of the echo
  std::vector<std::uint32_t> ping;
  std::vector<std::uint32_t> beam;
  std::vector<std::uint32_t> bin;
  std::vector<float> true_elevation;         ///< elevation of the strongest contributor [rad]; NaN: none
  std::vector<std::uint32_t> true_surfel;    ///< id in the scene of the strongest contributor
  std::vector<std::uint32_t> true_material;  ///< index into the scene's materials
  /// Number of surfaces on the path of the strongest contributor: 1, or 2 for a double echo, whose last surface is
  /// true_surfel. Empty if no double echoes were computed.
  std::vector<std::uint32_t> true_order{};

  /// Returns the number of soundings.
  std::size_t size() const { return position.size(); }
};

}  // namespace insonify
