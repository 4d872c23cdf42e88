// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/viewer_data.hpp"

#include "core/error.hpp"
#include "view/ping_record.hpp"

namespace insonify {
namespace {

template <typename PerPing>
void require_one_each(const std::vector<PerPing>& list, const ViewerData& data, const char* what) {
  if (!list.empty() && list.size() != data.pings.size())
    fail(ErrorKind::content, viewer_caller, ": ", what, " of ", list.size(), " pings, must be of all ",
         data.pings.size());
}

void require_pings(const ViewerData& data) {
  if (data.pings.empty()) fail(ErrorKind::content, viewer_caller, ": no pings to show");
  const BeamFan& fan = data.pings.fan();
  const RangeGate& gate = data.pings.gate();
  for (const Contributors& list : data.contributors)
    if (!list.empty() && (list.beams != fan.beams() || list.bins != gate.bins()))
      fail(ErrorKind::content, viewer_caller, ": contributors of ", list.beams, " x ", list.bins,
           " samples, must be beams x bins = ", fan.beams(), " x ", gate.bins());
}

}  // namespace

void require_viewable(const ViewerData& data, ViewerMode mode) {
  if (data.scene.size() > 0) require_valid(data.scene, viewer_caller);
  if (mode == ViewerMode::run) {
    require_pings(data);
    require_one_each(data.contributors, data, "contributors");
    return;
  }
  if (data.scene.size() == 0) fail(ErrorKind::content, viewer_caller, ": the scene has no surfels");
  require_valid(data.fan, viewer_caller);
  require_valid(data.gate, viewer_caller);
}

bool has_scene(const ViewerData& data) { return data.scene_of_ping || data.scene.size() > 0; }

std::shared_ptr<const SceneCloud> scene_at(const ViewerData& data, std::size_t ping) {
  if (data.scene_of_ping) return data.scene_of_ping(ping);
  return {std::shared_ptr<const void>(), &data.scene};
}

PoseAngles vehicle_position(const ViewerData& data, const PoseAngles& head) {
  const Pose& mount = data.vehicle_from_head;
  if (mount.isApprox(Pose::Identity(), 0)) return head;
  return pose_angles(pose_of(head) * mount.inverse());
}

View view_at(const ViewerData& data, const Pose& pose, const BeamFan& fan, const RangeGate& gate) {
  if (!data.view) return {pose, fan, gate, {}};
  return {pose, fan, data.view->gate, data.view->sampling};
}

ViewerPicture picture_of(const ViewerData& data) {
  if (data.pings.size() < 2 || data.pings.fan().beams() > 1) return ViewerPicture::fan;
  return data.pings.position(0).scan ? ViewerPicture::sweep : ViewerPicture::waterfall;
}

std::string unit_of(const ViewerData& data, bool tvg) {
  if (data.recorded_unit.empty()) return level_unit(tvg ? std::optional(Tvg{}) : std::nullopt);
  return data.recorded_unit + (tvg ? ", range compensated" : "");
}

ViewerExtent extent_of(const ViewerData& data) {
  if (data.pings.empty()) return {};
  return {data.pings.size(), data.pings.fan().beams(), data.pings.gate().bins()};
}

}  // namespace insonify
