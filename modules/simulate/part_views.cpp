// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "core/units.hpp"
#include "simulate/part_views_internal.hpp"

namespace insonify {
namespace {

using Eigen::Vector3d;

/// A position of a surface in head axes.
struct ViewedPoint {
  Direction direction;
  double range;         ///< [m]
  double beam_azimuth;  ///< azimuth of the beam that receives it [rad]
};

Pose pose_of_file(const ScenePart& part) { return part.world_from_part * Eigen::Translation3d(part.file_origin); }

/// A part of which nothing is seen.
PartView unseen(const ScenePart& part) {
  PartView view{pose_of_file(part)};
  if (part.own) view.scale = part.scale, view.size = part.size;
  return view;
}

class PartViewer {
 public:
  explicit PartViewer(const ResolvedPing& ping) : ping_(ping), head_from_world_(ping.view.world_from_head.inverse()) {
    const auto [least, most] = std::minmax_element(ping.head.fan.azimuth.begin(), ping.head.fan.azimuth.end());
    for (const FanRow& row : fan_rows(ping.head.fan)) rows_.push_back(row.elevation);
    least_azimuth_ = *least - 0.5 * ping.head.fan.beam_width, most_azimuth_ = *most + 0.5 * ping.head.fan.beam_width;
  }

  /// View of a part, of a scene without the other parts.
  /// seen   1 of each surfel that the head sees among all parts
  PartView view_of(const ScenePart& part, const SceneCloud& alone, const std::vector<std::uint8_t>& seen) const {
    PartView view = unseen(part);
    const View& look = ping_.view;
    const auto visibility = find_visibility(alone, look.world_from_head, look.fan, look.gate,
                                            std::vector<std::uint8_t>(alone.size(), 1), look.sampling);
    double all = 0, shown = 0;
    if (!part.own->facet.empty()) widen_by_facets(part, alone.id, view);
    const bool of_discs = std::isnan(view.range.least);
    for (std::size_t k = 0; k < alone.size(); ++k) {
      if (visibility[k] != Visibility::seen) continue;
      const Vector3d position = head_from_world_ * (alone.origin + alone.point[k].cast<double>());
      if (!in_fan(seen_at(position))) continue;
      const double solid_angle = solid_angle_of(alone, k, position);
      all += solid_angle;
      if (seen[k]) shown += solid_angle;
      if (of_discs) widen(position, view);
    }
    if (all > 0) view.visible_share = shown / all;  // (E147)
    return view;
  }

 private:
  /// Widens a view by what the head sees of some triangles of a part: discs of surfels stick out beyond the edge of a
  /// face, where they would hide one that is nearly edge-on. Its corners bound a triangle as far as they are in the
  /// fan.
  void widen_by_facets(const ScenePart& part, const std::vector<std::uint32_t>& surfels, PartView& view) const {
    const SceneCloud own = subset(*part.own, surfels);
    const View& look = ping_.view;
    const auto visibility = find_visibility(own, part.world_from_part.inverse() * look.world_from_head, look.fan,
                                            look.gate, std::vector<std::uint8_t>(own.size(), 1), look.sampling);
    const Pose head_from_part = head_from_world_ * part.world_from_part;
    const auto widen_at = [&](const Eigen::Vector3f& point) {
      widen(head_from_part * (own.origin + point.cast<double>()), view);
    };
    for (std::size_t k = 0; k < own.size(); ++k) {
      if (visibility[k] != Visibility::seen) continue;
      widen_at(own.point[k]);
      for (const Eigen::Vector3f& corner : own.facet[k]) widen_at(corner);
    }
  }
  double solid_angle_of(const SceneCloud& scene, std::size_t i, const Vector3d& position) const {
    const double range = position.norm();
    const double cosine = std::abs((head_from_world_.linear() * scene.normal[i].cast<double>()).dot(position)) / range;
    return cosine * static_cast<double>(scene.area[i]) / (range * range);
  }
  ViewedPoint seen_at(const Vector3d& position) const {
    const Direction direction = direction_of(position);
    return {direction, position.norm(), beam_azimuth(position, direction.elevation)};
  }
  /// The azimuth of the beam of the nearest row whose cone holds a position.
  double beam_azimuth(const Eigen::Vector3d& position, double elevation) const {
    double row = rows_.front();
    for (const double other : rows_)
      if (std::abs(other - elevation) < std::abs(row - elevation)) row = other;
    const double cone = std::asin(std::clamp(position.y() / (position.norm() * std::cos(row)), -1.0, 1.0));
    return position.x() < 0 ? std::copysign(pi, cone) - cone : cone;
  }
  bool in_fan(const ViewedPoint& s) const {
    return s.beam_azimuth >= least_azimuth_ && s.beam_azimuth <= most_azimuth_ &&
           s.range >= ping_.head.gate.min_range && s.range <= ping_.head.gate.max_range;
  }
  /// Widens a view by a position in head axes, if the fan holds it.
  void widen(const Vector3d& position, PartView& view) const {
    const ViewedPoint s = seen_at(position);
    if (!in_fan(s)) return;
    widen(view.azimuth, s.direction.azimuth);
    widen(view.elevation, s.direction.elevation);
    widen(view.range, s.range);
    widen(view.beam_azimuth, s.beam_azimuth);
    widen(view.ahead, s.range * std::cos(s.beam_azimuth));
    widen(view.port, s.range * std::sin(s.beam_azimuth));
  }
  static void widen(PartView::Extent& extent, double value) {
    extent.least = std::fmin(extent.least, value), extent.most = std::fmax(extent.most, value);
  }

  const ResolvedPing& ping_;
  Pose head_from_world_;
  double least_azimuth_, most_azimuth_;
  std::vector<double> rows_;  // elevations of the beams
};

}  // namespace

std::vector<PartView> part_views(const SceneCloud& scene, const std::vector<std::uint8_t>& seen,
                                 const ResolvedPing& ping) {
  // One copy of all placed surfels without the lists of parts and materials, and the rows of each part in it.
  std::vector<std::vector<std::uint32_t>> rows(scene.parts.size());
  std::vector<std::uint32_t> placed;
  for (std::uint32_t i = 0; i < scene.part.size(); ++i) {
    if (!scene.parts[scene.part[i]].own) continue;
    rows[scene.part[i]].push_back(static_cast<std::uint32_t>(placed.size()));
    placed.push_back(i);
  }
  SceneCloud bodies = subset(scene, placed);
  bodies.parts.clear(), bodies.part.clear(), bodies.materials.clear();

  const PartViewer viewer(ping);
  std::vector<PartView> views;
  for (std::size_t p = 0; p < rows.size(); ++p) {
    views.push_back(unseen(scene.parts[p]));
    if (rows[p].empty()) continue;
    SceneCloud alone = subset(bodies, rows[p]);
    alone.parts = {scene.parts[p]}, alone.part.assign(alone.size(), 0);
    std::vector<std::uint8_t> seen_here;
    for (const std::uint32_t row : rows[p]) seen_here.push_back(seen[placed[row]]);
    views.back() = viewer.view_of(scene.parts[p], alone, seen_here);
  }
  return views;
}

}  // namespace insonify
