// SPDX-License-Identifier: BSD-3-Clause
#include "scene_io/tiled_scene.hpp"

#include <algorithm>
#include <cstring>
#include <fstream>
#include <limits>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "scene_io/file_probe_internal.hpp"
#include "scene_io/tile_cache_internal.hpp"
#include "scene_io/tile_file_internal.hpp"

namespace insonify {
namespace {

using Eigen::Vector3d;

constexpr double origin_step = 256;  // [m]

Vector3d vector_of(const double (&xyz)[3]) { return {xyz[0], xyz[1], xyz[2]}; }

/// Reads the header and checks it against the file.
TileHeader read_tile_header(const BinaryFile& file) {
  const std::string& path = file.path();
  TileHeader header{};
  const std::uint64_t held = file.size();
  const auto first = static_cast<std::size_t>(std::min<std::uint64_t>(held, sizeof(header)));
  file.read(0, bytes_in(header).first(first));
  const auto magic = std::span(header.magic);
  if (std::all_of(magic.begin(), magic.end(), [](char c) { return c == 0; }))
    fail(ErrorKind::content, path, ": is incomplete: its header is empty; make the file again");
  if (std::memcmp(header.magic, tile_magic, sizeof(tile_magic)) != 0)
    fail(ErrorKind::content, path, ": not a .tiles file: expected 'insotile' in its first bytes, found ",
         what_it_looks_like(path));
  if (first < sizeof(header))
    fail(ErrorKind::content, path, ": cut off: the header takes ", sizeof(header), " bytes, the file holds ", held,
         "; copy or make the file again");
  if (header.version > tile_version)
    fail(ErrorKind::content, path, ": is of version ", header.version, " of the format, this version reads up to ",
         tile_version, "; update insonify, or prepare the scene with this one");
  if (header.header_checksum != checksum(bytes_in(header).first(offsetof(TileHeader, header_checksum))))
    fail(ErrorKind::content, path, ": the header is damaged: its checksum is wrong; copy or make the file again");
  if (header.file_bytes != held)
    fail(ErrorKind::content, path, ": ", held < header.file_bytes ? "cut off" : "longer than it should be",
         ": the header announces ", header.file_bytes, " bytes, the file holds ", held,
         "; copy or make the file again");
  return header;
}

TiledSceneInfo info_of(const TileHeader& h, const std::string& path) {
  TiledSceneInfo info;
  info.path = path;
  info.surfels = h.surfels;
  info.bytes = h.file_bytes;
  info.tiles = h.tiles;
  info.origin = vector_of(h.origin);
  info.box = {vector_of(h.low), vector_of(h.high)};
  info.total_area = h.total_area;
  info.whole = {h.surfels, h.mean_spacing, h.largest_area, false};
  info.normals_oriented = (h.flags & flag_normals_oriented) != 0;
  return info;
}

/// Moves values[order[k]] to index k.
template <typename T>
void permute(std::vector<T>& values, const std::vector<std::uint64_t>& order) {
  std::vector<T> sorted(values.size());
  for (std::size_t k = 0; k < order.size(); ++k) sorted[k] = values[static_cast<std::uint32_t>(order[k])];
  values.swap(sorted);
}

void sort_by_id(SceneCloud& scene) {
  if (std::is_sorted(scene.id.begin(), scene.id.end())) return;
  std::vector<std::uint64_t> order(scene.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = std::uint64_t{scene.id[i]} << 32 | i;
  std::sort(order.begin(), order.end());
  permute(scene.point, order);
  permute(scene.normal, order);
  permute(scene.area, order);
  permute(scene.material, order);
  permute(scene.id, order);
}

template <typename T>
void copy_to(std::vector<T>& to, std::size_t first, const char* from, std::size_t count) {
  if (count > 0) std::memcpy(static_cast<void*>(to.data() + first), from, count * sizeof(T));
}

/// Unpacks the surfels of one tile into `scene` from index `first` on; `shift` is the offset from the file's origin to
/// the scene's.
void unpack(const TileEntry& tile, const std::vector<char>& bytes, const Vector3d& shift, std::size_t first,
            SceneCloud& scene) {
  const std::size_t n = tile.count;
  copy_to(scene.point, first, bytes.data(), n);
  copy_to(scene.normal, first, bytes.data() + normals_at * n, n);
  copy_to(scene.area, first, bytes.data() + areas_at * n, n);
  copy_to(scene.id, first, bytes.data() + ids_at * n, n);
  copy_to(scene.material, first, bytes.data() + materials_at * n, n);
  const Vector3d offset = vector_of(tile.reference) - shift;
  if (offset.isZero(0)) return;
  for (std::size_t i = first; i < first + n; ++i)
    scene.point[i] = (scene.point[i].cast<double>() + offset).cast<float>();
}

std::string gibibytes(double bytes) {
  std::ostringstream text;
  text.precision(3);
  text << bytes / (1 << 30) << " GiB";
  return text.str();
}

}  // namespace

struct TiledScene::State {
  BinaryFile file;
  TiledSceneInfo info;
  bool wide = false;
  std::vector<TileEntry> tiles;
  mutable TileCache cache;

