// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <cstring>
#include <sstream>

#include "core/error.hpp"
#include "hdf/hdf5_internal.hpp"
#include "scene_io/file_probe_internal.hpp"
#include "scene_io/raw_cloud_internal.hpp"
#include "scene_io/tile_file_internal.hpp"

namespace insonify {
namespace {

using namespace hdf5;

constexpr std::int64_t newest_version = 2;  // 1 was not HDF5
constexpr const char* format_text = "insonify tiles";
constexpr const char* old_magic = "insotile";
constexpr DatasetName tile_name{"/tile", "m, m, m, m^2, 1, 1, 1", "consecutive surfels and the ball that holds them"};

struct TileColumn {
  DatasetName name;
  std::size_t bytes;  // of a row
  hsize_t numbers;    // of a row
};
constexpr std::array<TileColumn, tile_columns> column_layouts = {{
    {{"/point", "m", "relative to the reference of the tile, which is relative to the origin"}, 12, 3},
    {{"/normal", "", "unit vector"}, 12, 3},
    {{"/area", "m^2", "of the surface for which the surfel stands"}, 4, 1},
    {{"/id", "", "number of the surfel, to which its speckle is bound"}, 4, 1},
    {{"/material", "", "index into the materials"}, 2, 1},
}};

hid_t type_of_column(std::size_t c) { return c < 3 ? H5T_IEEE_F32LE : c == 3 ? H5T_STD_U32LE : H5T_STD_U16LE; }

Extent extent_of_column(std::size_t c, std::uint64_t rows) {
  return column_layouts[c].numbers == 1 ? Extent{rows} : Extent{rows, column_layouts[c].numbers};
}

/// The type of a TileEntry, in the file and in memory.
Handle tile_type(const FileContext& place) {
  const auto checked = [&](auto status) { return place.checked(status, tile_name.path); };
  const hsize_t three = 3;
  const Handle vector(checked(H5Tarray_create2(H5T_IEEE_F64LE, 1, &three)), H5Tclose);
  Handle type(checked(H5Tcreate(H5T_COMPOUND, sizeof(TileEntry))), H5Tclose);
  checked(H5Tinsert(type, "reference", offsetof(TileEntry, reference), vector));
  checked(H5Tinsert(type, "centre", offsetof(TileEntry, centre), vector));
  checked(H5Tinsert(type, "radius", offsetof(TileEntry, radius), H5T_IEEE_F32LE));
  checked(H5Tinsert(type, "largest_area", offsetof(TileEntry, largest_area), H5T_IEEE_F32LE));
  checked(H5Tinsert(type, "first", offsetof(TileEntry, first), H5T_STD_U64LE));
  checked(H5Tinsert(type, "count", offsetof(TileEntry, count), H5T_STD_U64LE));
  checked(H5Tinsert(type, "checksum", offsetof(TileEntry, checksum), H5T_STD_U64LE));
  return type;
}

std::uint64_t checksum(std::span<const char> bytes, std::uint64_t hash) {
  for (std::size_t at = 0; at < bytes.size(); at += 8) {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes.data() + at, std::min<std::size_t>(8, bytes.size() - at));
    hash = (hash ^ word) * 0x9e3779b97f4a7c15ull;
    hash ^= hash >> 32;
  }
  return hash;
}
constexpr std::uint64_t checksum_start = 0xcbf29ce484222325ull;

/// The attributes of the file, in this order.
struct Facts {
  std::array<double, 3> origin, low, high;
  double total_area;
  std::string scene;  // the lines of tag_lines
  std::uint64_t wide, checksum;

