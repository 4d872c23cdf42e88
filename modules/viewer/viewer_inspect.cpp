// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/text.hpp"
#include "core/units.hpp"
#include "sampling/find_holes.hpp"
#include "sampling/find_scatterers.hpp"
#include "sampling/gate_surfels_internal.hpp"
#include "viewer/viewer_explain.hpp"

namespace insonify {
namespace {

constexpr int rays_per_beam = 16;

/// Words for visibilities, in the order of Visibility.
constexpr const char* visibility_texts[] = {"not known", "outside the fan or the range", "facing away",
                                            "hidden by a nearer surface", "seen"};

}  // namespace

HeadView look_from(const SceneCloud& scene, const View& from) {
  const auto& [pose, fan, gate, sampling] = from;
  HeadView view;
  const PreparedScene prepared(scene);
  view.visibility = find_visibility(prepared, pose, fan, gate, std::vector<std::uint8_t>(scene.size(), 1), sampling);
  const HeadFrame head(scene, pose);
  for (std::size_t i = 0; i < scene.size(); ++i) {
    view.seen += view.visibility[i] == Visibility::seen;
    view.hidden += view.visibility[i] == Visibility::hidden;
    view.turned_away += view.visibility[i] == Visibility::turned_away;
    view.outside += view.visibility[i] == Visibility::outside;
    if (view.visibility[i] != Visibility::seen) continue;
    const double range = head.position(scene.point[i]).norm();
    view.nearest = view.seen == 1 ? range : std::min(view.nearest, range);
    view.farthest = std::max(view.farthest, range);
  }
  SamplingOptions rays = sampling;
  rays.kind = SamplingKind::rays;
  rays.rays_per_beam = rays_per_beam;
  const SamplingReport report = find_scatterers(prepared, pose, fan, gate, rays).report;
  view.rays = fan.beams() * static_cast<std::size_t>(rays_per_beam);
  view.rays_open = report.rays_missed - report.rays_unknown;
  view.holes = hole_positions(find_holes(prepared, pose, fan, gate, rays), pose);
  return view;
}

std::string explain_view(const HeadView& view, const ViewerState& state) {
  const PoseAngles& head = state.head;
  std::string text = printed("Head at %.2f, %.2f, %.2f m\n", head.position.x(), head.position.y(), head.position.z());
  text += printed("Yaw %.1f°, pitch %.1f°, roll %.1f°\n", degrees(head.yaw), degrees(head.pitch), degrees(head.roll));
  text += printed("A key moves the head by %g m\nor turns it by %g°\n\n", state.stride, 10 * state.stride);
  text += printed("%zu surfels, of these\n", view.visibility.size());
  text += printed("  %zu seen\n  %zu hidden\n  %zu facing away\n  %zu outside the fan or the range\n", view.seen,
                  view.hidden, view.turned_away, view.outside);
  if (view.seen > 0) text += printed("Ranges of seen surfels %.2f to %.2f m\n", view.nearest, view.farthest);
  if (view.seen == 0) text += "Nothing is seen: a ping from here\nis silent\n";
  if (view.rays > 0)
    text += printed("%.1f %% of the rays meet nothing,\n%.1f %% meet a hole of the scan\n",
                    100.0 * static_cast<double>(view.rays_open) / static_cast<double>(view.rays),
                    100.0 * static_cast<double>(view.holes.size()) / static_cast<double>(view.rays));
  return text;
}

std::string explain_surfel(const SceneCloud& scene, const HeadView& view, const PoseAngles& position,
                           std::uint32_t surfel) {
  if (surfel >= scene.size())
    fail(ErrorKind::argument, "explain_surfel: surfel = ", surfel, ", must be below ", scene.size());
  const HeadFrame head(scene, pose_of(position));
  const Eigen::Vector3d p = head.position_of(surfel);
  const Eigen::Vector3d world = scene.origin + scene.point[surfel].cast<double>();
  const Direction direction = direction_of(p);
  const double cosine = -head.normal_of(surfel).dot(p) / std::max(p.norm(), 1e-12);
  const double incidence = std::acos(std::clamp(scene.oriented(surfel) ? cosine : std::abs(cosine), -1.0, 1.0));
  std::string text = printed("Surfel %u (id %u)\n", surfel, scene.id[surfel]);
  if (const ScenePart* part = scene.part_of_surfel(surfel)) text += "Part " + part->name + "\n";
  text += "Material " + scene.materials[scene.material[surfel]].name + "\n";
  text += printed("At %.3f, %.3f, %.3f m\n", world.x(), world.y(), world.z());
  text += printed("Area %.3g m²\n", static_cast<double>(scene.area[surfel]));
  text += printed("Range %.3f m\n", p.norm());
  text += printed("Bearing %+.2f°, elevation %+.2f°\n", -degrees(direction.azimuth), degrees(direction.elevation));
  text += printed("Incidence %.1f°\n", degrees(incidence));
  if (surfel < view.visibility.size())
    text += std::string("This surfel is ") + visibility_texts[static_cast<std::size_t>(view.visibility[surfel])] + "\n";
  return text;
}

}  // namespace insonify