  State(const std::string& path, std::size_t kept_bytes) : file(path, BinaryFile::Mode::read), cache(kept_bytes) {
    const TileHeader header = read_tile_header(file);
    info = info_of(header, path);
    wide = (header.flags & flag_wide) != 0;
    const auto damaged = [&](const char* what) {
      fail(ErrorKind::content, path, ": the directory is damaged: ", what, "; copy or make the file again");
    };
    if (header.directory > header.file_bytes ||
        header.tiles > (header.file_bytes - header.directory) / sizeof(TileEntry))
      damaged("it ends beyond the file");
    std::vector<char> tail(header.file_bytes - header.directory);
    file.read(header.directory, tail);
    if (checksum(tail) != header.tail_checksum) damaged("its checksum is wrong");
    tiles.resize(header.tiles);
    const std::size_t entry_bytes = tiles.size() * sizeof(TileEntry);
    if (entry_bytes > 0) std::memcpy(static_cast<void*>(tiles.data()), tail.data(), entry_bytes);
    info.materials = unpack_materials(std::span(tail).subspan(entry_bytes), header, path);
    info.whole.smooth = std::any_of(info.materials.begin(), info.materials.end(), is_smooth);
    std::uint64_t surfels = 0;
    for (const TileEntry& tile : tiles) {
      surfels += tile.count;
      if (tile.offset > header.directory || tile.count > (header.directory - tile.offset) / surfel_bytes)
        damaged("a tile ends beyond the data");
    }
    if (surfels != header.surfels) damaged("its tiles do not add up to the surfels announced");
  }

  Vector3d origin_near(const Vector3d& place) const {
    if (!wide) return info.origin;
    return info.origin + origin_step * ((place - info.origin) / origin_step).array().round().matrix();
  }

  std::vector<char> bytes_of(std::uint32_t number) const {
    const TileEntry& tile = tiles[number];
    std::vector<char> bytes(tile.count * surfel_bytes);
    file.read(tile.offset, bytes);
    if (checksum(bytes) != tile.checksum)
      fail(ErrorKind::content, file.path(), ": tile ", number, " of ", tiles.size(),
           " is damaged: its checksum is wrong; copy or make the file again");
    return bytes;
  }
};

TiledScene::TiledScene(const std::string& path, std::size_t kept_bytes) {
  require_readable(path);
  state_ = std::make_unique<State>(path, kept_bytes);
}

TiledScene::~TiledScene() = default;
TiledScene::TiledScene(TiledScene&&) noexcept = default;

const TiledSceneInfo& TiledScene::info() const { return state_->info; }

TileSelection TiledScene::select(const InsonifiedRegion& region) const {
  TileSelection selection;
  selection.origin = state_->origin_near(region.world_from_head.translation());
  for (std::uint32_t t = 0; t < state_->tiles.size(); ++t) {
    const TileEntry& tile = state_->tiles[t];
    if (!may_intersect(region, state_->info.origin + vector_of(tile.centre), tile.radius, tile.largest_area)) continue;
    selection.tiles.push_back(t);
    selection.surfels += tile.count;
  }
  return selection;
}

TileSelection TiledScene::select_all() const {
  TileSelection selection;
  selection.origin = state_->info.origin;
  selection.surfels = state_->info.surfels;
  for (std::uint32_t t = 0; t < state_->tiles.size(); ++t) selection.tiles.push_back(t);
  return selection;
}

SceneCloud TiledScene::load(const TileSelection& selection, double memory, int threads) const {
  const State& s = *state_;
  require_memory(selection, selection.bytes_to_load() / std::max(1.0, static_cast<double>(selection.surfels)),
                 memory > 0 ? memory : available_memory(), s.info.path);
  std::vector<std::size_t> first = {0};
  for (const std::uint32_t t : selection.tiles) {
    if (t >= s.tiles.size())
      fail(ErrorKind::argument, "TiledScene: selection holds tile ", t, ", must be below ", s.tiles.size());
    first.push_back(first.back() + s.tiles[t].count);
  }
  SceneCloud scene;
  scene.origin = selection.origin;
  scene.materials = s.info.materials;
  scene.normals_oriented = s.info.normals_oriented;
  scene.part_of = s.info.whole;
  scene.point.resize(first.back());
  scene.normal.resize(first.back());
  scene.area.resize(first.back());
  scene.material.resize(first.back());
  scene.id.resize(first.back());
  parallel_for(selection.tiles.size(), threads, [&](std::size_t k) {
    const std::uint32_t t = selection.tiles[k];
    const TileCache::Bytes bytes = s.cache.get(t, [&] { return s.bytes_of(t); });
    unpack(s.tiles[t], *bytes, selection.origin - s.info.origin, first[k], scene);
  });
  sort_by_id(scene);
  return scene;
}

std::uint64_t TiledScene::tiles_read() const { return state_->cache.reads(); }

std::vector<Vector3d> TiledScene::places() const {
  std::vector<Vector3d> places;
  for (const TileEntry& tile : state_->tiles) places.push_back(state_->info.origin + vector_of(tile.centre));
  return places;
}

double available_memory() {
  std::ifstream file("/proc/meminfo");
  std::string word;
  double kibibytes = 0;
  while (file >> word)
    if (word == "MemAvailable:" && file >> kibibytes) return 1024 * kibibytes;
  return std::numeric_limits<double>::infinity();
}

void require_memory(const TileSelection& selection, double bytes_per_surfel, double memory, const std::string& path) {
  const double needed = bytes_per_surfel * static_cast<double>(selection.surfels);
  if (needed > memory)
    fail(ErrorKind::memory, path, ": the ", selection.surfels, " surfels within reach need about ", gibibytes(needed),
         " of memory, ", gibibytes(memory),
         " may be used; shorten the range, use a narrower sonar or a coarser scene, ", "or raise the limit");
}

}  // namespace insonify