  std::uint64_t checksum_with(std::span<const TileEntry> tiles) const {
    std::uint64_t hash = checksum_start;
    for (const auto& numbers : {origin, low, high, std::array<double, 3>{total_area, static_cast<double>(wide)}})
      hash = insonify::checksum({reinterpret_cast<const char*>(numbers.data()), sizeof(numbers)}, hash);
    hash = insonify::checksum(scene, hash);
    return insonify::checksum({reinterpret_cast<const char*>(tiles.data()), tiles.size_bytes()}, hash);
  }
};
template <typename Stream>
void pass(Stream& stream, Facts& f) {
  stream(f.origin, f.low, f.high, f.total_area, f.scene, f.wide, f.checksum);
}

std::array<double, 3> array_of(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }
Eigen::Vector3d vector_of(const std::array<double, 3>& v) { return {v[0], v[1], v[2]}; }

/// What the child process that reads the file finds.
struct Found {
  Facts facts;
  std::uint64_t surfels = 0, tiles = 0, table = 0;
  ColumnOffsets begin{};
};
template <typename Stream>
void pass(Stream& stream, Found& f) {
  stream(f.facts, f.surfels, f.tiles, f.table, f.begin);
}

Found find_all(const FileContext& place, hid_t file) {
  if (H5Aexists(file, "format") <= 0 || read_text(place, file, "format") != format_text)
    fail(place.kind, place.path, ": is an HDF5 file, but not a .tiles file; make one by: insonify prepare SCENE -o ",
         place.path);
  if (const std::int64_t version = read_integer(place, file, "version"); version > newest_version)
    fail(place.kind, place.path, ": is of version ", version, " of the format, this version reads up to ",
         newest_version, "; update insonify, or prepare the scene with this one");
  Found found;
  Facts& facts = found.facts;
  read_numbers(place, file, "origin", facts.origin);
  read_numbers(place, file, "low", facts.low);
  read_numbers(place, file, "high", facts.high);
  facts.total_area = read_number(place, file, "total_area");
  facts.scene = read_text(place, file, "scene");
  facts.wide = read_unsigned(place, file, "wide");
  facts.checksum = read_unsigned(place, file, "checksum");
  found.surfels = extent_of(place, open_dataset(place, file, column_layouts[0].name), "/point", 2)[0];
  for (std::size_t c = 0; c < tile_columns; ++c) {
    found.begin[c] =
        find_plain(place, file, column_layouts[c].name, type_of_column(c), extent_of_column(c, found.surfels));
  }
  found.tiles = extent_of(place, open_dataset(place, file, tile_name), tile_name.path, 1)[0];
  found.table = find_plain(place, file, tile_name, tile_type(place), {found.tiles});
  return found;
}

/// Refuses what is not HDF5.
void require_new_format(const std::string& path) {
  require_readable(path);
  const std::string head = read_beginning(path, 8);
  if (head == old_magic)
    fail(ErrorKind::content, path, ": has the format of .tiles before they were HDF5, which is not read any more; ",
         "make it anew: insonify prepare SCENE -o ", path);
  if (head != "\x89HDF\r\n\x1a\n")
    fail(ErrorKind::content, path, ": not a .tiles file: expected an HDF5 file, found ", what_it_looks_like(path));
}

}  // namespace

TileRows rows_of(SceneCloud& cloud, std::size_t first, std::size_t count) {
  const auto bytes = [&](auto& values) {
    const std::size_t size = sizeof(values[0]);
    return bytes_in(values).subspan(first * size, count * size);
  };
  return {bytes(cloud.point), bytes(cloud.normal), bytes(cloud.area), bytes(cloud.id), bytes(cloud.material)};
}

void resize(SceneCloud& cloud, std::size_t count) {
  cloud.point.resize(count);
  cloud.normal.resize(count);
  cloud.area.resize(count);
  cloud.id.resize(count);
  cloud.material.resize(count);
}

std::uint64_t checksum_of(const TileRows& rows) {
  std::uint64_t hash = checksum_start;
  for (const std::span<char> column : rows) hash = checksum(column, hash);
  return hash;
}

void ColumnFile::read(std::uint64_t first, const TileRows& rows) const {
  for (std::size_t c = 0; c < tile_columns; ++c) file_.read(begin_[c] + first * column_layouts[c].bytes, rows[c]);
}

void ColumnFile::write(std::uint64_t first, const TileRows& rows) {
  for (std::size_t c = 0; c < tile_columns; ++c) file_.write(begin_[c] + first * column_layouts[c].bytes, rows[c]);
}

void ColumnFile::copy(const ColumnFile& from, std::uint64_t count) {
  for (std::size_t c = 0; c < tile_columns; ++c)
    file_.copy(begin_[c], from.file_, from.begin_[c], count * column_layouts[c].bytes);
}

ColumnOffsets packed_columns(std::uint64_t rows) {
  ColumnOffsets begin{};
  for (std::size_t c = 1; c < tile_columns; ++c) begin[c] = begin[c - 1] + rows * column_layouts[c - 1].bytes;
  return begin;
}

