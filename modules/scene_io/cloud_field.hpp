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
  std::vector<double> value;              ///< numbers of the field, unchanged
  std::vector<std::uint32_t> id;          ///< ids of the points in the scene that load_scene makes from the file
};

/// Returns the points of a cloud with finite coordinates and a finite number in `field`. Throws as load_scene, and
/// Error(content) if no point has a number or the file has no such field; the message lists the file's fields.
CloudField load_cloud_field(const std::string& path, const std::string& field);

/// Returns true if the cloud has a field of this name.
bool has_cloud_field(const std::string& path, const std::string& field);

}  // namespace insonify
