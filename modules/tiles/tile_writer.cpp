// SPDX-License-Identifier: BSD-3-Clause
// Writes a scene of any size as tiles of neighbouring surfels in bounded memory: an external sort along a Morton curve.
//   1. add              records of 56 bytes are appended to a nameless file beside the output
//   2. sort_along_curve the records' box is cut into up to 16^3 aligned cells; runs of them along the curve are parts
//                       of a second file, and so on until a part fits into memory (tile_sort.cpp)
//   3. write_group      a part is halved at the highest bit in which its places differ, as in an octree, until at most
//                       tile_surfels are in each piece; its rows go to the columns of the output
//   4. complete_tiles   only where surfels are completed by their neighbours, a group of tiles and a halo at a time
//   5. make_forests     levels of detail of the tiles of each cube of the largest cells (tile_levels.cpp)
//   6. add_directory    tiles and facts, with checksums; then the file gets its name
// Cost: about five passes over the records on the disk and O(n log n) comparisons. The bytes do not depend on threads;
// the memory allowed changes the division into tiles, not the surfels.
#include "tiles/tile_writer.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <limits>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "files/path_status.hpp"
#include "files/pending_file.hpp"
#include "tiles/tile_completion_internal.hpp"
#include "tiles/tile_levels_internal.hpp"
#include "tiles/tile_sort_internal.hpp"

namespace insonify {
namespace {

using Eigen::Vector3d, Eigen::Vector3f;

constexpr double farthest_narrow = 2000;       // [m] from the origin; float32 steps are 0.12 mm there
constexpr std::size_t bytes_per_record = 160;  // needed while a group is sorted and written
constexpr std::size_t least_memory = 1 << 20;  // [bytes]
constexpr double moves_of_a_record = 5;        // approximate number of reads and writes of a record

constexpr double reference_step = 256;  // [m]; float32 steps are below 0.02 mm within it

Vector3d position_of(const PlacedRecord& r) { return Eigen::Map<const Vector3d>(r.record.position); }

/// Halves consecutive records at the highest bit in which their positions differ, until each part holds at most `most`.
/// Dense regions get small tiles, distant clusters are separated first, and each part lies in a cell of its own.
void divide(std::span<const PlacedRecord> records, std::size_t most,
            std::vector<std::span<const PlacedRecord>>& parts) {
  while (records.size() > most) {
    const CurvePosition &first = records.front().at, &last = records.back().at;
    const std::size_t axis = MortonCurve::highest(first, last);
    std::size_t count = most;  // all at one position
    if (const std::uint64_t bits = first[axis] ^ last[axis]; bits > 0) {
      const std::uint64_t half = last[axis] & ~(std::bit_floor(bits) - 1);
      count = static_cast<std::size_t>(
          std::partition_point(records.begin(), records.end(), [&](const auto& r) { return r.at[axis] < half; }) -
          records.begin());
    }
    divide(records.first(count), most, parts);
    records = records.subspan(count);
  }
  parts.push_back(records);
}

/// Copies the records of one tile to the rows of a cloud from `first` on; sets all of `tile` but its first row.
void pack_tile(std::span<const PlacedRecord> records, bool wide, SceneCloud& rows, std::size_t first, TileEntry& tile) {
  Bounds box;
  for (const PlacedRecord& r : records) box = {box.min.cwiseMin(position_of(r)), box.max.cwiseMax(position_of(r))};
  const Vector3d centre = box.min + (box.max - box.min) / 2;
  const Vector3d reference =
      wide ? Vector3d(reference_step * (centre / reference_step).array().round()) : Vector3d::Zero();
  double radius = 0;
  tile = {};
  for (std::size_t k = 0; k < records.size(); ++k) {
    const TileRecord& r = records[k].record;
    rows.point[first + k] = (position_of(records[k]) - reference).cast<float>();
    rows.normal[first + k] = Eigen::Map<const Vector3f>(r.normal);
    rows.area[first + k] = r.area;
    rows.id[first + k] = r.id;
    rows.material[first + k] = r.material;
    if (!rows.noise.empty()) rows.noise[first + k] = r.noise;
    radius = std::max(radius, (reference + rows.point[first + k].cast<double>() - centre).norm());
    tile.largest_area = std::max(tile.largest_area, r.area);
  }
  Eigen::Map<Vector3d>(tile.reference) = reference;
  Eigen::Map<Vector3d>(tile.centre) = centre;
  // Points may move by rounding when they are loaded relative to another origin.
  tile.radius = static_cast<float>(radius * (1 + 1e-6) + (wide ? 1e-3 : 1e-6));
  tile.count = records.size();
  tile.checksum = checksum_of(rows_of(rows, first, records.size()));
}

}  // namespace

struct TileWriter::State {
  std::string path;
  TileWriterOptions options;
  std::unique_ptr<RecordFile> waiting;
  Bounds box;                                    // relative to the origin
  bool noisy = false;                            // true: a batch had noise; the surfels of other batches have 0
  double total_area = 0, moved = 0, wanted = 1;  // moved, wanted: for the progress
  TileDirectory directory;
  TileReport report;