ColumnOffsets create_columns(const std::string& path, const std::string& name, std::uint64_t rows) {
  const QuietErrors quiet;
  const FileContext place{path, ErrorKind::file};
  Handle file = create_file(place, name);
  ColumnOffsets begin{};
  for (std::size_t c = 0; c < tile_columns; ++c) {
    begin[c] = create_plain(place, file, column_layouts[c].name, type_of_column(c), extent_of_column(c, rows));
  }
  place.checked(file.close(), "cannot be written");
  return begin;
}

void add_directory(const std::string& path, const std::string& name, const TileDirectory& directory) {
  const QuietErrors quiet;
  const FileContext place{path, ErrorKind::file};
  failed_to_close = false;
  Handle file(place.checked(H5Fopen(name.c_str(), H5F_ACC_RDWR, H5P_DEFAULT), "cannot be written"), H5Fclose);
  {
    const Handle type = tile_type(place);
    const Handle table = create_dataset(place, file, tile_name, type, {directory.tiles.size()});
    if (!directory.tiles.empty())
      place.checked(H5Dwrite(table, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, directory.tiles.data()), tile_name.path);
  }
  const TiledSceneInfo& info = directory.info;
  SceneCloud facts_of_scene;
  facts_of_scene.origin = info.origin;
  facts_of_scene.materials = info.materials;
  facts_of_scene.normals_oriented = info.normals_oriented;
  Facts facts{
      array_of(info.origin), array_of(info.box.min), array_of(info.box.max), info.total_area, {}, directory.wide, 0};
  for (const std::string& line : tag_lines(facts_of_scene)) facts.scene += line + "\n";
  write_attribute(place, file, "format", std::string(format_text));
  write_attribute(place, file, "version", newest_version);
  write_attribute(place, file, "origin", facts.origin);
  write_attribute(place, file, "low", facts.low);
  write_attribute(place, file, "high", facts.high);
  write_attribute(place, file, "total_area", facts.total_area);
  write_attribute(place, file, "scene", facts.scene);
  write_attribute(place, file, "wide", facts.wide);
  write_attribute(place, file, "checksum", facts.checksum_with(directory.tiles));
  place.checked(file.close(), "cannot be written");  // a full disk shows here
  place.checked(failed_to_close ? -1 : 0, "cannot be written");
}

TileDirectory read_directory(const std::string& path) {
  require_new_format(path);
  Found found;
  read_apart(path, [](const FileContext& place, hid_t file, ArraySender& to) { to(find_all(place, file)); })(found);
  const Facts& facts = found.facts;
  TileDirectory directory;
  const BinaryFile file(path, BinaryFile::Mode::read);
  directory.tiles.resize(found.tiles);
  file.read(found.table, bytes_in(directory.tiles));
  const auto require = [&](bool good, const char* what) {
    if (!good) fail(ErrorKind::content, path, ": the directory is damaged: ", what, "; copy or make the file again");
  };
  require(facts.checksum == facts.checksum_with(directory.tiles), "its checksum is wrong");
  std::uint64_t surfels = 0;
  for (const TileEntry& tile : directory.tiles) {
    require(tile.first == surfels && tile.count <= found.surfels - surfels, "its tiles are not consecutive");
    surfels += tile.count;
  }
  require(surfels == found.surfels, "its tiles do not add up to the surfels");

  TiledSceneInfo& info = directory.info;
  SceneTags tags;
  std::istringstream lines(facts.scene);
  for (std::string line; std::getline(lines, line);) read_tag(path, line, tags);
  info.path = path;
  info.surfels = surfels;
  info.bytes = file.size();
  info.tiles = directory.tiles.size();
  info.origin = vector_of(facts.origin);
  info.box = {vector_of(facts.low), vector_of(facts.high)};
  info.total_area = facts.total_area;
  info.normals_oriented = tags.oriented;
  info.materials = tags.materials;
  info.checksum = facts.checksum;
  info.whole.surfels = surfels;
  if (surfels > 0) info.whole.mean_spacing = std::sqrt(info.total_area / static_cast<double>(surfels));
  for (const TileEntry& tile : directory.tiles)
    info.whole.largest_area = std::max(info.whole.largest_area, tile.largest_area);
  info.whole.smooth = std::any_of(info.materials.begin(), info.materials.end(), is_smooth);
  directory.wide = facts.wide != 0;
  directory.begin = found.begin;
  return directory;
}

}  // namespace insonify
