// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace insonify {

/// A column of a cloud file that a scene does not use, unchanged.
struct SceneColumn {
  std::string name;
  std::string type = "float64";  ///< int8 ... float64, as in FileDescription
  std::vector<char> bytes{};     ///< one number for each surfel, in this machine's byte order
};

/// The contents of a file of surfels beyond the SceneCloud.
struct SceneColumns {
  std::string material = "material";  ///< name of the column of materials
  std::vector<SceneColumn> others{};
  std::string system{};      ///< coordinate system of the world, as FileMeaning::system; empty: unknown
  bool heights = false;      ///< true: points of a height field, with the surface between them
  bool own_normals = false;  ///< true: the surface has the normals of the points, not of its triangles
};

/// Returns the columns of the surfels with the ids `kept`. `ids` are the ids of the rows of `columns`, and include
/// `kept`.
SceneColumns columns_of(const SceneColumns& columns, std::span<const std::uint32_t> ids,
                        std::span<const std::uint32_t> kept);

}  // namespace insonify
