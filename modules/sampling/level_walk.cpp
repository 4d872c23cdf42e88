// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <span>

#include "sampling/gate_surfels_internal.hpp"
#include "sampling/level_walk_internal.hpp"

namespace insonify {
namespace {

using Eigen::Vector3d;

constexpr double flat_spread = 0.003;    // largest spread of the normals of the widest nodes
constexpr double steep_spread = 0.008;   // the same, over the squared cosine of incidence
constexpr double most_narrow = 8;        // times: narrower nodes than this may not be still rougher
constexpr double most_thickness = 0.25;  // in cells of range
constexpr float per_thickness = 16;      // how far below a node's plane its surface may lie, as far as its disc reaches
constexpr double half_diagonal = 0.86603;  // half the diagonal of a cube over its edge, rounded up

// Nodes in relief that hides itself (E225).
constexpr double largest_square = 2;  // largest square of a wave's slope over the mean square
constexpr double turned_square = largest_square * most_narrow * flat_spread;  // squared cosine where relief turns away
constexpr double lit_square = 4 * turned_square;  // the lit side of such a wave has twice the cosine
constexpr double narrow_width = 0.04;             // width of nodes there over the largest width

/// Mean square sine of the angles between a node's normal and those of its surfels.
double spread_of(const DetailNode& node) { return 1 - quadratic_form(node.normals, node.normal.cast<double>()); }

/// Energy of a node's surfels over that of a plane, whose cosines have these mean squares; within 0.5 and 2, since both
/// are rounding where the plane is seen edge-on.
double factor_of(double of_surfels, double of_plane) {
  return of_plane > 0 ? std::clamp(of_surfels / of_plane, 0.5, 2.0) : 1;
}

void add(const Eigen::Vector3f& point, const Eigen::Vector3f& normal, float area, std::uint16_t material,
         CutPiece& out) {
  out.scene.point.push_back(point);
  out.scene.normal.push_back(normal);
  out.scene.area.push_back(area);
  out.scene.material.push_back(material);
}

}  // namespace

LevelWalk::LevelWalk(const SceneCloud& scene, bool noisy, const InsonifiedRegion& region, const BeamFan& fan,
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

bool LevelWalk::changes(const CutPiece& piece) const {
  for (std::size_t t = 0; t < shaded_.size(); ++t)
    if (shaded_[t] && piece.energy.all[t] > 0) return true;
  return std::ranges::any_of(piece.stands_for, [&](std::uint32_t id) { return divides(id); });
}

void LevelWalk::visit(const Walked& of, std::uint32_t index, bool inside, CutPiece& out, bool divided) const {
  if (index < of.levels.surfels) return add_surfel(of, index, out);
  if (of.piece) of.piece->need_node(index - of.levels.surfels);
  const DetailNode& node = of.levels.node[index - of.levels.surfels];
  if (!of.piece) __builtin_prefetch(&of.scene.id[node.nearest]);
  if (node.children == 0) {
    count(node.point, node.normal, node.area, out.energy);
    return add_node(of, node, 1, out);
  }
  const Vector3d p = head_.position(node.point);
  const double range = p.norm();
  if (range - node.extent > max_range_ || !sector_.holds(p, 2 * hiding_reach * node.extent)) return;
  inside = inside || holds_cell(node);
  if (inside && !divided && unresolved(node, range)) {
    const Vector3d direction = head_.to_head().transpose() * (p / range);
    const double cosine_square = std::pow(node.normal.cast<double>().dot(direction), 2);
    if (spread_of(node) <= most_spread(node, range, cosine_square) && !may_be_shaded(node, range, cosine_square)) {
      divided = !divided_.empty() && divides(of.piece ? node.nearest : of.scene.id[node.nearest]);
      if (!divided) {
        const double mean_square = quadratic_form(node.normals, direction);
        count(node, range, mean_square, cosine_square, out.energy);
        return add_node(of, node, factor_of(mean_square, cosine_square), out);
      }
    }
  }
  const std::span children = std::span(of.levels.child).subspan(node.first_child, node.children);
  if (!of.piece)
    for (const std::uint32_t child : children) prefetch(of, child);
  for (const std::uint32_t child : children) visit(of, child, inside, out, divided);
}

/// Returns true if the head does not resolve the surfels of a node (E137), and the mean of their law is known.
bool LevelWalk::unresolved(const DetailNode& node, double range) const {
  if (!traits_of(scene_.materials[node.material].law).merges) return false;
  const double nearest = range - node.extent, farthest = range + node.extent;
  const auto divides = [&](double end) { return nearest < end && end < farthest; };
  if (!(nearest > 0) || std::sqrt(node.area) > most_width(node, range) || node.thickness > thickness_) return false;
  return !divides(gate_.min_range) && !divides(gate_.max_range);
}

double LevelWalk::most_width(const DetailNode& node, double range) const {
  return std::max(width_ * (range - node.extent), spacing_);
}

/// How rough a node may be (E137): many narrow ones share a beam, and their errors average out. Nodes of one width at
/// all ranges do not depend on where they are seen from.
double LevelWalk::most_spread(const DetailNode& node, double range, double cosine_square) const {
  const double narrow = std::min(most_width(node, range) / std::sqrt(node.area), most_narrow);
  return narrow * (width_ > 0 ? std::max(flat_spread, steep_spread * cosine_square) : flat_spread);
}

/// Returns true if a node is too wide for where relief hides itself (E225): a shadow may end on it, or it may end one.
bool LevelWalk::may_be_shaded(const DetailNode& node, double range, double cosine_square) const {
  return cosine_square < lit_square && shaded_[tenth_of(range, max_range_)] &&
         std::sqrt(node.area) > narrow_width * most_width(node, range);
}

/// Adds the energy of a node, whose surfels have cosines of incidence of this mean square.
/// Its relief turns away if slopes of a wave, which reach sqrt(2) times their root of the mean square, would (E225).
void LevelWalk::count(const DetailNode& node, double range, double mean_square, double cosine_square,
                      CutEnergy& energy) const {
  const std::size_t tenth = tenth_of(range, max_range_);
  const double square_of_mean = (1 - spread_of(node)) * cosine_square;
  energy.all[tenth] += node.area * mean_square;
  if (largest_square * (mean_square - square_of_mean) > square_of_mean &&
      std::sqrt(node.area) * most_narrow > most_width(node, range))
    energy.turned[tenth] += node.area * mean_square;
}

/// Adds the energy of a surfel in the region.
void LevelWalk::count(const Eigen::Vector3f& point, const Eigen::Vector3f& normal, float area,
                      CutEnergy& energy) const {
  const Vector3d p = head_.position(point);
  const double range = p.norm();
  if (!(range > 0) || range > max_range_ || !sector_.holds(p)) return;
  energy.all[tenth_of(range, max_range_)] += area * std::pow(head_.direction(normal.cast<double>()).dot(p / range), 2);
}

/// Returns true if the cell of a node lies within the region, whatever surfels of it are loaded.
bool LevelWalk::holds_cell(const DetailNode& node) const {
  const double edge = node.cell, radius = half_diagonal * edge;
  const Vector3d cell = (node.position.cast<double>() / edge).array().floor() + 0.5;
  const Vector3d centre = head_.position((cell * edge).cast<float>());
  return centre.norm() + radius <= max_range_ && sector_.holds(centre, -radius);
}

void LevelWalk::add_surfel(const Walked& of, std::uint32_t i, CutPiece& out) const {
  if (of.piece) of.piece->need_surfel(i);
  const SceneCloud& s = of.scene;
  add(s.point[i], s.normal[i], s.area[i], s.material[i], out);
  count(s.point[i], s.normal[i], s.area[i], out.energy);
  out.scene.unevenness.push_back(std::sqrt(s.area[i]));
  if (noisy_) out.scene.noise.push_back(s.noise[i]);
  out.scene.id.push_back(s.id[i]);
  out.stands_for.push_back(of.piece ? s.id[i] : i);
}

/// Adds a node whose surfels return `factor` times the energy of a plane with the node's area and normal.
void LevelWalk::add_node(const Walked& of, const DetailNode& node, double factor, CutPiece& out) const {
  add(node.point, node.normal, static_cast<float>(factor * node.area), node.material, out);
  out.scene.unevenness.push_back(std::sqrt(node.own_area) + per_thickness * node.thickness);
  if (noisy_) out.scene.noise.push_back(node.noise);
  out.scene.id.push_back(of.piece ? node.nearest : of.scene.id[node.nearest]);
  out.stands_for.push_back(node.nearest);
}

}  // namespace insonify
