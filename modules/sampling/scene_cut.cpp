// SPDX-License-Identifier: BSD-3-Clause
#include "sampling/scene_cut.hpp"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <span>
#include <utility>

#include "core/parallel.hpp"
#include "core/radix_sort.hpp"
#include "sampling/gate_surfels_internal.hpp"
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

/// What stands for the surfels of some blocks.
struct CutPart {
  SceneCloud scene;
  std::vector<std::uint32_t> stands_for;
};

/// Mean square sine of the angles between a node's normal and those of its surfels.
double spread_of(const DetailNode& node) { return 1 - quadratic_form(node.normals, node.normal.cast<double>()); }

/// Energy of a node's surfels over that of a plane, whose cosines have these mean squares; within 0.5 and 2, since both
/// are rounding where the plane is seen edge-on.
double factor_of(double of_surfels, double of_plane) {
  return of_plane > 0 ? std::clamp(of_surfels / of_plane, 0.5, 2.0) : 1;
}

/// What is walked: levels of a scene, whole or loaded on the way.
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

  /// Adds what stands for a root or child; `inside`: its cell is known to lie within the region.
  void visit(const Walked& of, std::uint32_t index, bool inside, CutPart& out) const {
    if (index < of.levels.surfels) return add_surfel(of, index, out);
    if (of.piece) of.piece->need_node(index - of.levels.surfels);
    const DetailNode& node = of.levels.node[index - of.levels.surfels];
    if (node.children == 0) return add_node(of, node, 1, out);
    const Vector3d p = head_.position(node.point);
    const double range = p.norm();
    if (range - node.extent > max_range_ || !sector_.holds(p, 2 * hiding_reach * node.extent)) return;
    inside = inside || holds_cell(node);
    if (inside && unresolved(node, range)) {
      const Vector3d direction = head_.to_head().transpose() * (p / range);
      const double cosine_square = std::pow(node.normal.cast<double>().dot(direction), 2);
      if (spread_of(node) <= most_spread(node, range, cosine_square))
        return add_node(of, node, factor_of(quadratic_form(node.normals, direction), cosine_square), out);
    }
    for (std::uint32_t k = 0; k < node.children; ++k) visit(of, of.levels.child[node.first_child + k], inside, out);
  }

 private:
  /// Whether the head does not resolve the surfels of a node (E137), and the mean of their law is known.
  bool unresolved(const DetailNode& node, double range) const {
    if (!std::holds_alternative<LambertLaw>(scene_.materials[node.material].law)) return false;
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
  /// Whether the cell of a node lies within the region, whatever surfels of it are loaded.
  bool holds_cell(const DetailNode& node) const {
    const double edge = node.cell, radius = half_diagonal * edge;
    const Vector3d cell = (node.place.cast<double>() / edge).array().floor() + 0.5;
    const Vector3d centre = head_.position((cell * edge).cast<float>());
    return centre.norm() + radius <= max_range_ && sector_.holds(centre, -radius);
  }
  void add_surfel(const Walked& of, std::uint32_t i, CutPart& out) const {
    if (of.piece) of.piece->need_surfel(i);
    const SceneCloud& s = of.scene;
    add(s.point[i], s.normal[i], s.area[i], s.material[i], out);
    out.scene.unevenness.push_back(std::sqrt(s.area[i]));
    if (noisy_) out.scene.noise.push_back(s.noise[i]);
    out.scene.id.push_back(s.id[i]);
    out.stands_for.push_back(of.piece ? s.id[i] : i);
  }
  /// Adds a node whose surfels return `factor` times the energy of a plane with the node's area and normal.
  void add_node(const Walked& of, const DetailNode& node, double factor, CutPart& out) const {
    add(node.point, node.normal, static_cast<float>(factor * node.area), node.material, out);
    out.scene.unevenness.push_back(std::sqrt(node.own_area) + per_thickness * node.thickness);
    if (noisy_) out.scene.noise.push_back(node.noise);
    out.scene.id.push_back(of.piece ? node.nearest : of.scene.id[node.nearest]);
    out.stands_for.push_back(node.nearest);
  }
  static void add(const Eigen::Vector3f& point, const Eigen::Vector3f& normal, float area, std::uint16_t material,
                  CutPart& out) {
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
};

/// The ranks of marked surfels: their indices in a cut, which keeps the order of the scene however its surfels are
/// arranged in levels.
class Ranks {
 public:
  Ranks(const std::vector<CutPart>& parts, std::size_t surfels, int threads) {
    marks_.words.resize((surfels + 63) / 64);
    parallel_for(parts.size(), threads, [&](std::size_t p) {
      for (const std::uint32_t i : parts[p].stands_for)
        std::atomic_ref(marks_.words[i / 64]).fetch_or(std::uint64_t{1} << i % 64, std::memory_order_relaxed);
    });
    before_.reserve(marks_.words.size());
    for (const std::uint64_t word : marks_.words) {
      before_.push_back(all_);
      all_ += static_cast<std::uint32_t>(std::popcount(word));
    }
  }
  std::size_t all() const { return all_; }
  std::uint32_t of(std::uint32_t surfel) const {
    const std::uint64_t below = marks_.words[surfel / 64] & ((std::uint64_t{1} << surfel % 64) - 1);
    return before_[surfel / 64] + static_cast<std::uint32_t>(std::popcount(below));
  }

 private:
  SurfelMarks marks_;
  std::vector<std::uint32_t> before_;  // each word
  std::uint32_t all_ = 0;
};

/// First numbers of the surfels of each part, and the number of all.
std::vector<std::size_t> firsts_of(const std::vector<CutPart>& parts) {
  std::vector<std::size_t> first{0};
  for (const CutPart& part : parts) first.push_back(first.back() + part.stands_for.size());
  return first;
}

/// Moves the surfels of a part to their places in the cut.
template <typename... Arrays>
void scatter(const SceneCloud& from, std::span<const std::uint32_t> places, SceneCloud& to, Arrays... arrays) {
  const auto move = [&](auto array) {
    for (std::size_t k = 0; k < (from.*array).size(); ++k) (to.*array)[places[k]] = (from.*array)[k];
  };
  (move(arrays), ...);
}

/// The parts as one scene with all but the surfels of `like`. `places`: in it, of the surfels of all parts.
SceneCloud joined(const std::vector<CutPart>& parts, const std::vector<std::uint32_t>& places, const SceneCloud& like,
                  bool noisy, int threads) {
  SceneCloud cut;
  const auto resize = [&](auto... arrays) { ((cut.*arrays).resize(places.size()), ...); };
  resize(&SceneCloud::point, &SceneCloud::normal, &SceneCloud::area, &SceneCloud::material, &SceneCloud::id,
         &SceneCloud::unevenness);
  if (noisy) resize(&SceneCloud::noise);
  const std::vector<std::size_t> first = firsts_of(parts);
  parallel_for(parts.size(), threads, [&](std::size_t p) {
    scatter(parts[p].scene, std::span(places).subspan(first[p], first[p + 1] - first[p]), cut, &SceneCloud::point,
            &SceneCloud::normal, &SceneCloud::area, &SceneCloud::material, &SceneCloud::id, &SceneCloud::unevenness,
            &SceneCloud::noise);
  });
  cut.origin = like.origin;
  cut.materials = like.materials;
  cut.normals_oriented = like.normals_oriented;
  return cut;
}

}  // namespace

