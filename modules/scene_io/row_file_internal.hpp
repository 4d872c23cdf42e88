// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "scene_io/raw_cloud_internal.hpp"

// Private to scene_io: clouds of any size, read in batches of rows.
namespace insonify {

/// Layout of the rows of a binary cloud file.
struct RowFile {
  std::string path, format;
  std::vector<RowTable::Column> columns;
  std::size_t rows = 0, stride = 0;
  std::size_t begin = 0;  ///< offset of the first row [bytes]
  bool big_endian = false;
  SceneTags tags;
  std::optional<Eigen::Vector3d> viewpoint;  ///< [file units]
  std::vector<std::string> comments{};       ///< comments of a PLY
  RowMarks marks{};
  FileMeaning meaning{};
  std::vector<std::string> notes{};
  bool packed = false;  ///< the rows of a LAZ, which LASzip unpacks
};

/// Return the layout of a binary PLY or PCD without faces, or of a LAS or LAZ file; nothing for files that must be read as a
/// whole. Throw as load_scene for files that are missing, truncated or of another format than their extension.
std::optional<RowFile> find_ply_rows(const std::string& path);
std::optional<RowFile> find_pcd_rows(const std::string& path);
std::optional<RowFile> find_las_rows(const std::string& path);

/// Returns the layout of a binary little-endian PLY of points. Throws Error(file) if it cannot be read, Error(content)
/// "path: `otherwise`" for any other file.
RowFile rows_of_ply(const std::string& path, const char* otherwise);

/// Returns the facts in the header of the file, without points.
RawCloud raw_of(const RowFile& file);

/// Returns `count` rows starting at `first`, in this machine's byte order. Throws Error(content) for a damaged LAZ.
RowTable read_rows(const RowFile& file, std::size_t first, std::size_t count);

/// Returns all rows of the file: as a table that reads them in blocks, or in memory if they are packed.
RowTable all_rows(const RowFile& file);
/// Does the same for a LAZ, by LASzip.
RowTable unpack_rows(const RowFile& file, std::size_t first, std::size_t count);

/// Reads a file in batches, and calls use(RowTable) for each.
template <typename Use>
void each_batch(const RowFile& file, const Use& use) {
  constexpr std::size_t batch = 1 << 16;
  for (std::size_t first = 0; first < file.rows; first += batch)
    use(read_rows(file, first, std::min(batch, file.rows - first)));
}

}  // namespace insonify
