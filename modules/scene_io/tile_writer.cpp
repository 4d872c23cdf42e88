// SPDX-License-Identifier: BSD-3-Clause
// Writes a scene of any size as tiles of neighbouring surfels, in bounded memory: an external sort by place. Steps:
//   1. add             records of 48 bytes are appended to a nameless file beside the output
//   2. sort_by_place   the records' box is cut into 16^3 cells along a Morton curve, whose runs become parts of a second
//                      file, and so on until a part fits into memory: neighbours are in one part (tile_sort.cpp)
//   3. write_group     a part is halved across the longest side of its box, as in building a kd-tree, until at most
//                      tile_surfels are in each piece; each is packed by ascending id, with its enclosing ball
//   4. fill_areas      only where areas are estimated: Voronoi areas (E15) with the neighbours in the tiles around
//   5. write_tail      directory, materials and header, with checksums; then the file gets its name
// Cost: about five passes over the records on the disk and O(n log n) comparisons; tiles are packed in parallel. The
// bytes do not depend on threads; the memory allowed changes the division into tiles, not the surfels.
#include "scene_io/tile_writer.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <limits>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "files/pending_file.hpp"
#include "scene_io/complete_scene_internal.hpp"
#include "scene_io/tile_areas_internal.hpp"
#include "scene_io/tile_file_internal.hpp"
#include "scene_io/tile_sort_internal.hpp"

namespace insonify {
namespace {

using Eigen::Vector3d, Eigen::Vector3f;

constexpr double farthest_narrow = 2000;       // [m] from the origin; float32 steps are 0.12 mm there
constexpr std::size_t bytes_per_record = 160;  // while a group is sorted and written
constexpr std::size_t least_memory = 1 << 20;  // [bytes]
constexpr double moves_of_a_record = 5;        // approximate number of reads and writes of a record

Vector3d place_of(const TileRecord& record) { return Eigen::Map<const Vector3d>(record.place); }

/// Keeps the first of records at one position; returns the number dropped.
std::size_t drop_duplicates(std::vector<TileRecord>& group, bool wide) {
  // Compare in single precision, like load_scene.
  const Vector3d middle = wide ? place_of(group[group.size() / 2]) : Vector3d::Zero();
  std::vector<Vector3f> points;
  for (const TileRecord& r : group) points.push_back((place_of(r) - middle).cast<float>());
  const std::vector<std::uint32_t> first = first_at_same_place(points);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < group.size(); ++i)
    if (first[i] == i) group[kept++] = group[i];
  const std::size_t dropped = group.size() - kept;
  group.resize(kept);
  return dropped;
}

Bounds bounds_of(std::span<const TileRecord> records) {
  Bounds box{place_of(records[0]), place_of(records[0])};
  for (const TileRecord& r : records) box = {box.min.cwiseMin(place_of(r)), box.max.cwiseMax(place_of(r))};
  return box;
}

/// Bisects the bounding box of the records across its longest side until each part holds at most `most`: dense regions
/// get small tiles, and distant clusters are separated first.
void divide(std::span<TileRecord> records, std::size_t most, std::vector<std::span<TileRecord>>& parts) {
  while (records.size() > most) {
    const auto [low, high] = bounds_of(records);
    int axis = 0;
    const double side = (high - low).maxCoeff(&axis), middle = low[axis] + side / 2;
    auto second = records.begin() + static_cast<std::ptrdiff_t>(most);  // all at one position
    if (middle > low[axis] && middle < high[axis])
      second = std::partition(records.begin(), records.end(), [&](const auto& r) { return r.place[axis] < middle; });
    const auto count = static_cast<std::size_t>(second - records.begin());
    divide(records.first(count), most, parts);
    records = records.subspan(count);
  }
  parts.push_back(records);
}

/// The records of one tile as bytes, by ascending id; sets all of `tile` except its offset.
std::vector<char> pack_tile(std::span<TileRecord> records, bool wide, TileEntry& tile) {
  std::sort(records.begin(), records.end(), [](const auto& a, const auto& b) { return a.id < b.id; });
  const auto [low, high] = bounds_of(records);
  const Vector3d centre = low + (high - low) / 2;
  const Vector3d reference = wide ? Vector3d(centre.array().round()) : Vector3d::Zero();
  const std::size_t n = records.size();
  std::vector<char> bytes(n * surfel_bytes);
  tile = {};
  double radius = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const TileRecord& r = records[i];
    const Vector3f point = (place_of(r) - reference).cast<float>();
    std::memcpy(bytes.data() + i * 12, point.data(), 12);
    std::memcpy(bytes.data() + normals_at * n + i * 12, r.normal, 12);
    std::memcpy(bytes.data() + areas_at * n + i * 4, &r.area, 4);
    std::memcpy(bytes.data() + ids_at * n + i * 4, &r.id, 4);
    std::memcpy(bytes.data() + materials_at * n + i * 2, &r.material, 2);
    radius = std::max(radius, (reference + point.cast<double>() - centre).norm());
    tile.largest_area = std::max(tile.largest_area, r.area);
  }
  Eigen::Map<Vector3d>(tile.reference) = reference;
  Eigen::Map<Vector3d>(tile.centre) = centre;
  // Points may move by rounding to another origin when they are loaded.
  tile.radius = static_cast<float>(radius * (1 + 1e-6) + (wide ? 1e-3 : 1e-6));
  tile.count = static_cast<std::uint32_t>(n);
  tile.checksum = checksum(bytes);
  return bytes;
}

}  // namespace

