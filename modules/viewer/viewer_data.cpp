#include "viewer/viewer_data.hpp"

#include "core/error.hpp"

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
  const Ping& first = data.pings.front();
  for (const Ping& ping : data.pings) {
    require_valid(ping.fan, viewer_caller);
    require_valid(ping.gate, viewer_caller);
    const auto beams = static_cast<std::size_t>(ping.pressure.rows());
    const auto bins = static_cast<std::size_t>(ping.pressure.cols());
    if (beams != first.fan.beams() || bins != first.gate.bins())
      fail(ErrorKind::content, viewer_caller, ": ping ", ping.number, " has ", beams, " x ", bins,
           " samples, must be beams x bins = ", first.fan.beams(), " x ", first.gate.bins());
  }
  for (const Contributors& list : data.contributors)
    if (!list.empty() && (list.beams != first.fan.beams() || list.bins != first.gate.bins()))
      fail(ErrorKind::content, viewer_caller, ": contributors of ", list.beams, " x ", list.bins,
           " samples, must be beams x bins = ", first.fan.beams(), " x ", first.gate.bins());
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

View view_at(const ViewerData& data, const Pose& pose, const BeamFan& fan, const RangeGate& gate) {
  if (!data.view) return {pose, fan, gate, {}};
  return {pose, fan, data.view->gate, data.view->sampling};
}

ViewerExtent extent_of(const ViewerData& data) {
  if (data.pings.empty()) return {};
  return {data.pings.size(), data.pings[0].fan.beams(), data.pings[0].gate.bins()};
}

}  // namespace insonify
