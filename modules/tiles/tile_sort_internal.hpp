// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "files/binary_file.hpp"

// Private to tiles: external sorting of surfels along a Morton curve.
namespace insonify {

/// One surfel before it is stored in a tile.
struct TileRecord {
  double position[3];  ///< [m], relative to the file's origin
  float normal[3];
  float area, noise;
  std::uint32_t id;
  std::uint16_t material, unused;
};
static_assert(sizeof(TileRecord) == 56);

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

/// A position in whole numbers: places in one aligned cubic cell, of any power of two metres, have equal leading bits.
using CurvePosition = std::array<std::uint64_t, 3>;

/// The Morton curve through all positions of a scene.
class MortonCurve {
 public:
  /// Sets up the curve for coordinates of at most `largest` in magnitude [m]. With `single`, coordinates count as
  /// rounded to single precision.
  MortonCurve(double largest, bool single);
  CurvePosition at(const double (&position)[3]) const;
  /// Returns true if `a` lies before `b` on the curve: by the highest bit in which they differ, z before y before x.
  static bool before(const CurvePosition& a, const CurvePosition& b) { return a[highest(a, b)] < b[highest(a, b)]; }
  /// Returns the axis of that bit.
  static std::size_t highest(const CurvePosition& a, const CurvePosition& b);

 private:
  double cells_per_metre_;
  bool single_;
};

/// A record and its position on the curve.
struct PlacedRecord {
  CurvePosition at;
  TileRecord record;
};

struct CurveSort {
  MortonCurve curve;
  std::size_t most = 0;  ///< records in one group, which must fit in memory
  int threads = 0;
  std::function<void(std::span<const PlacedRecord>)> take = {};  ///< receives every record once, in groups
  std::function<void(std::uint64_t)> moved = [](auto) {};  ///< receives the number of records just read or written
};

/// Passes all records to `take` in the order of the curve; records at one position by their ids. Records at one position are
/// in one group; if they are more than `most`, they are in several groups and need not be in order. Needs twice the
/// disk space of the file.
void sort_along_curve(std::unique_ptr<RecordFile> file, const CurveSort& sort);

}  // namespace insonify
