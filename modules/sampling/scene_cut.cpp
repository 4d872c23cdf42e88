// SPDX-License-Identifier: BSD-3-Clause
#include "sampling/scene_cut.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "core/parallel.hpp"
#include "core/vector_functions.hpp"
#include "sampling/cut_pieces_internal.hpp"
#include "sampling/gate_surfels_internal.hpp"
#include "sampling/silhouettes_internal.hpp"
#include "scene/detail_levels.hpp"

namespace insonify {
namespace {

using Eigen::Vector3d;

constexpr double flat_spread = 0.003;    // of normals of a node as wide as may be
constexpr double steep_spread = 0.008;   // of such a node, in squares of the cosine of incidence
constexpr double most_narrow = 8;        // times: narrower nodes than this may not be still rougher
constexpr double most_thickness = 0.25;  // in cells of range
constexpr float per_thickness = 16;      // how far below a node's plane its surface may lie, as far as its disc reaches
constexpr double half_diagonal = 0.86603;  // of a cube, in its edges, rounded up
constexpr std::size_t blocks_at_once = 16;
constexpr std::uint32_t roots_ahead = 4;  // that are loaded into the cache
constexpr double per_node = 20;           // directions across the widest node, in which silhouettes are looked for
constexpr std::size_t many_surfels =
    1 << 19;  // scenes without noise of so many surfels and more have coarse silhouettes

/// Mean square sine of the angles between a node's normal and those of its surfels.
double spread_of(const DetailNode& node) { return 1 - quadratic_form(node.normals, node.normal.cast<double>()); }

/// Energy of a node's surfels over that of a plane, whose cosines have these mean squares; within 0.5 and 2, since both
/// are rounding where the plane is seen edge-on.
double factor_of(double of_surfels, double of_plane) {
  return of_plane > 0 ? std::clamp(of_surfels / of_plane, 0.5, 2.0) : 1;
}

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
            const RangeGate& gate, const CutOptions& options)
      : scene_(scene),
        noisy_(noisy),
        head_(scene_, region.world_from_head),
        sector_(region.sector),
        max_range_(region.gate.max_range),
        gate_(gate),
        width_(options.most_width * fan.beam_width),
        spacing_(options.most_spacing),
        thickness_(most_thickness * options.range_resolution) {}

  /// Divides the nodes that stand for surfels of these ids (ascending) down to surfels.
  void divide(std::vector<std::uint32_t> divided) { divided_ = std::move(divided); }
  bool divides(std::uint32_t id) const { return std::ranges::binary_search(divided_, id); }

