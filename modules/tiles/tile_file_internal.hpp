// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "files/binary_file.hpp"
#include "scene/detail_levels.hpp"
#include "tiles/tiled_scene.hpp"

// Private to tiles: a .tiles file as it lies on the disk (docs/scene-files.md).
namespace insonify {

static_assert(std::endian::native == std::endian::little, "a .tiles file holds numbers as they lie in memory");

/// A tile: consecutive rows of the columns.
struct TileEntry {
  double reference[3];  ///< origin of the tile's points [m], relative to the file's origin
  double centre[3];     ///< centre of the ball that holds the points [m], relative to the file's origin
  float radius;         ///< radius of the ball [m]
  float largest_area;   ///< [m^2]
  std::uint64_t first, count;
  std::uint64_t checksum;  ///< checksum of its rows
};
static_assert(sizeof(TileEntry) == 80);

/// A node of the levels of detail (DetailNode).
struct TileNode {
  float point[3], normal[3], area, extent, thickness, normals[6], cell;
  float position[3], own_area;       ///< surfel nearest to the point
  std::uint32_t id, first_child;     ///< id: of that surfel; first_child: index in the children of the forest
  std::uint16_t children, material;  ///< no children: the node is that surfel
};
static_assert(sizeof(TileNode) == 92);

/// Number of groups of children: roots, children of nodes of the largest cells, of half of them, and so on.
constexpr std::size_t level_groups = detail_doublings + 2;
/// The levels of some consecutive tiles. Nodes are ordered by group. A child is a row of the forest, or the number of
/// its rows plus a node. The first children are rows that are roots; other roots are the nodes of the first group.
struct TileForest {
  double reference[3], centre[3];  ///< those of TileEntry [m]
  float radius, largest_area;
  std::uint64_t first_row, rows, first_tile, tiles, first_node, first_child, loose;
  std::uint32_t node_end[level_groups], child_end[level_groups];  ///< end of each group, from the first node or child
  std::uint64_t checksum[level_groups];                           ///< checksum of the nodes and children of each group
};
static_assert(sizeof(TileForest) == 304);
/// Nodes and children until they are copied to the end of the file.
struct LevelFiles {
  BinaryFile nodes, children, noise;  ///< noise: noise of the nodes, if the surfels have it
  std::uint64_t node_count = 0, child_count = 0;
  explicit LevelFiles(const std::string& path)
      : nodes(path, BinaryFile::Mode::nameless),
        children(path, BinaryFile::Mode::nameless),
        noise(path, BinaryFile::Mode::nameless) {}
};

inline Eigen::Vector3d vector_in(const double (&xyz)[3]) { return {xyz[0], xyz[1], xyz[2]}; }

constexpr std::size_t tile_columns = 6, noise_column = 5;
/// The bytes of some rows in each column: points (3 float32), normals (3 float32), areas (float32), ids (uint32),
/// materials (uint16), noise (float32; empty for a scene without).
using TileRows = std::array<std::span<char>, tile_columns>;
/// Returns the bytes of `count` surfels of a cloud from `first` on.
TileRows rows_of(SceneCloud& cloud, std::size_t first, std::size_t count);
/// Gives a cloud `count` surfels of undefined values, with noise or without.
void resize(SceneCloud& cloud, std::size_t count, bool noisy);
/// Continues a checksum h: for each 8 bytes w, the last ones padded with zeros, h = (h xor w) * 0x9e3779b97f4a7c15,
/// then h = h xor (h >> 32).
constexpr std::uint64_t checksum_start = 0xcbf29ce484222325ull;
std::uint64_t add_to_checksum(std::span<const char> bytes, std::uint64_t hash);
/// Returns the checksum of arrays, one after another, from checksum_start on. It finds damage, not forgery.
std::uint64_t checksum_of(std::span<const std::span<char>> arrays);

/// Offsets of the columns in a file [bytes]; 0 for noise: the file has none.
using ColumnOffsets = std::array<std::uint64_t, tile_columns>;
/// Columns in a file; several threads may read and write them.
class ColumnFile {
 public:
  ColumnFile(const std::string& path, BinaryFile::Mode mode, const ColumnOffsets& begin)
      : file_(path, mode), begin_(begin) {}
  /// Read and write rows from `first` on; throw as BinaryFile.
  void read(std::uint64_t first, const TileRows& rows) const;
  void write(std::uint64_t first, const TileRows& rows);
  /// Copies the first `count` rows of another file.
  void copy(const ColumnFile& from, std::uint64_t count);
  /// Returns true if surfels have noise.
  bool noisy() const { return begin_[noise_column] > 0; }
  std::size_t surfel_bytes() const { return noisy() ? 38 : 34; }
  const BinaryFile& file() const { return file_; }

 private:
  std::size_t columns_of_file() const { return noisy() ? tile_columns : noise_column; }

  BinaryFile file_;
  ColumnOffsets begin_;
};

/// Everything that a .tiles file holds beside its columns.
struct TileDirectory {
  TiledSceneInfo info;
  bool wide = false;  ///< true: points are relative to the references of tiles
  std::vector<TileEntry> tiles;
  std::vector<TileForest> forests;
  ColumnOffsets begin{};
  std::uint64_t nodes_begin = 0, children_begin = 0, node_noise_begin = 0;
};

/// Returns the offsets of columns of `rows` rows, one after another.
ColumnOffsets packed_columns(std::uint64_t rows, bool noisy);
/// Creates the file `name` with columns of undefined values and returns their offsets. Errors name `path`.
ColumnOffsets create_columns(const std::string& path, const std::string& name, std::uint64_t rows, bool noisy);
/// Adds directory and levels to a file whose columns are written.
void add_directory(const std::string& path, const std::string& name, const TileDirectory& directory,
                   const LevelFiles& levels);
/// Reads and checks the directory of a file. Throws as TiledScene.
TileDirectory read_directory(const std::string& path);
/// Throws Error(content) "path: the directory is damaged: `what`" unless `good`.
void require_sound(bool good, const std::string& path, const char* what);
/// Throws Error(content) unless the directory's numbers are finite, and its tiles and forests hold all rows, nodes and
/// children of the file, one after another.
void require_whole(const TileDirectory& directory, std::uint64_t all_nodes, std::uint64_t all_children);
/// Throws Error(content) with the row's number in the file unless the rows of a tile, from `first` on in `rows`, have
/// the values of surfels.
void require_values(const TileDirectory& directory, const TileEntry& tile, const SceneCloud& rows, std::size_t first);
/// Throws Error(content) with the node's number in the file unless its values are those of a node.
void require_values(const TileDirectory& directory, std::uint64_t number, const DetailNode& node);
/// Reads and checks a tile into the surfels of a cloud from `first` on, with points relative to `reference`, itself
/// relative to the file's origin [m]. Throws Error(content) if the tile is damaged.
void read_tile(const ColumnFile& columns, const TileDirectory& directory, std::size_t number,
               const Eigen::Vector3d& reference, SceneCloud& to, std::size_t first);

}  // namespace insonify
