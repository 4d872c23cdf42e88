// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <cstring>
#include <sstream>

#include "core/error.hpp"
#include "files/input_file.hpp"
#include "hdf/hdf5_internal.hpp"
#include "tiles/scene_tags.hpp"
#include "tiles/tile_file_internal.hpp"

namespace insonify {
namespace {

using namespace hdf5;

constexpr std::int64_t newest_version = 3;  // 1 was not HDF5; 2 had neither noise nor coordinate systems
constexpr const char* format_text = "insonify tiles";
constexpr DatasetName node_name{"/node", "", "levels of detail: a node stands for its children"};
constexpr DatasetName node_noise_name{"/node_noise", "m",
                                      "of the nodes: root of the mean square of their surfels' noise"};
constexpr DatasetName child_name{"/child", "", "rows and nodes below nodes, numbered within their forest"};
constexpr DatasetName forest_name{"/forest", "", "consecutive tiles with their levels of detail"};
constexpr DatasetName tile_name{"/tile", "m, m, m, m^2, 1, 1, 1", "consecutive surfels and the ball that holds them"};

constexpr std::array<DatasetName, tile_columns> column_names = {{
    {"/point", "m", "relative to the reference of the tile, which is relative to the origin"},
    {"/normal", "", "unit vector"},
    {"/area", "m^2", "of the surface for which the surfel stands"},
    {"/id", "", "number of the surfel, to which its speckle is bound"},
    {"/material", "", "index into the materials"},
    {"/noise", "m", "standard deviation of the surfel across the surface"},
}};

hid_t type_of_column(std::size_t c) {
  return c < 3 || c == noise_column ? H5T_IEEE_F32LE : c == 3 ? H5T_STD_U32LE : H5T_STD_U16LE;
}

Extent extent_of_column(std::size_t c, std::uint64_t rows) { return c < 2 ? Extent{rows, 3} : Extent{rows}; }

struct TypeMember {
  const char* name;
  std::size_t offset;
  hid_t type;
  hsize_t count;
};

template <typename Entry, typename Value>
TypeMember member(const char* name, Value Entry::*value) {
  static const Entry entry{};
  using Number = std::remove_all_extents_t<Value>;
  const auto* const at = reinterpret_cast<const char*>(&(entry.*value));
  return {name, static_cast<std::size_t>(at - reinterpret_cast<const char*>(&entry)), hdf5::type_of<Number>(true),
          sizeof(Value) / sizeof(Number)};
}

/// Returns a compound type that is the same in the file and in memory.
template <typename Entry>
Handle compound(const FileContext& context, std::initializer_list<TypeMember> members) {
  Handle type(context.checked(H5Tcreate(H5T_COMPOUND, sizeof(Entry)), "type"), H5Tclose);
  for (const TypeMember& m : members) {
    const Handle array(context.checked(H5Tarray_create2(m.type, 1, &m.count), m.name), H5Tclose);
    context.checked(H5Tinsert(type, m.name, m.offset, m.count == 1 ? m.type : hid_t{array}), m.name);
  }
  return type;
}

Handle tile_type(const FileContext& context) {
  using T = TileEntry;
  return compound<T>(context,
                     {member("reference", &T::reference), member("centre", &T::centre), member("radius", &T::radius),
                      member("largest_area", &T::largest_area), member("first", &T::first), member("count", &T::count),
                      member("checksum", &T::checksum)});
}

Handle forest_type(const FileContext& context) {
  using F = TileForest;
  return compound<F>(
      context, {member("reference", &F::reference), member("centre", &F::centre), member("radius", &F::radius),
                member("largest_area", &F::largest_area), member("first_row", &F::first_row), member("rows", &F::rows),
                member("first_tile", &F::first_tile), member("tiles", &F::tiles), member("first_node", &F::first_node),
                member("first_child", &F::first_child), member("loose", &F::loose), member("node_end", &F::node_end),
                member("child_end", &F::child_end), member("checksum", &F::checksum)});
}

Handle node_type(const FileContext& context) {
  using N = TileNode;
  return compound<N>(
      context,
      {member("point", &N::point), member("normal", &N::normal), member("area", &N::area), member("extent", &N::extent),
       member("thickness", &N::thickness), member("normals", &N::normals), member("cell", &N::cell),
       member("place", &N::position), member("own_area", &N::own_area), member("id", &N::id),
       member("first_child", &N::first_child), member("children", &N::children), member("material", &N::material)});
}

template <typename Entry>
void write_table(const FileContext& context, hid_t file, const DatasetName& name, hid_t type,
                 const std::vector<Entry>& entries) {
  const Handle table = create_dataset(context, file, name, type, {entries.size()});
  if (!entries.empty())
    context.checked(H5Dwrite(table, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, entries.data()), name.path);
}

/// The attributes of the file, in this order.
struct Facts {
  std::array<double, 3> origin, low, high;
  double total_area;
  std::string scene;  // tag_lines, one per line
  std::uint64_t wide, checksum;

