// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <string>
#include <vector>

#include "tiles/tile_file_internal.hpp"

namespace insonify {

/// The content of a .tiles file, to be changed and written again with right checksums.
struct TileParts {
  TileDirectory directory;
  SceneCloud rows;  ///< in the order of the file
  std::vector<TileNode> node;
  std::vector<std::uint32_t> child;
  std::vector<float> noise;  ///< noise of the nodes; empty: none
};

inline TileParts load_tile_parts(const std::string& path) {
  TileParts parts{read_directory(path), {}, {}, {}, {}};
  const TileDirectory& d = parts.directory;
  const ColumnFile columns(path, BinaryFile::Mode::read, d.begin);
  resize(parts.rows, d.info.surfels, d.info.noisy);
  columns.read(0, rows_of(parts.rows, 0, parts.rows.size()));
  for (const TileForest& f : d.forests) {
    parts.node.resize(f.first_node + f.node_end[level_groups - 1]);
    parts.child.resize(f.first_child + f.child_end[level_groups - 1]);
  }
  columns.file().read(d.nodes_begin, bytes_in(parts.node));
  columns.file().read(d.children_begin, bytes_in(parts.child));
  parts.noise.resize(d.info.noisy ? parts.node.size() : 0);
  columns.file().read(d.node_noise_begin, bytes_in(parts.noise));
  return parts;
}

/// Writes the parts; what tiles and forests say of places beyond the parts has no checksum.
inline void save_tile_parts(TileParts parts, const std::string& path) {
  for (TileEntry& tile : parts.directory.tiles)
    if (tile.first <= parts.rows.size() && tile.count <= parts.rows.size() - tile.first)
      tile.checksum = checksum_of(rows_of(parts.rows, tile.first, tile.count));
  const auto slice = [](auto& values, std::uint64_t first, std::uint64_t begin, std::uint64_t end) {
    const std::uint64_t size = sizeof(values[0]), all = values.size();
    if (begin > end || first > all || end > all - first) return std::span<char>();
    return bytes_in(values).subspan((first + begin) * size, (end - begin) * size);
  };
  for (TileForest& f : parts.directory.forests)
    for (std::size_t g = 0; g < level_groups; ++g) {
      const std::array<std::span<char>, 3> bytes{
          slice(parts.node, f.first_node, g ? f.node_end[g - 1] : 0, f.node_end[g]),
          slice(parts.child, f.first_child, g ? f.child_end[g - 1] : 0, f.child_end[g]),
          slice(parts.noise, f.first_node, g ? f.node_end[g - 1] : 0, f.node_end[g])};
      f.checksum[g] = checksum_of(bytes);
    }
  ColumnFile(path, BinaryFile::Mode::update, create_columns(path, path, parts.rows.size(), !parts.rows.noise.empty()))
      .write(0, rows_of(parts.rows, 0, parts.rows.size()));
  LevelFiles levels(path);
  levels.nodes.write(0, bytes_in(parts.node)), levels.node_count = parts.node.size();
  levels.noise.write(0, bytes_in(parts.noise));
  levels.children.write(0, bytes_in(parts.child)), levels.child_count = parts.child.size();
  add_directory(path, path, parts.directory, levels);
}

}  // namespace insonify
