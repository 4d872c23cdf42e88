// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <bit>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "scene_io/material_numbers_internal.hpp"

// Private to scene_io: a .tiles file as it lies on the disk (docs/scene-files.md).
namespace insonify {

static_assert(std::endian::native == std::endian::little, "a .tiles file holds numbers as they lie in memory");

constexpr char tile_magic[8] = {'i', 'n', 's', 'o', 't', 'i', 'l', 'e'};
constexpr std::uint32_t tile_version = 1;

struct TileHeader {
  char magic[8];
  std::uint32_t version, flags;
  std::uint64_t file_bytes, surfels, tiles;
  std::uint64_t directory;            ///< offset of the tile entries; the material table follows them up to the end
  std::uint64_t tail_checksum;        ///< of directory and material table
  double origin[3], low[3], high[3];  ///< [m]; the box in world coordinates
  double mean_spacing, total_area;    ///< [m], [m^2]
  float largest_area;                 ///< [m^2]
  std::uint32_t materials;
  std::uint32_t added_numbers;  ///< of each material, beyond the first three
  char reserved[92];
  std::uint64_t header_checksum;  ///< of all bytes before it
};
static_assert(sizeof(TileHeader) == 256);
constexpr std::uint32_t flag_normals_oriented = 1, flag_wide = 2, flag_laws = 4;

struct TileEntry {
  double reference[3];  ///< [m], relative to the origin; the points of the tile are relative to it
  double centre[3];     ///< [m], relative to the origin; of the ball that holds the points
  float radius;         ///< [m], of the ball
  float largest_area;   ///< [m^2]
  std::uint32_t count, unused;
  std::uint64_t offset;    ///< of the tile's bytes
  std::uint64_t checksum;  ///< of these
};
static_assert(sizeof(TileEntry) == 80);

/// Bytes of one surfel; a tile holds its arrays one after another: point (3 float32), normal (3 float32), area
/// (float32), id (uint32), material (uint16).
constexpr std::size_t surfel_bytes = 34;
constexpr std::size_t normals_at = 12, areas_at = 24, ids_at = 28, materials_at = 32;  ///< times the tile's count

/// FNV's start, then for each 8 bytes w (the last ones filled up with zeros): h = (h xor w) * 0x9e3779b97f4a7c15,
/// h = h xor (h >> 32). Finds what was damaged, not what was forged.
std::uint64_t checksum(std::span<const char> bytes);

/// Numbers and names, and if any has a law other than Lambert's (has_laws, flag_laws) the laws of all as text.
std::string pack_materials(const std::vector<Material>& materials);
bool has_laws(const std::vector<Material>& materials);
/// The materials of a file; numbers that it does not hold keep their defaults. Throws Error(content) if the bytes are
/// not exactly those that the header announces, or hold numbers that are not known.
std::vector<Material> unpack_materials(std::span<const char> bytes, const TileHeader& header, const std::string& path);

/// A file read and written at given places, whole or not at all. Errors name the path.
class BinaryFile {
 public:
  enum class Mode { read, create, nameless };  ///< nameless: in the folder of `path`, gone when closed
  /// Throws Error(file) if it cannot be opened or made.
  BinaryFile(const std::string& path, Mode mode);
  ~BinaryFile();
  BinaryFile(const BinaryFile&) = delete;
  BinaryFile& operator=(const BinaryFile&) = delete;

  /// Throw Error(file) if the system refuses; read also Error(content) at the end of the file.
  void read(std::uint64_t offset, std::span<char> bytes) const;
  void write(std::uint64_t offset, std::span<const char> bytes);
  std::uint64_t size() const;
  const std::string& path() const { return path_; }

 private:
  std::string path_;
  int descriptor_ = -1;
};

template <typename T>
std::span<char> bytes_in(T& object) {
  return {reinterpret_cast<char*>(&object), sizeof(T)};
}
template <typename T>
std::span<char> bytes_in(std::vector<T>& values) {
  return {reinterpret_cast<char*>(values.data()), values.size() * sizeof(T)};
}

}  // namespace insonify
