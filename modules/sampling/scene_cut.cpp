// SPDX-License-Identifier: BSD-3-Clause
#include "sampling/scene_cut.hpp"

#include <algorithm>
#include <span>
#include <utility>

#include "core/parallel.hpp"
#include "sampling/cut_pieces_internal.hpp"
#include "sampling/gate_surfels_internal.hpp"
#include "sampling/level_walk_internal.hpp"
#include "sampling/silhouettes_internal.hpp"
#include "scene/detail_levels.hpp"

namespace insonify {
namespace {

using Eigen::Vector3d;

constexpr std::size_t blocks_at_once = 16;
constexpr std::uint32_t roots_ahead = 4;  // that are loaded into the cache
constexpr double per_node = 20;           // directions across the widest node, in which silhouettes are looked for
constexpr std::size_t many_surfels =
    1 << 19;  // scenes without noise of so many surfels and more have coarse silhouettes

/// Returns true if nodes at silhouettes are divided (E172). Nodes of one spacing do not depend on where they are seen
/// from.
bool has_sharp_silhouettes(const CutOptions& options, bool noisy, const WholeScene& whole) {
  return options.most_width > 0 && !(options.most_spacing > 0) && (noisy || whole.surfels < many_surfels);
}

/// Keeps nodes narrow where relief hides itself (E225). Returns whether it does so anywhere.
bool narrows(LevelWalk& walk, const std::vector<CutPiece>& pieces, const CutOptions& options) {
  if (!(options.most_width > 0) || options.most_spacing > 0) return false;
  const RangeTenths<bool> shaded = energy_of(pieces).hidden_by_relief();
  walk.narrow(shaded);
  return std::ranges::find(shaded, true) != shaded.end();
}

/// The ids of the nodes of a cut that stand at silhouettes, ascending.
std::vector<std::uint32_t> divided_of(const SceneCloud& cut, const InsonifiedRegion& region, const BeamFan& fan,
                                      const CutOptions& options) {
  const double cell = options.most_width * fan.beam_width / per_node;
  const std::vector<std::uint8_t> found = at_silhouettes(cut, region, cell, options.threads);
  std::vector<std::uint32_t> ids;
  for (std::size_t i = 0; i < cut.size(); ++i)
    if (found[i] && is_node(cut, i)) ids.push_back(cut.id[i]);
  std::ranges::sort(ids);
  return ids;
}

/// Returns what stands for the surfels of a scene, block by block.
std::vector<CutPiece> walked(const LevelWalk& walk, const SceneCloud& scene, const DetailLevels& levels,
                             const InsonifiedRegion& region, int threads) {
  std::vector<CutPiece> pieces((levels.block.size() + blocks_at_once - 1) / blocks_at_once);
  parallel_blocks(levels.block.size(), blocks_at_once, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t b = begin; b < end; ++b) {
      const DetailBlock& block = levels.block[b];
      const Vector3d centre = scene.origin + block.centre.cast<double>();
      if (!may_intersect(region, centre, block.radius, block.largest_area)) continue;
      const Walked of{scene, levels};
      for (std::uint32_t k = block.begin; k < block.end; ++k) {
        if (k + roots_ahead < block.end) LevelWalk::prefetch(of, levels.root[k + roots_ahead]);
        walk.visit(of, levels.root[k], false, pieces[begin / blocks_at_once]);
      }
    }
  });
  return pieces;
}

/// The pieces of a source: what stands for the surfels of each, and what has been read of it, which is kept of small
/// scenes.
struct WalkedPieces {
  std::vector<CutPiece> pieces;
  std::vector<std::unique_ptr<LoadedLevels>> read;
};

/// Finds what stands for the surfels of the pieces of a source; of pieces that are known already, again for those of
/// which the walk divides a node.
void walk_pieces(const LevelWalk& walk, const LevelSource& source, int threads, WalkedPieces& pieces) {
  const bool first = pieces.pieces.empty(), keeps = source.like().part_of->surfels < many_surfels;
  pieces.pieces.resize(source.pieces()), pieces.read.resize(source.pieces());
  parallel_for(pieces.pieces.size(), threads, [&](std::size_t p) {
    CutPiece& piece = pieces.pieces[p];
    std::unique_ptr<LoadedLevels>& levels = pieces.read[p];
    if (!first && !walk.changes(piece)) return;
    if (!levels) levels = source.open(p);
    const Walked of{levels->scene, levels->levels, levels.get()};
    CutPiece found;
    for (const std::uint32_t root : levels->levels.root) walk.visit(of, root, false, found);
    source.note(found.stands_for.size() - piece.stands_for.size());
    piece = std::move(found);
    if (!keeps) levels.reset();
  });
}

}  // namespace

SceneCut cut_scene(const PreparedScene& prepared, const InsonifiedRegion& region, const BeamFan& fan,
                   const RangeGate& gate, const CutOptions& options) {
  const SceneCloud& scene = prepared.scene();
  const DetailLevels& levels = prepared.levels(options.threads);
  LevelWalk walk(scene, !scene.noise.empty(), region, fan, gate, options);
  const auto cut_now = [&] { return walked(walk, scene, levels, region, options.threads); };
  std::vector<CutPiece> pieces = cut_now();
  if (narrows(walk, pieces, options)) pieces = cut_now();
  OrderedCut found(pieces, scene, options.threads);
  if (has_sharp_silhouettes(options, !scene.noise.empty(), prepared.whole())) {
    if (std::vector<std::uint32_t> divided = divided_of(found.cut, region, fan, options); !divided.empty()) {
      walk.divide(std::move(divided));
      found = OrderedCut(cut_now(), scene, options.threads);
    }
  }
  found.cut.part_of = prepared.whole();
  return {PreparedScene(std::move(found.cut), std::move(found.order), options.threads), std::move(found.stands_for)};
}

SceneCloud cut_levels(const LevelSource& source, const InsonifiedRegion& region, const BeamFan& fan,
                      const RangeGate& gate, const CutOptions& options) {
  LevelWalk walk(source.like(), source.noisy(), region, fan, gate, options);
  WalkedPieces pieces;
  const auto walk_now = [&] { walk_pieces(walk, source, options.threads, pieces); };
  const auto joined_now = [&] { return joined_by_id(pieces.pieces, source.like(), source.noisy(), options.threads); };
  walk_now();
  if (narrows(walk, pieces.pieces, options)) walk_now();
  SceneCloud cut = joined_now();
  if (has_sharp_silhouettes(options, source.noisy(), *source.like().part_of)) {
    if (std::vector<std::uint32_t> divided = divided_of(cut, region, fan, options); !divided.empty()) {
      walk.divide(std::move(divided));
      walk_now();
      cut = joined_now();
    }
  }
  cut.part_of = source.like().part_of;
  return cut;
}

}  // namespace insonify
