// SPDX-License-Identifier: BSD-3-Clause
#include "tiles/tiled_scene.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "core/radix_sort.hpp"
#include "files/memory_limit.hpp"
#include "tiles/tile_levels_internal.hpp"

namespace insonify {
namespace {

using Eigen::Vector3d;

constexpr double origin_step = 256;  // [m]

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
  radix_sort(order, 32, 64, [](std::uint64_t k) { return k; });
  permute(scene.point, order);
  permute(scene.normal, order);
  permute(scene.area, order);
  permute(scene.material, order);
  if (!scene.noise.empty()) permute(scene.noise, order);
  permute(scene.id, order);
}

std::string gibibytes(double bytes) {
  std::ostringstream text;
  text.precision(3);
  text << bytes / (1 << 30) << " GiB";
  return text.str();
}

}  // namespace

struct TiledScene::State {
  TileDirectory directory;
  ColumnFile columns;

  explicit State(const std::string& path)
      : directory(read_directory(path)), columns(path, BinaryFile::Mode::read, directory.begin) {}

  const std::vector<TileEntry>& tiles() const { return directory.tiles; }
  const TiledSceneInfo& info() const { return directory.info; }

  Vector3d origin_near(const Vector3d& position) const {
    if (!directory.wide) return info().origin;
    return info().origin + origin_step * ((position - info().origin) / origin_step).array().round().matrix();
  }

  /// Returns a cloud without surfels that has all other properties of the scene.
  SceneCloud cloud_at(const Vector3d& origin) const {
    SceneCloud scene;
    scene.origin = origin;
    scene.materials = info().materials;
    scene.normals_oriented = info().normals_oriented;
    scene.part_of = info().whole;
    return scene;
  }
};

TiledScene::TiledScene(const std::string& path) : state_(std::make_unique<State>(path)) {}

TiledScene::~TiledScene() = default;
TiledScene::TiledScene(TiledScene&&) noexcept = default;

const TiledSceneInfo& TiledScene::info() const { return state_->info(); }

TileSelection TiledScene::select(const InsonifiedRegion& region) const {
  TileSelection selection;
  selection.origin = state_->origin_near(region.world_from_head.translation());
  for (std::uint32_t t = 0; t < state_->tiles().size(); ++t) {
    const TileEntry& tile = state_->tiles()[t];
    if (!may_intersect(region, state_->info().origin + vector_in(tile.centre), tile.radius, tile.largest_area))
      continue;
    selection.tiles.push_back(t);
    selection.surfels += tile.count;
  }
  return selection;
}

TileSelection TiledScene::select_all() const {
  TileSelection selection;
  selection.origin = state_->info().origin;
  selection.surfels = state_->info().surfels;
  for (std::uint32_t t = 0; t < state_->tiles().size(); ++t) selection.tiles.push_back(t);
  return selection;
}

SceneCloud TiledScene::load(const TileSelection& selection, double memory, int threads) const {
  const State& s = *state_;
  require_memory(selection, selection.bytes_to_load() / std::max(1.0, static_cast<double>(selection.surfels)),
                 memory > 0 ? memory : available_memory(), s.info().path);
  std::vector<std::size_t> first = {0};
  for (const std::uint32_t t : selection.tiles) {
    if (t >= s.tiles().size())
      fail(ErrorKind::argument, "TiledScene: selection holds tile ", t, ", must be below ", s.tiles().size());
    first.push_back(first.back() + s.tiles()[t].count);
  }
  SceneCloud scene = s.cloud_at(selection.origin);
  resize(scene, first.back(), s.columns.noisy());
  parallel_for(selection.tiles.size(), threads, [&](std::size_t k) {
    read_tile(s.columns, s.directory, selection.tiles[k], selection.origin - s.info().origin, scene, first[k]);
  });
  sort_by_id(scene);
  return scene;
}

TiledCut TiledScene::cut(const InsonifiedRegion& region, const BeamFan& fan, const RangeGate& gate,
                         const CutOptions& options, double most_surfels) const {
  const State& s = *state_;
  const Vector3d origin = s.origin_near(region.world_from_head.translation());
  const ForestSource source(s.columns, s.directory, s.cloud_at(origin), region, most_surfels);
  TiledCut cut{cut_levels(source, region, fan, gate, options), 0};
  cut.bytes = source.bytes_read();
  return cut;
}

std::vector<Vector3d> TiledScene::positions() const {
  std::vector<Vector3d> positions;
  for (const TileEntry& tile : state_->tiles()) positions.push_back(state_->info().origin + vector_in(tile.centre));
  return positions;
}

void require_memory(const TileSelection& selection, double bytes_per_surfel, double memory, const std::string& path) {
  const double needed = bytes_per_surfel * static_cast<double>(selection.surfels);
  if (needed > memory)
    fail(ErrorKind::memory, path, ": the ", selection.surfels, " surfels within reach need about ", gibibytes(needed),
         " of memory, ", gibibytes(memory),
         " may be used; shorten the range, use a narrower sonar or a coarser scene, ", "or raise the limit");
}

}  // namespace insonify