struct TileWriter::State {
  std::string path;
  TileWriterOptions options;
  std::unique_ptr<RecordFile> waiting;
  Bounds box;                                    // relative to the origin
  double total_area = 0, moved = 0, wanted = 1;  // moved, wanted: for the progress
  std::vector<TileEntry> tiles;
  TileReport report;
  std::uint64_t end = sizeof(TileHeader);
  bool wide = false;

  void report_progress(double part) const {
    if (options.progress) options.progress(std::clamp(part, 0.0, 1.0));
  }
  /// Writes a group of neighbours as tiles.
  void write_group(std::vector<TileRecord>& group, BinaryFile& file);
  void write_tail(BinaryFile& file);
};

TileWriter::TileWriter(const std::string& path, const TileWriterOptions& options) : state_(std::make_unique<State>()) {
  if (options.tile_surfels == 0) fail(ErrorKind::argument, "TileWriter: tile_surfels = 0, must be at least 1");
  if (!options.origin.allFinite()) fail(ErrorKind::argument, "TileWriter: origin must be finite");
  for (const Material& material : options.materials) require_valid(material, "TileWriter");
  std::error_code ignored;
  if (path.empty() || std::filesystem::is_directory(path, ignored))
    fail(ErrorKind::file, path.empty() ? "\"\"" : path, ": is not a valid name for an output file");
  state_->path = path;
  state_->options = options;
  state_->waiting = std::make_unique<RecordFile>(path);
}

TileWriter::~TileWriter() = default;

void TileWriter::add(const SceneCloud& batch) {
  const Vector3d shift = batch.origin - state_->options.origin;
  std::vector<Vector3d> places(batch.size());
  for (std::size_t i = 0; i < places.size(); ++i) places[i] = shift + batch.point[i].cast<double>();
  add(batch, places);
}

void TileWriter::add(const SceneCloud& batch, std::span<const Vector3d> places) {
  State& s = *state_;
  if (!s.waiting) fail(ErrorKind::argument, "TileWriter: add() after finish(), make another writer");
  require_valid(batch, "TileWriter");
  if (places.size() != batch.size())
    fail(ErrorKind::argument, "TileWriter: ", places.size(), " places for ", batch.size(), " surfels, must be as many");
  if (s.waiting->size() + batch.size() > std::numeric_limits<std::uint32_t>::max())
    fail(ErrorKind::content, s.path, ": more than 4294967295 surfels; divide the scene");
  for (std::size_t i = 0; i < batch.size(); ++i) {
    if (batch.material[i] >= s.options.materials.size())
      fail(ErrorKind::content, "TileWriter: batch.material[", i, "] = ", batch.material[i],
           ", must be below the number of the writer's materials, ", s.options.materials.size());
    TileRecord r{};
    Eigen::Map<Vector3d>(r.place) = places[i];
    Eigen::Map<Vector3f>(r.normal) = batch.normal[i];
    r.area = batch.area[i];
    r.id = batch.id[i];
    r.material = batch.material[i];
    s.waiting->append(r);
    s.box.min = s.box.min.cwiseMin(places[i]);
    s.box.max = s.box.max.cwiseMax(places[i]);
    s.total_area += r.area;
  }
}

