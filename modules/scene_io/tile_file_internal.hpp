// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "files/binary_file.hpp"
#include "scene_io/tiled_scene.hpp"

// Private to scene_io: a .tiles file as it lies on the disk (docs/scene-files.md).
namespace insonify {

static_assert(std::endian::native == std::endian::little, "a .tiles file holds numbers as they lie in memory");

/// Consecutive rows of the columns.
struct TileEntry {
  double reference[3];  ///< [m], relative to the origin; the points of the tile are relative to it
  double centre[3];     ///< [m], relative to the origin; of the ball that holds the points
  float radius;         ///< [m], of the ball
  float largest_area;   ///< [m^2]
  std::uint64_t first, count;
  std::uint64_t checksum;  ///< of its rows
};
static_assert(sizeof(TileEntry) == 80);

constexpr std::size_t tile_columns = 5, surfel_bytes = 34;
/// The bytes of some rows in each column: points (3 float32), normals (3 float32), areas (float32), ids (uint32),
/// materials (uint16).
using TileRows = std::array<std::span<char>, tile_columns>;
/// Returns the bytes of surfels of a cloud.
TileRows rows_of(SceneCloud& cloud, std::size_t first, std::size_t count);
/// Gives a cloud that many surfels, of undefined values.
void resize(SceneCloud& cloud, std::size_t count);
/// Returns the checksum of rows (docs/scene-files.md). It finds what was damaged, not what was forged.
std::uint64_t checksum_of(const TileRows& rows);

/// Where the columns begin in a file [bytes].
using ColumnOffsets = std::array<std::uint64_t, tile_columns>;
/// Columns in a file, for several threads.
class ColumnFile {
 public:
  ColumnFile(const std::string& path, BinaryFile::Mode mode, const ColumnOffsets& begin)
      : file_(path, mode), begin_(begin) {}
  /// Read and write rows from `first` on; throw as BinaryFile.
  void read(std::uint64_t first, const TileRows& rows) const;
  void write(std::uint64_t first, const TileRows& rows);
  /// Copies the first `count` rows of another file.
  void copy(const ColumnFile& from, std::uint64_t count);
  const BinaryFile& file() const { return file_; }

 private:
  BinaryFile file_;
  ColumnOffsets begin_;
};

/// What a .tiles file holds beside its columns.
struct TileDirectory {
  TiledSceneInfo info;
  bool wide = false;  ///< points are relative to references
  std::vector<TileEntry> tiles;
  ColumnOffsets begin{};
};

/// Offsets of columns of `rows` rows, one after another.
ColumnOffsets packed_columns(std::uint64_t rows);
/// Creates the file `name` with columns that are still to be written; errors name `path`.
ColumnOffsets create_columns(const std::string& path, const std::string& name, std::uint64_t rows);
/// Adds the directory to a file whose columns are written.
void add_directory(const std::string& path, const std::string& name, const TileDirectory& directory);
/// Reads and checks the directory of a file. Throws as TiledScene.
TileDirectory read_directory(const std::string& path);

}  // namespace insonify
