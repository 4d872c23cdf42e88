// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/vector_functions.hpp"
#include "sampling/cut_pieces_internal.hpp"
#include "sampling/gate_surfels_internal.hpp"
#include "sampling/scene_cut.hpp"
#include "scene/detail_levels.hpp"

namespace insonify {

/// The levels that are walked, of a scene that is whole or loaded on the way.
struct Walked {
  const SceneCloud& scene;
  const DetailLevels& levels;
  LoadedLevels* piece = nullptr;
};

/// Walks down the levels, as far as a head resolves their nodes.
class LevelWalk {
 public:
  /// The surfels of `scene` are not used; `noisy`: those that are walked have noise.
  LevelWalk(const SceneCloud& scene, bool noisy, const InsonifiedRegion& region, const BeamFan& fan,
            const RangeGate& gate, const CutOptions& options);

  /// Divides the nodes that stand for surfels of these ids (ascending) down to surfels.
  void divide(std::vector<std::uint32_t> divided) { divided_ = std::move(divided); }
  /// Keeps nodes narrow at grazing incidence in these tenths of the ranges (E225).
  void narrow(const RangeTenths<bool>& shaded) { shaded_ = shaded; }
  /// Returns true if the walk may find something else for a piece than before nodes were divided or kept narrow.
  bool changes(const CutPiece& piece) const;

  /// Adds what stands for a root or child; `inside`: its cell is known to lie within the region; `divided`: it belongs
  /// to a node that is divided.
  void visit(const Walked& of, std::uint32_t index, bool inside, CutPiece& out, bool divided = false) const;

  /// Loads a root or child of a scene in memory into the cache, in which neighbours stand far from each other; inline,
  /// since the compiler drops calls of functions that do no more.
  INSONIFY_ALWAYS_INLINE static void prefetch(const Walked& of, std::uint32_t index) {
    if (index < of.levels.surfels) {
      __builtin_prefetch(&of.scene.point[index]);
      __builtin_prefetch(&of.scene.normal[index]);
      __builtin_prefetch(&of.scene.area[index]);
      return;
    }
    const DetailNode* const node = &of.levels.node[index - of.levels.surfels];
    __builtin_prefetch(node);
    __builtin_prefetch(&node->thickness);
    __builtin_prefetch(&node->cell);
  }

 private:
  bool divides(std::uint32_t id) const { return std::ranges::binary_search(divided_, id); }
  bool unresolved(const DetailNode& node, double range) const;
  double most_width(const DetailNode& node, double range) const;
  double most_spread(const DetailNode& node, double range, double cosine_square) const;
  bool may_be_shaded(const DetailNode& node, double range, double cosine_square) const;
  bool holds_cell(const DetailNode& node) const;
  void count(const DetailNode& node, double range, double mean_square, double cosine_square, CutEnergy& energy) const;
  void count(const Eigen::Vector3f& point, const Eigen::Vector3f& normal, float area, CutEnergy& energy) const;
  void add_surfel(const Walked& of, std::uint32_t i, CutPiece& out) const;
  void add_node(const Walked& of, const DetailNode& node, double factor, CutPiece& out) const;

  const SceneCloud& scene_;
  bool noisy_;
  HeadFrame head_;
  SectorBounds sector_;
  double max_range_;
  RangeGate gate_;
  double width_, spacing_, thickness_;
  std::vector<std::uint32_t> divided_{};
  RangeTenths<bool> shaded_{};
};

}  // namespace insonify