  void report_progress(double part) const {
    if (options.progress) options.progress(std::clamp(part, 0.0, 1.0));
  }
  /// Writes a group of neighbours as tiles.
  void write_group(std::span<const PlacedRecord> group, ColumnFile& columns);
  void write_columns(const std::string& name, LevelFiles& files);
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
  std::vector<Vector3d> positions(batch.size());
  for (std::size_t i = 0; i < positions.size(); ++i) positions[i] = shift + batch.point[i].cast<double>();
  add(batch, positions);
}

void TileWriter::add(const SceneCloud& batch, std::span<const Vector3d> positions) {
  State& s = *state_;
  if (!s.waiting) fail(ErrorKind::argument, "TileWriter: add() after finish(), make another writer");
  require_valid(batch, "TileWriter");
  if (positions.size() != batch.size())
    fail(ErrorKind::argument, "TileWriter: ", positions.size(), " places for ", batch.size(),
         " surfels, must be as many");
  if (s.waiting->size() + batch.size() > std::numeric_limits<std::uint32_t>::max())
    fail(ErrorKind::content, s.path, ": more than 4294967295 surfels; divide the scene");
  s.noisy = s.noisy || !batch.noise.empty();
  for (std::size_t i = 0; i < batch.size(); ++i) {
    if (batch.material[i] >= s.options.materials.size())
      fail(ErrorKind::content, "TileWriter: batch.material[", i, "] = ", batch.material[i],
           ", must be below the number of the writer's materials, ", s.options.materials.size());
    TileRecord r{};
    Eigen::Map<Vector3d>(r.position) = positions[i];
    Eigen::Map<Vector3f>(r.normal) = batch.normal[i];
    r.area = batch.area[i];
    r.noise = batch.noise.empty() ? 0 : batch.noise[i];
    r.id = batch.id[i];
    r.material = batch.material[i];
    s.waiting->append(r);
    s.box.min = s.box.min.cwiseMin(positions[i]);
    s.box.max = s.box.max.cwiseMax(positions[i]);
    s.total_area += r.area;
  }
}

void TileWriter::State::write_group(std::span<const PlacedRecord> group, ColumnFile& columns) {
  const bool wide = directory.wide;
  std::vector<PlacedRecord> kept;
  if (options.drop_duplicates) {
    std::unique_copy(group.begin(), group.end(), std::back_inserter(kept),
                     [](const auto& a, const auto& b) { return a.at == b.at; });
    report.dropped_duplicates += group.size() - kept.size();
    group = kept;
  }
  std::vector<std::span<const PlacedRecord>> parts;
  divide(group, options.tile_surfels, parts);
  std::vector<TileEntry>& tiles = directory.tiles;
  const std::size_t before = tiles.size();
  tiles.resize(before + parts.size());
  SceneCloud rows;
  resize(rows, group.size(), noisy);
  parallel_for(parts.size(), options.threads, [&](std::size_t p) {
    const auto first = static_cast<std::size_t>(parts[p].data() - group.data());
    pack_tile(parts[p], wide, rows, first, tiles[before + p]);
    tiles[before + p].first = report.surfels + first;
  });
  columns.write(report.surfels, rows_of(rows, 0, group.size()));
  report.surfels += group.size();
}

void TileWriter::State::write_columns(const std::string& name, LevelFiles& files) {
  const std::uint64_t most = waiting->size();
  const bool shrinks = options.drop_duplicates;  // then the length of the columns is known only at the end
  std::optional<ColumnFile> columns;
  if (shrinks)
    columns.emplace(path, BinaryFile::Mode::nameless, packed_columns(most, noisy));
  else
    columns.emplace(name, BinaryFile::Mode::update, create_columns(path, name, most, noisy));
  const double sorting = options.complete ? 0.1 : 0.5, levels = options.complete ? 0.9 : 0.5;
  const auto count = static_cast<double>(most);
  double largest = 0;
  if (most > 0) largest = std::max(box.max.maxCoeff(), -box.min.minCoeff());
  directory.wide = largest > farthest_narrow;
  wanted = std::max(1.0, count * moves_of_a_record);
  CurveSort sort{.curve = MortonCurve(largest, !directory.wide)};
  sort.most = std::max(options.memory, least_memory) / bytes_per_record;
  sort.threads = options.threads;
  sort.take = [&](std::span<const PlacedRecord> group) { write_group(group, *columns); };
  sort.moved = [&](std::uint64_t records) {
    report_progress(sorting * (moved += static_cast<double>(records)) / wanted);
  };
  sort_along_curve(std::move(waiting), sort);
  if (options.complete)
    total_area = complete_tiles(*columns, directory.tiles, options,
                                [&](double part) { report_progress(sorting + (levels - sorting) * part); });
  else if (report.dropped_duplicates > 0)
    total_area = sum_of_areas(*columns, directory.tiles);
  const double spacing = report.surfels == 0 ? 0 : std::sqrt(total_area / static_cast<double>(report.surfels));
  directory.forests = make_forests(*columns, directory, spacing, files, options.threads,
                                   [&](double part) { report_progress(levels + (1 - levels) * part); });
  if (shrinks)
    ColumnFile(name, BinaryFile::Mode::update, create_columns(path, name, report.surfels, noisy))
        .copy(*columns, report.surfels);
}

TileReport TileWriter::finish() {
  State& s = *state_;
  if (!s.waiting) fail(ErrorKind::argument, "TileWriter: finish() twice, make another writer");
  PendingFile pending(s.path);
  LevelFiles levels(s.path);
  TiledSceneInfo& info = s.directory.info;
  info.path = s.path;
  info.origin = s.options.origin;
  info.normals_oriented = s.options.normals_oriented;
  info.materials = s.options.materials;
  info.system = s.options.system;
  info.levels_of = s.options.levels_of;
  info.noisy = s.noisy;
  s.write_columns(pending.temporary(), levels);
  info.box = s.box;
  if (s.report.surfels > 0) info.box = {s.box.min + info.origin, s.box.max + info.origin};
  info.total_area = s.report.total_area = s.total_area;
  s.report.tiles = s.directory.tiles.size();
  add_directory(s.path, pending.temporary(), s.directory, levels);
  s.report.bytes = size_of_file(pending.temporary());
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
