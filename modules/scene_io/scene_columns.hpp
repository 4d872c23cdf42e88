// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace insonify {

/// A column of a cloud that a scene makes no use of, as it is in its file.
struct SceneColumn {
  std::string name;
  std::string type = "float64";  ///< int8 ... float64, as FileDescription has it
  std::vector<char> bytes{};     ///< one number for each surfel, in this machine's byte order
};

/// What a file of surfels holds beside a SceneCloud.
struct SceneColumns {
  std::string material = "material";  ///< name of the column of materials
  std::vector<SceneColumn> others{};
  bool heights = false;      ///< the points are those of a height field, with the surface between them
  bool own_normals = false;  ///< whose normals are those of the points, and not of its triangles
};

/// The columns of the surfels with the ids `kept`, which are some of `ids`, those of `columns`.
SceneColumns columns_of(const SceneColumns& columns, std::span<const std::uint32_t> ids,
                        std::span<const std::uint32_t> kept);

}  // namespace insonify
