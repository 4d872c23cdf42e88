// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/viewer_data.hpp"

#include <utility>

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
  if (data.sides && fan.beams() != 2)
    fail(ErrorKind::content, viewer_caller, ": ", fan.beams(), " beams of sides, must be port and starboard");
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
  if (data.pings.size() < 2) return ViewerPicture::fan;
  if (data.sides) return ViewerPicture::sides;
  if (data.pings.fan().beams() > 1) return ViewerPicture::fan;
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

LazyPings::LazyPings(std::vector<TrackPoint> positions, PingSource source)
    : positions_(std::move(positions)), source_(std::move(source)) {}

std::shared_ptr<const Ping> LazyPings::ping(std::size_t i) const {
  constexpr const char* who = "show_viewer";
  if (i >= size()) fail(ErrorKind::argument, who, ": ping = ", i, ", must be below ", size(), ", the number of pings");
  if (last_ && last_index_ == i) return last_;
  auto ping = std::make_shared<const Ping>(source_.ping(i));
  require_valid(ping->fan, who);
  require_valid(ping->gate, who);
  if (!frame_) frame_ = {ping->fan, ping->gate};
  const std::size_t beams = frame_->fan.beams(), bins = frame_->gate.bins();
  const auto rows = static_cast<std::size_t>(ping->pressure.rows());
  const auto columns = static_cast<std::size_t>(ping->pressure.cols());
  if (rows != beams || columns != bins || ping->fan.beams() != beams || ping->gate.bins() != bins)
    fail(ErrorKind::content, who, ": ping ", ping->number, " has ", rows, " x ", columns,
         " samples, must be beams x bins = ", beams, " x ", bins);
  last_ = std::move(ping);
  last_index_ = i;
  return last_;
}

const LazyPings::Frame& LazyPings::frame() const {
  if (!frame_) ping(0);
  return *frame_;
}

ComplexGridF LazyPings::beam(std::size_t first, std::size_t count, std::size_t beam) const {
  return source_.beam(first, count, beam);
}

Soundings LazyPings::returns(std::size_t i) const { return has_returns() ? source_.returns(i) : Soundings{}; }

}  // namespace insonify
