// SPDX-License-Identifier: BSD-3-Clause
#include "sampling/scene_cut.hpp"

#include <atomic>
#include <bit>
#include <cmath>
#include <utility>

#include "core/parallel.hpp"
#include "sampling/gate_surfels_internal.hpp"
#include "scene/detail_levels.hpp"

namespace insonify {
namespace {

using Eigen::Vector3d;

constexpr double most_spread = 0.1;      // of normals, in squares of the cosine of incidence
constexpr double flat_spread = 0.003;    // of normals that curve the surface too little to change what hides what
constexpr double most_thickness = 0.25;  // in cells of range
constexpr float per_thickness = 16;      // how far below a node's plane its surface may lie, as far as its disc reaches
constexpr double half_diagonal = 0.86603;  // of a cube, in its edges, rounded up
constexpr std::size_t blocks_at_once = 16;

/// What stands for the surfels of some blocks.
struct Part {
  SceneCloud scene;
  std::vector<std::uint32_t> stands_for;
};

/// Mean square sine of the angles between a node's normal and those of its surfels.
double spread_of(const DetailNode& node) { return 1 - quadratic_form(node.normals, node.normal.cast<double>()); }

/// Walks down the levels, as far as a head resolves their nodes.
class LevelWalk {
 public:
  LevelWalk(const PreparedScene& prepared, const InsonifiedRegion& region, const BeamFan& fan, const RangeGate& gate,
            const CutOptions& options, const DetailLevels& levels)
      : scene_(prepared.scene()),
        levels_(levels),
        head_(scene_, region.world_from_head),
        sector_(region.sector),
        max_range_(region.gate.max_range),
        gate_(gate),
        width_(options.most_width * fan.beam_width),
        spacing_(options.most_spacing),
        thickness_(most_thickness * options.range_resolution) {}

  /// Adds what stands for a root or child; `inside`: its cell is known to lie within the region.
  void visit(std::uint32_t index, bool inside, Part& out) const {
    if (index < levels_.surfels) return add_surfel(index, out);
    const DetailNode& node = levels_.node[index - levels_.surfels];
    const Vector3d p = head_.position(node.point);
    const double range = p.norm();
    if (range - node.extent > max_range_ || !sector_.holds(p, 2 * hiding_reach * node.extent)) return;
    inside = inside || holds_cell(node);
    if (inside && unresolved(node, range)) {
      const Vector3d direction = head_.axes_of(node.nearest).to_head.transpose() * (p / range);
      const double cosine_square = std::pow(node.normal.cast<double>().dot(direction), 2);
      if (spread_of(node) <= std::min(flat_spread, most_spread * cosine_square))
        return add_node(node, quadratic_form(node.normals, direction) / cosine_square, out);
    }
    for (std::uint32_t k = 0; k < node.children; ++k) visit(levels_.child[node.first_child + k], inside, out);
  }

 private:
  /// Whether the head does not resolve the surfels of a node (E137), and the mean of their law is known.
  bool unresolved(const DetailNode& node, double range) const {
    if (!std::holds_alternative<LambertLaw>(scene_.materials[node.material].law)) return false;
    const double nearest = range - node.extent, farthest = range + node.extent;
    const auto divides = [&](double end) { return nearest < end && end < farthest; };
    if (!(nearest > 0) || std::sqrt(node.area) > std::max(width_ * nearest, spacing_) || node.thickness > thickness_)
      return false;
    return !divides(gate_.min_range) && !divides(gate_.max_range);
  }
  /// Whether the cell of a node lies within the region, whatever surfels of it are loaded.
  bool holds_cell(const DetailNode& node) const {
    const double edge = node.cell, radius = half_diagonal * edge;
    const Vector3d cell = (scene_.point[node.nearest].cast<double>() / edge).array().floor() + 0.5;
    const Vector3d centre = head_.position((cell * edge).cast<float>());
    return centre.norm() + radius <= max_range_ && sector_.holds(centre, -radius);
  }
  void add_surfel(std::uint32_t i, Part& out) const {
    add(scene_.point[i], scene_.normal[i], scene_.area[i], i, out);
    out.scene.unevenness.push_back(std::sqrt(scene_.area[i]));
    if (!scene_.noise.empty()) out.scene.noise.push_back(scene_.noise[i]);
  }
  /// Adds a node whose surfels return `factor` times the energy of a plane with the node's area and normal.
  void add_node(const DetailNode& node, double factor, Part& out) const {
    add(node.point, node.normal, static_cast<float>(factor * node.area), node.nearest, out);
    out.scene.unevenness.push_back(std::sqrt(scene_.area[node.nearest]) + per_thickness * node.thickness);
    if (!scene_.noise.empty()) out.scene.noise.push_back(node.noise);
  }
  void add(const Eigen::Vector3f& point, const Eigen::Vector3f& normal, float area, std::uint32_t stands_for,
           Part& out) const {
    out.scene.point.push_back(point);
    out.scene.normal.push_back(normal);
    out.scene.area.push_back(area);
    out.scene.material.push_back(scene_.material[stands_for]);
    out.scene.id.push_back(scene_.id[stands_for]);
    out.stands_for.push_back(stands_for);
  }

