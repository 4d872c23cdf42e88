// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "scene_io/tile_file_internal.hpp"

// Private to scene_io: external sorting of surfels by position.
namespace insonify {

/// One surfel before it is stored in a tile.
struct TileRecord {
  double place[3];  ///< [m], relative to the file's origin
  float normal[3];
  float area;
  std::uint32_t id;
  std::uint16_t material, unused;
};
static_assert(sizeof(TileRecord) == 48);

/// Records in an unnamed temporary file with buffered writing.
class RecordFile {
 public:
  /// Creates the file in the folder of `path`.
  explicit RecordFile(const std::string& path) : file_(path, BinaryFile::Mode::nameless) {}
  void append(const TileRecord& record);
  void flush();
  std::uint64_t size() const { return size_ + buffer_.size(); }
  std::vector<TileRecord> read(std::uint64_t first, std::size_t count) const;
  void write(std::uint64_t first, std::span<const TileRecord> records);
  const std::string& path() const { return file_.path(); }

 private:
  BinaryFile file_;
  std::uint64_t size_ = 0;
  std::vector<TileRecord> buffer_;
};

struct PlaceSort {
  std::size_t most = 0;                                    ///< records in one group, which must fit in memory
  std::function<void(std::vector<TileRecord>&)> take;      ///< receives every record once, in groups of neighbours
  std::function<void(std::uint64_t)> moved = [](auto) {};  ///< receives the number of records just read or written
};

/// Passes all records to `take` in groups of neighbours; within a group they keep the order of appending. Records at
/// one place are in one group, unless there are more than `most`. Needs twice the disk space of the file.
void sort_by_place(std::unique_ptr<RecordFile> file, const PlaceSort& sort);

}  // namespace insonify
