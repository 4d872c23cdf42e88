// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Core>

namespace insonify {

/// Points of a cloud with one of its numbers, e.g. a measured strength.
struct CloudField {
  std::vector<Eigen::Vector3d> position;  ///< world [m]
  std::vector<double> value;              ///< as in the file
  std::vector<std::uint32_t> id;          ///< of the points in the scene that load_scene makes of the file
};

/// Reads the points of a cloud whose coordinates and whose number `field` are finite. Throws as load_scene;
/// Error(content) with the names of the file's fields if it has none of that name, or if no point has a number.
CloudField load_cloud_field(const std::string& path, const std::string& field);

/// Whether the cloud has a field of this name.
bool has_cloud_field(const std::string& path, const std::string& field);

}  // namespace insonify