  /// Adds what stands for a root or child; `inside`: its cell is known to lie within the region; `divided`: it belongs
  /// to a node that is divided.
  void visit(const Walked& of, std::uint32_t index, bool inside, CutPiece& out, bool divided = false) const {
    if (index < of.levels.surfels) return add_surfel(of, index, out);
    if (of.piece) of.piece->need_node(index - of.levels.surfels);
    const DetailNode& node = of.levels.node[index - of.levels.surfels];
    if (!of.piece) __builtin_prefetch(&of.scene.id[node.nearest]);
    if (node.children == 0) return add_node(of, node, 1, out);
    const Vector3d p = head_.position(node.point);
    const double range = p.norm();
    if (range - node.extent > max_range_ || !sector_.holds(p, 2 * hiding_reach * node.extent)) return;
    inside = inside || holds_cell(node);
    if (inside && !divided && unresolved(node, range)) {
      const Vector3d direction = head_.to_head().transpose() * (p / range);
      const double cosine_square = std::pow(node.normal.cast<double>().dot(direction), 2);
      if (spread_of(node) <= most_spread(node, range, cosine_square)) {
        divided = !divided_.empty() && divides(of.piece ? node.nearest : of.scene.id[node.nearest]);
        if (!divided) return add_node(of, node, factor_of(quadratic_form(node.normals, direction), cosine_square), out);
      }
    }
    const std::span children = std::span(of.levels.child).subspan(node.first_child, node.children);
    if (!of.piece)
      for (const std::uint32_t child : children) prefetch(of, child);
    for (const std::uint32_t child : children) visit(of, child, inside, out, divided);
  }

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
  /// Returns true if the head does not resolve the surfels of a node (E137), and the mean of their law is known.
  bool unresolved(const DetailNode& node, double range) const {
    if (!traits_of(scene_.materials[node.material].law).merges) return false;
    const double nearest = range - node.extent, farthest = range + node.extent;
    const auto divides = [&](double end) { return nearest < end && end < farthest; };
    if (!(nearest > 0) || std::sqrt(node.area) > most_width(node, range) || node.thickness > thickness_) return false;
    return !divides(gate_.min_range) && !divides(gate_.max_range);
  }
  double most_width(const DetailNode& node, double range) const {
    return std::max(width_ * (range - node.extent), spacing_);
  }
  /// How rough a node may be (E137): many narrow ones share a beam, and their errors average out. Nodes of one width at
  /// all ranges do not depend on where they are seen from.
  double most_spread(const DetailNode& node, double range, double cosine_square) const {
    const double narrow = std::min(most_width(node, range) / std::sqrt(node.area), most_narrow);
    return narrow * (width_ > 0 ? std::max(flat_spread, steep_spread * cosine_square) : flat_spread);
  }
  /// Returns true if the cell of a node lies within the region, whatever surfels of it are loaded.
  bool holds_cell(const DetailNode& node) const {
    const double edge = node.cell, radius = half_diagonal * edge;
    const Vector3d cell = (node.position.cast<double>() / edge).array().floor() + 0.5;
    const Vector3d centre = head_.position((cell * edge).cast<float>());
    return centre.norm() + radius <= max_range_ && sector_.holds(centre, -radius);
  }
  void add_surfel(const Walked& of, std::uint32_t i, CutPiece& out) const {
    if (of.piece) of.piece->need_surfel(i);
    const SceneCloud& s = of.scene;
    add(s.point[i], s.normal[i], s.area[i], s.material[i], out);
    out.scene.unevenness.push_back(std::sqrt(s.area[i]));
    if (noisy_) out.scene.noise.push_back(s.noise[i]);
    out.scene.id.push_back(s.id[i]);
    out.stands_for.push_back(of.piece ? s.id[i] : i);
  }
  /// Adds a node whose surfels return `factor` times the energy of a plane with the node's area and normal.
  void add_node(const Walked& of, const DetailNode& node, double factor, CutPiece& out) const {
    add(node.point, node.normal, static_cast<float>(factor * node.area), node.material, out);
    out.scene.unevenness.push_back(std::sqrt(node.own_area) + per_thickness * node.thickness);
    if (noisy_) out.scene.noise.push_back(node.noise);
    out.scene.id.push_back(of.piece ? node.nearest : of.scene.id[node.nearest]);
    out.stands_for.push_back(node.nearest);
  }
  static void add(const Eigen::Vector3f& point, const Eigen::Vector3f& normal, float area, std::uint16_t material,
                  CutPiece& out) {
    out.scene.point.push_back(point);
    out.scene.normal.push_back(normal);
    out.scene.area.push_back(area);
    out.scene.material.push_back(material);
  }

  const SceneCloud& scene_;
  bool noisy_;
  HeadFrame head_;
  SectorBounds sector_;
  double max_range_;
  RangeGate gate_;
  double width_, spacing_, thickness_;
  std::vector<std::uint32_t> divided_{};
};

/// Returns true if nodes at silhouettes are divided (E172). Nodes of one spacing do not depend on where they are seen
/// from.
bool has_sharp_silhouettes(const CutOptions& options, bool noisy, const WholeScene& whole) {
  return options.most_width > 0 && !(options.most_spacing > 0) && (noisy || whole.surfels < many_surfels);
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
    if (!first && std::ranges::none_of(piece.stands_for, [&](std::uint32_t id) { return walk.divides(id); })) return;
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
  const auto cut_now = [&] {
    return OrderedCut(walked(walk, scene, levels, region, options.threads), scene, options.threads);
  };
  OrderedCut found = cut_now();
  if (has_sharp_silhouettes(options, !scene.noise.empty(), prepared.whole())) {
    if (std::vector<std::uint32_t> divided = divided_of(found.cut, region, fan, options); !divided.empty()) {
      walk.divide(std::move(divided));
      found = cut_now();
    }
  }
  found.cut.part_of = prepared.whole();
  return {PreparedScene(std::move(found.cut), std::move(found.order), options.threads), std::move(found.stands_for)};
}

SceneCloud cut_levels(const LevelSource& source, const InsonifiedRegion& region, const BeamFan& fan,
                      const RangeGate& gate, const CutOptions& options) {
  LevelWalk walk(source.like(), source.noisy(), region, fan, gate, options);
  WalkedPieces pieces;
  const auto cut_now = [&] {
    walk_pieces(walk, source, options.threads, pieces);
    return joined_by_id(pieces.pieces, source.like(), source.noisy(), options.threads);
  };
  SceneCloud cut = cut_now();
  if (has_sharp_silhouettes(options, source.noisy(), *source.like().part_of)) {
    if (std::vector<std::uint32_t> divided = divided_of(cut, region, fan, options); !divided.empty()) {
      walk.divide(std::move(divided));
      cut = cut_now();
    }
  }
  cut.part_of = source.like().part_of;
  return cut;
}

}  // namespace insonify
