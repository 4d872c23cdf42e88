#pragma once
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "scene_io/tile_file_internal.hpp"

// Private to scene_io: putting more surfels in order of place than memory holds.
namespace insonify {

/// One surfel on its way into a tile.
struct TileRecord {
  double place[3];  ///< [m], relative to the file's origin
  float normal[3];
  float area;
  std::uint32_t id;
  std::uint16_t material, unused;
};
static_assert(sizeof(TileRecord) == 48);

/// Records in a nameless file, written through a buffer.
class RecordFile {
 public:
  /// In the folder of `path`.
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
  std::size_t most = 0;                                    ///< records in one group, which memory must hold
  std::function<void(std::vector<TileRecord>&)> take;      ///< gets every record once, in groups that stand together
  std::function<void(std::uint64_t)> moved = [](auto) {};  ///< told how many records were just read or written
};

/// Hands all records over in groups of neighbours; within a group they come in the order in which they were appended.
/// Records at one place are in one group, unless there are more than `most`. Takes twice the file's space on the disk.
void sort_by_place(std::unique_ptr<RecordFile> file, const PlaceSort& sort);

}  // namespace insonify
