#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "scene_io/raw_cloud_internal.hpp"

// Private to scene_io: clouds that are read row by row, however large.
namespace insonify {

/// Where the rows of an uncompressed binary cloud lie in its file.
struct RowFile {
  std::string path, format;
  std::vector<RowTable::Column> columns;
  std::size_t rows = 0, stride = 0;
  std::size_t begin = 0;  ///< [bytes] where the first row begins
  bool big_endian = false;
  SceneTags tags;
  std::optional<Eigen::Vector3d> viewpoint;  ///< [file units]
};

/// The rows of a binary PLY or PCD without faces; nothing for files that must be read as a whole. Throw as load_scene
/// for those that are cut off or not what their name says.
std::optional<RowFile> find_ply_rows(const std::string& path);
std::optional<RowFile> find_pcd_rows(const std::string& path);

/// Rows `first` on, in this machine's byte order.
RowTable read_rows(const RowFile& file, std::size_t first, std::size_t count);

}  // namespace insonify