  const SceneCloud& scene_;
  const DetailLevels& levels_;
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
  Ranks(const std::vector<Part>& parts, std::size_t surfels, int threads) {
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

/// Moves the surfels of a part to their places in the cut.
template <typename... Arrays>
void scatter(const SceneCloud& from, const std::vector<std::uint32_t>& places, SceneCloud& to, Arrays... arrays) {
  const auto move = [&](auto array) {
    for (std::size_t k = 0; k < (from.*array).size(); ++k) (to.*array)[places[k]] = (from.*array)[k];
  };
  (move(arrays), ...);
}

}  // namespace

SceneCut cut_scene(const PreparedScene& prepared, const InsonifiedRegion& region, const BeamFan& fan,
                   const RangeGate& gate, const CutOptions& options) {
  const int threads = options.threads;
  const SceneCloud& scene = prepared.scene();
  const DetailLevels& levels = prepared.levels(threads);
  const LevelWalk walk(prepared, region, fan, gate, options, levels);
  std::vector<Part> parts((levels.block.size() + blocks_at_once - 1) / blocks_at_once);
  parallel_blocks(levels.block.size(), blocks_at_once, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t b = begin; b < end; ++b) {
      const DetailBlock& block = levels.block[b];
      const Vector3d centre = scene.origin + block.centre.cast<double>();
      if (!may_intersect(region, centre, block.radius, block.largest_area)) continue;
      for (std::uint32_t k = block.begin; k < block.end; ++k)
        walk.visit(levels.root[k], false, parts[begin / blocks_at_once]);
    }
  });
  // Join the parts in the order of the scene.
  const Ranks ranks(parts, scene.size(), threads);
  SceneCloud cut;
  const auto resize = [&](auto... arrays) { ((cut.*arrays).resize(ranks.all()), ...); };
  resize(&SceneCloud::point, &SceneCloud::normal, &SceneCloud::area, &SceneCloud::material, &SceneCloud::id,
         &SceneCloud::unevenness);
  if (!scene.noise.empty()) resize(&SceneCloud::noise);
  std::vector<std::uint32_t> stands_for(ranks.all()), order(ranks.all());
  std::vector<std::size_t> first{0};
  for (const Part& part : parts) first.push_back(first.back() + part.stands_for.size());
  parallel_for(parts.size(), threads, [&](std::size_t p) {
    std::vector<std::uint32_t> places;
    for (const std::uint32_t surfel : parts[p].stands_for) {
      order[first[p] + places.size()] = ranks.of(surfel);
      places.push_back(ranks.of(surfel));
      stands_for[places.back()] = surfel;
    }
    scatter(parts[p].scene, places, cut, &SceneCloud::point, &SceneCloud::normal, &SceneCloud::area,
            &SceneCloud::material, &SceneCloud::id, &SceneCloud::unevenness, &SceneCloud::noise);
  });
  cut.origin = scene.origin;
  cut.materials = scene.materials;
  cut.normals_oriented = scene.normals_oriented;
  cut.part_of = prepared.whole();
  return {PreparedScene(std::move(cut), std::move(order), threads), std::move(stands_for)};
}

}  // namespace insonify