SceneCut cut_scene(const PreparedScene& prepared, const InsonifiedRegion& region, const BeamFan& fan,
                   const RangeGate& gate, const CutOptions& options) {
  const int threads = options.threads;
  const SceneCloud& scene = prepared.scene();
  const DetailLevels& levels = prepared.levels(threads);
  const bool noisy = !scene.noise.empty();
  const LevelWalk walk(scene, noisy, region, fan, gate, options);
  std::vector<CutPart> parts((levels.block.size() + blocks_at_once - 1) / blocks_at_once);
  parallel_blocks(levels.block.size(), blocks_at_once, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t b = begin; b < end; ++b) {
      const DetailBlock& block = levels.block[b];
      const Vector3d centre = scene.origin + block.centre.cast<double>();
      if (!may_intersect(region, centre, block.radius, block.largest_area)) continue;
      for (std::uint32_t k = block.begin; k < block.end; ++k)
        walk.visit({scene, levels}, levels.root[k], false, parts[begin / blocks_at_once]);
    }
  });
  // Join the parts in the order of the scene.
  const Ranks ranks(parts, scene.size(), threads);
  std::vector<std::uint32_t> stands_for(ranks.all()), order(ranks.all());
  const std::vector<std::size_t> first = firsts_of(parts);
  parallel_for(parts.size(), threads, [&](std::size_t p) {
    for (std::size_t k = 0; k < parts[p].stands_for.size(); ++k) {
      const std::uint32_t surfel = parts[p].stands_for[k];
      order[first[p] + k] = ranks.of(surfel);
      stands_for[order[first[p] + k]] = surfel;
    }
  });
  SceneCloud cut = joined(parts, order, scene, noisy, threads);
  cut.part_of = prepared.whole();
  return {PreparedScene(std::move(cut), std::move(order), threads), std::move(stands_for)};
}

SceneCloud cut_levels(const LevelSource& source, const InsonifiedRegion& region, const BeamFan& fan,
                      const RangeGate& gate, const CutOptions& options) {
  const LevelWalk walk(source.like(), source.noisy(), region, fan, gate, options);
  std::vector<CutPart> parts(source.pieces());
  parallel_for(parts.size(), options.threads, [&](std::size_t p) {
    const std::unique_ptr<LoadedLevels> piece = source.open(p);
    const Walked of{piece->scene, piece->levels, piece.get()};
    for (const std::uint32_t root : piece->levels.root) walk.visit(of, root, false, parts[p]);
    source.note(parts[p].stands_for.size());
  });
  // Join the parts by ascending id.
  std::vector<std::uint64_t> by_id;  // id, number in the order of the parts
  for (const CutPart& part : parts)
    for (const std::uint32_t id : part.stands_for) by_id.push_back(std::uint64_t{id} << 32 | by_id.size());
  radix_sort(by_id, 32, 64, [](std::uint64_t k) { return k; });
  std::vector<std::uint32_t> order(by_id.size());
  for (std::size_t k = 0; k < by_id.size(); ++k)
    order[static_cast<std::uint32_t>(by_id[k])] = static_cast<std::uint32_t>(k);
  SceneCloud cut = joined(parts, order, source.like(), source.noisy(), options.threads);
  cut.part_of = source.like().part_of;
  return cut;
}

}  // namespace insonify
