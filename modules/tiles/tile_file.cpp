// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cstring>

#include "core/error.hpp"
#include "tiles/tile_file_internal.hpp"

namespace insonify {
namespace {

constexpr std::array<std::size_t, tile_columns> column_bytes = {12, 12, 4, 4, 2, 4};

}  // namespace

std::uint64_t add_to_checksum(std::span<const char> bytes, std::uint64_t hash) {
  for (std::size_t at = 0; at < bytes.size(); at += 8) {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes.data() + at, std::min<std::size_t>(8, bytes.size() - at));
    hash = (hash ^ word) * 0x9e3779b97f4a7c15ull;
    hash ^= hash >> 32;
  }
  return hash;
}

TileRows rows_of(SceneCloud& cloud, std::size_t first, std::size_t count) {
  const auto bytes = [&](auto& values) {
    const std::size_t size = sizeof(values[0]);
    return bytes_in(values).subspan(first * size, count * size);
  };
  return {bytes(cloud.point), bytes(cloud.normal),   bytes(cloud.area),
          bytes(cloud.id),    bytes(cloud.material), cloud.noise.empty() ? std::span<char>() : bytes(cloud.noise)};
}

void resize(SceneCloud& cloud, std::size_t count, bool noisy) {
  cloud.point.resize(count);
  cloud.normal.resize(count);
  cloud.area.resize(count);
  cloud.id.resize(count);
  cloud.material.resize(count);
  cloud.noise.resize(noisy ? count : 0);
}

std::uint64_t checksum_of(std::span<const std::span<char>> arrays) {
  std::uint64_t hash = checksum_start;
  for (const std::span<char> array : arrays) hash = add_to_checksum(array, hash);
  return hash;
}

void ColumnFile::read(std::uint64_t first, const TileRows& rows) const {
  for (std::size_t c = 0; c < columns_of_file(); ++c) file_.read(begin_[c] + first * column_bytes[c], rows[c]);
}

void ColumnFile::write(std::uint64_t first, const TileRows& rows) {
  for (std::size_t c = 0; c < columns_of_file(); ++c) file_.write(begin_[c] + first * column_bytes[c], rows[c]);
}

void ColumnFile::copy(const ColumnFile& from, std::uint64_t count) {
  for (std::size_t c = 0; c < columns_of_file(); ++c)
    file_.copy(begin_[c], from.file_, from.begin_[c], count * column_bytes[c]);
}

ColumnOffsets packed_columns(std::uint64_t rows, bool noisy) {
  ColumnOffsets begin{};
  for (std::size_t c = 1; c < (noisy ? tile_columns : noise_column); ++c)
    begin[c] = begin[c - 1] + rows * column_bytes[c - 1];
  return begin;
}

void read_tile(const ColumnFile& columns, const TileDirectory& directory, std::size_t number,
               const Eigen::Vector3d& reference, SceneCloud& to, std::size_t first) {
  const TileEntry& tile = directory.tiles[number];
  const TileRows rows = rows_of(to, first, tile.count);
  columns.read(tile.first, rows);
  if (checksum_of(rows) != tile.checksum)
    fail(ErrorKind::content, directory.info.path, ": tile ", number, " of ", directory.tiles.size(),
         " is damaged: its checksum is wrong; copy or make the file again");
  const Eigen::Vector3d offset = Eigen::Map<const Eigen::Vector3d>(tile.reference) - reference;
  if (!offset.isZero(0))
    for (std::size_t i = first; i < first + tile.count; ++i)
      to.point[i] = (to.point[i].cast<double>() + offset).cast<float>();
  require_values(directory, tile, to, first);
}

}  // namespace insonify
