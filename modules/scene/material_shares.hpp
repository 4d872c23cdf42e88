// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "scene/scene_cloud.hpp"

namespace insonify {

/// Share of one material in a scene.
struct MaterialShare {
  std::string name;
  std::size_t points = 0;
  std::optional<double> area;               ///< [m^2]; empty where the areas of the points are not known
  double share = 0;                         ///< fraction of the whole area, or of all points if areas are not known
  std::string law = name_of(SurfaceLaw{});  ///< name of its law
};

/// Returns the shares of the materials that occur, in the order of the table. `material` holds an index for each point;
/// an index k beyond the table has the name "label k". `area` [m^2] is empty or has the size of `material`.
std::vector<MaterialShare> material_shares(std::span<const Material> table, std::span<const std::uint16_t> material,
                                           std::span<const float> area);

}  // namespace insonify
