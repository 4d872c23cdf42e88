// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "simulate/part_views_internal.hpp"

namespace insonify {
namespace {

using Eigen::Vector3d;

/// A surfel in head axes.
struct SeenSurfel {
  Direction direction;
  double range, solid_angle;  ///< [m], [sr]
};

class PartViewer {
 public:
  PartViewer(const SceneCloud& scene, const std::vector<std::uint8_t>& seen, const ResolvedPing& ping)
      : scene_(scene), seen_(seen), ping_(ping), head_from_world_(ping.view.world_from_head.inverse()) {
    const auto [least, most] = std::minmax_element(ping.head.fan.azimuth.begin(), ping.head.fan.azimuth.end());
    least_azimuth_ = *least - 0.5 * ping.head.fan.beam_width, most_azimuth_ = *most + 0.5 * ping.head.fan.beam_width;
  }

  /// A part of which the scene has these surfels.
  PartView view_of(const ScenePart& part, const std::vector<std::uint32_t>& surfels) const {
    PartView view{part.world_from_part};
    if (!part.own || surfels.empty()) return view;
    const SceneCloud alone = subset(scene_, surfels);
    const View& look = ping_.view;
    const auto visibility = find_visibility(alone, look.world_from_head, look.fan, look.gate,
                                            std::vector<std::uint8_t>(alone.size(), 1), look.sampling);
    double all = 0, shown = 0;
    for (std::size_t k = 0; k < surfels.size(); ++k) {
      if (visibility[k] != Visibility::seen) continue;
      const SeenSurfel surfel = in_head_axes(surfels[k]);
      if (!in_fan(surfel)) continue;
      all += surfel.solid_angle;
      if (seen_[surfels[k]]) shown += surfel.solid_angle;
      widen(view.azimuth, surfel.direction.azimuth);
      widen(view.elevation, surfel.direction.elevation);
      widen(view.range, surfel.range);
    }
    if (all > 0) view.visible_share = shown / all;  // (E147)
    return view;
  }

 private:
  SeenSurfel in_head_axes(std::uint32_t i) const {
    const Vector3d place = head_from_world_ * (scene_.origin + scene_.point[i].cast<double>());
    const double range = place.norm();
    const double cosine = std::abs((head_from_world_.linear() * scene_.normal[i].cast<double>()).dot(place)) / range;
    return {direction_of(place), range, cosine * static_cast<double>(scene_.area[i]) / (range * range)};
  }
  bool in_fan(const SeenSurfel& s) const {
    return s.direction.azimuth >= least_azimuth_ && s.direction.azimuth <= most_azimuth_ &&
           s.range >= ping_.head.gate.min_range && s.range <= ping_.head.gate.max_range;
  }
  static void widen(PartView::Extent& extent, double value) {
    extent.least = std::fmin(extent.least, value), extent.most = std::fmax(extent.most, value);
  }

  const SceneCloud& scene_;
  const std::vector<std::uint8_t>& seen_;
  const ResolvedPing& ping_;
  Pose head_from_world_;
  double least_azimuth_, most_azimuth_;
};

}  // namespace

std::vector<PartView> part_views(const SceneCloud& scene, const std::vector<std::uint8_t>& seen,
                                 const ResolvedPing& ping) {
  std::vector<std::vector<std::uint32_t>> surfels(scene.parts.size());
  for (std::uint32_t i = 0; i < scene.part.size(); ++i)
    if (scene.parts[scene.part[i]].own) surfels[scene.part[i]].push_back(i);
  const PartViewer viewer(scene, seen, ping);
  std::vector<PartView> views;
  for (std::size_t p = 0; p < surfels.size(); ++p) views.push_back(viewer.view_of(scene.parts[p], surfels[p]));
  return views;
}

}  // namespace insonify