void TileWriter::State::write_group(std::vector<TileRecord>& group, BinaryFile& file) {
  if (options.drop_duplicates) report.dropped_duplicates += drop_duplicates(group, wide);
  std::vector<std::span<TileRecord>> parts;
  divide(group, options.tile_surfels, parts);
  const std::size_t first = tiles.size();
  tiles.resize(first + parts.size());
  std::vector<std::vector<char>> packed(parts.size());
  parallel_for(parts.size(), options.threads,
               [&](std::size_t p) { packed[p] = pack_tile(parts[p], wide, tiles[first + p]); });
  for (std::size_t p = 0; p < parts.size(); ++p) {
    tiles[first + p].offset = end;
    file.write(end, packed[p]);
    end += packed[p].size();
  }
  report.surfels += group.size();
}

void TileWriter::State::write_tail(BinaryFile& file) {
  std::vector<char> tail(tiles.size() * sizeof(TileEntry));
  if (!tiles.empty()) std::memcpy(tail.data(), tiles.data(), tail.size());
  const std::string materials = pack_materials(options.materials);
  tail.insert(tail.end(), materials.begin(), materials.end());
  file.write(end, tail);

  TileHeader h{};
  std::memcpy(h.magic, tile_magic, sizeof(h.magic));
  h.version = tile_version;
  h.flags = (options.normals_oriented ? flag_normals_oriented : 0) | (wide ? flag_wide : 0) |
            (has_laws(options.materials) ? flag_laws : 0);
  h.file_bytes = report.bytes = end + tail.size();
  h.surfels = report.surfels;
  h.tiles = report.tiles = tiles.size();
  h.directory = end;
  h.tail_checksum = checksum(tail);
  const bool empty = report.surfels == 0;
  for (int axis = 0; axis < 3; ++axis) {
    h.origin[axis] = options.origin[axis];
    h.low[axis] = box.min[axis] + (empty ? 0 : options.origin[axis]);
    h.high[axis] = box.max[axis] + (empty ? 0 : options.origin[axis]);
  }
  h.total_area = report.total_area = total_area;
  h.mean_spacing = empty ? 0 : std::sqrt(total_area / static_cast<double>(report.surfels));
  for (const TileEntry& tile : tiles) h.largest_area = std::max(h.largest_area, tile.largest_area);
  h.materials = static_cast<std::uint32_t>(options.materials.size());
  h.added_numbers = static_cast<std::uint32_t>(numbers_said(options.materials) - first_material_numbers);
  h.header_checksum = checksum(bytes_in(h).first(offsetof(TileHeader, header_checksum)));
  file.write(0, bytes_in(h));
}

TileReport TileWriter::finish() {
  State& s = *state_;
  if (!s.waiting) fail(ErrorKind::argument, "TileWriter: finish() twice, make another writer");
  const auto count = static_cast<double>(s.waiting->size());
  if (count > 0) s.wide = std::max(s.box.max.maxCoeff(), -s.box.min.minCoeff()) > farthest_narrow;
  s.wanted = std::max(1.0, count * moves_of_a_record);
  const double sorting = s.options.estimate_areas ? 0.2 : 1;
  PendingFile pending(s.path);
  BinaryFile file(pending.temporary(), BinaryFile::Mode::create);
  PlaceSort sort;
  sort.most = std::max(s.options.memory, least_memory) / bytes_per_record;
  sort.take = [&](std::vector<TileRecord>& group) { s.write_group(group, file); };
  sort.moved = [&](std::uint64_t records) {
    s.report_progress(sorting * (s.moved += static_cast<double>(records)) / s.wanted);
  };
  sort_by_place(std::move(s.waiting), sort);
  if (s.options.estimate_areas)
    s.total_area = fill_areas(file, s.tiles, s.options, [&](double part) { s.report_progress(sorting + 0.8 * part); });
  else if (s.report.dropped_duplicates > 0)
    s.total_area = sum_of_areas(file, s.tiles);
  s.write_tail(file);
  s.report_progress(1);
  pending.commit();
  return s.report;
}

TileReport save_tiles(const std::string& path, const SceneCloud& scene, TileWriterOptions options) {
  options.origin = scene.origin;
  options.materials = scene.materials;
  options.normals_oriented = scene.normals_oriented;
  TileWriter writer(path, options);
  writer.add(scene);
  return writer.finish();
}

}  // namespace insonify