  std::uint64_t checksum_with(std::span<const TileEntry> tiles, std::span<const TileForest> forests) const {
    std::uint64_t hash = checksum_start;
    for (const auto& numbers : {origin, low, high, std::array<double, 3>{total_area, static_cast<double>(wide)}})
      hash = add_to_checksum({reinterpret_cast<const char*>(numbers.data()), sizeof(numbers)}, hash);
    hash = add_to_checksum(scene, hash);
    hash = add_to_checksum({reinterpret_cast<const char*>(tiles.data()), tiles.size_bytes()}, hash);
    return add_to_checksum({reinterpret_cast<const char*>(forests.data()), forests.size_bytes()}, hash);
  }
};
template <typename Stream>
void pass(Stream& stream, Facts& f) {
  stream(f.origin, f.low, f.high, f.total_area, f.scene, f.wide, f.checksum);
}

std::array<double, 3> array_of(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

/// Facts that the reader of the file sends.
struct Found {
  Facts facts;
  /// A dataset in one piece.
  struct Table {
    std::uint64_t count, begin;
  };
  std::uint64_t surfels = 0;
  Table tiles{}, forests{}, nodes{}, children{}, node_noise{};
  ColumnOffsets begin{};
};
template <typename Stream>
void pass(Stream& stream, Found& f) {
  stream(f.facts, f.surfels, f.tiles, f.forests, f.nodes, f.children, f.node_noise, f.begin);
}

Found find_all(const FileContext& context, hid_t file) {
  if (H5Aexists(file, "format") <= 0 || read_text(context, file, "format") != format_text)
    fail(context.kind, context.path,
         ": is an HDF5 file, but not a .tiles file; make one by: insonify prepare SCENE -o ", context.path);
  if (const std::int64_t version = read_attribute<std::int64_t>(context, file, "version"); version > newest_version)
    fail(context.kind, context.path, ": is of version ", version, " of the format, this version reads up to ",
         newest_version, "; update insonify, or prepare the scene with this one");
  Found found;
  Facts& facts = found.facts;
  for (const auto& [name, to] : {std::pair("origin", &facts.origin), {"low", &facts.low}, {"high", &facts.high}})
    read_numbers(context, file, name, H5T_NATIVE_DOUBLE, to->size(), to->data());
  facts.total_area = read_attribute(context, file, "total_area");
  facts.scene = read_text(context, file, "scene");
  facts.wide = read_attribute<std::uint64_t>(context, file, "wide");
  facts.checksum = read_attribute<std::uint64_t>(context, file, "checksum");
  found.surfels = extent_of(context, open_dataset(context, file, column_names[0]), "/point", 2)[0];
  const bool noisy = H5Lexists(file, column_names[noise_column].path, H5P_DEFAULT) > 0;
  for (std::size_t c = 0; c < (noisy ? tile_columns : noise_column); ++c) {
    found.begin[c] = find_plain(context, file, column_names[c], type_of_column(c), extent_of_column(c, found.surfels));
  }
  const auto table = [&](const DatasetName& name, hid_t type) {
    const std::uint64_t count = extent_of(context, open_dataset(context, file, name), name.path, 1)[0];
    return Found::Table{count, find_plain(context, file, name, type, {count})};
  };
  found.tiles = table(tile_name, tile_type(context));
  found.forests = table(forest_name, forest_type(context));
  found.nodes = table(node_name, node_type(context));
  found.children = table(child_name, H5T_STD_U32LE);
  if (noisy) found.node_noise = table(node_noise_name, H5T_IEEE_F32LE);
  return found;
}

/// Throws Error(content) if a file is not HDF5.
void require_new_format(const std::string& path) {
  require_readable(path);
  const std::string head = read_beginning(path, 8);
  if (head != "\x89HDF\r\n\x1a\n")
    fail(ErrorKind::content, path, ": not a .tiles file: expected an HDF5 file, found ", beginning_of(path),
         "; make one by: insonify prepare SCENE -o ", path);
}

}  // namespace

ColumnOffsets create_columns(const std::string& path, const std::string& name, std::uint64_t rows, bool noisy) {
  const QuietErrors quiet;
  const FileContext context{path, ErrorKind::file};
  ColumnOffsets begin{};
  write_checked(context, [&] {
    const Handle file = create_file(context, name);
    for (std::size_t c = 0; c < (noisy ? tile_columns : noise_column); ++c)
      begin[c] = create_plain(context, file, column_names[c], type_of_column(c), extent_of_column(c, rows));
  });
  return begin;
}

void add_directory(const std::string& path, const std::string& name, const TileDirectory& directory,
                   const LevelFiles& levels) {
  const QuietErrors quiet;
  const FileContext context{path, ErrorKind::file};
  std::uint64_t nodes = 0, children = 0, noise = 0;
  const TiledSceneInfo& info = directory.info;
  SceneCloud facts_of_scene;
  facts_of_scene.origin = info.origin;
  facts_of_scene.materials = info.materials;
  facts_of_scene.normals_oriented = info.normals_oriented;
  Facts facts{
      array_of(info.origin), array_of(info.box.min), array_of(info.box.max), info.total_area, {}, directory.wide, 0};
  for (const std::string& line : tag_lines(facts_of_scene, info.system)) facts.scene += line + "\n";
  if (!info.levels_of.empty()) facts.scene += "insonify levels_of " + info.levels_of + "\n";
  write_checked(context, [&] {
    const Handle file(context.checked(H5Fopen(name.c_str(), H5F_ACC_RDWR, H5P_DEFAULT), "cannot be written"), H5Fclose);
    write_table(context, file, tile_name, tile_type(context), directory.tiles);
    write_table(context, file, forest_name, forest_type(context), directory.forests);
    nodes = create_plain(context, file, node_name, node_type(context), {levels.node_count});
    children = create_plain(context, file, child_name, H5T_STD_U32LE, {levels.child_count});
    if (info.noisy) noise = create_plain(context, file, node_noise_name, H5T_IEEE_F32LE, {levels.node_count});
    write_attribute(context, file, "format", std::string(format_text));
    write_attribute(context, file, "version", newest_version);
    write_attribute(context, file, "origin", facts.origin);
    write_attribute(context, file, "low", facts.low);
    write_attribute(context, file, "high", facts.high);
    write_attribute(context, file, "total_area", facts.total_area);
    write_attribute(context, file, "scene", facts.scene);
    write_attribute(context, file, "wide", facts.wide);
    write_attribute(context, file, "checksum", facts.checksum_with(directory.tiles, directory.forests));
  });
  BinaryFile bytes(name, BinaryFile::Mode::update);
  bytes.copy(nodes, levels.nodes, 0, levels.node_count * sizeof(TileNode));
  bytes.copy(children, levels.children, 0, levels.child_count * sizeof(std::uint32_t));
  if (info.noisy) bytes.copy(noise, levels.noise, 0, levels.node_count * sizeof(float));
}

TileDirectory read_directory(const std::string& path) {
  require_new_format(path);
  Found found;
  read_hdf5(path, [](const FileContext& context, hid_t file, ArraySender& to) { to(find_all(context, file)); })(found);
  const Facts& facts = found.facts;
  TileDirectory directory;
  const BinaryFile file(path, BinaryFile::Mode::read);
  directory.tiles.resize(found.tiles.count);
  file.read(found.tiles.begin, bytes_in(directory.tiles));
  directory.forests.resize(found.forests.count);
  file.read(found.forests.begin, bytes_in(directory.forests));
  require_sound(facts.checksum == facts.checksum_with(directory.tiles, directory.forests), path,
                "its checksum is wrong");

  TiledSceneInfo& info = directory.info;
  SceneTags tags;
  std::istringstream lines(facts.scene);
  for (std::string line; std::getline(lines, line);) read_tag(path, line, tags);
  info.path = path;
  info.surfels = found.surfels;
  info.bytes = file.size();
  info.tiles = directory.tiles.size();
  info.origin = Eigen::Vector3d(facts.origin.data());
  info.box = {Eigen::Vector3d(facts.low.data()), Eigen::Vector3d(facts.high.data())};
  info.total_area = facts.total_area;
  info.normals_oriented = tags.oriented;
  info.materials = tags.materials;
  info.system = tags.system;
  info.levels_of = tags.levels_of;
  info.noisy = found.begin[noise_column] > 0;
  info.checksum = facts.checksum;
  info.whole.surfels = found.surfels;
  if (info.surfels > 0) info.whole.mean_spacing = std::sqrt(info.total_area / static_cast<double>(info.surfels));
  for (const TileEntry& tile : directory.tiles)
    info.whole.largest_area = std::max(info.whole.largest_area, tile.largest_area);
  info.whole.smooth = std::any_of(info.materials.begin(), info.materials.end(), is_smooth);
  directory.wide = facts.wide != 0;
  directory.begin = found.begin;
  directory.nodes_begin = found.nodes.begin;
  directory.children_begin = found.children.begin;
  directory.node_noise_begin = found.node_noise.begin;
  require_sound(!info.noisy || found.node_noise.count == found.nodes.count, path, "not each node has its noise");
  require_whole(directory, found.nodes.count, found.children.count);
  return directory;
}

}  // namespace insonify
