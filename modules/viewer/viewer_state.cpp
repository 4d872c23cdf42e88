// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/viewer_state.hpp"

#include <cmath>

#include "core/text.hpp"
#include "core/units.hpp"

namespace insonify {
namespace {

// Formats a number without trailing zeros, never as "-0".
std::string short_number(double value) {
  std::string number = printed("%.3f", std::abs(value) < 5e-4 ? 0.0 : value);
  while (number.back() == '0') number.pop_back();
  if (number.back() == '.') number.pop_back();
  return number;
}

}  // namespace

std::string pose_option(const PoseAngles& head) {
  std::string text = "--pose=";
  for (const double metres : {head.position.x(), head.position.y(), head.position.z()})
    text += short_number(metres) + ",";
  return text + short_number(degrees(head.yaw)) + "," + short_number(degrees(head.pitch)) + "," +
         short_number(degrees(head.roll));
}

ViewerState select_pixel(ViewerState state, PixelPosition position, const Eigen::Vector2d& at,
                         const ViewerExtent& extent) {
  if (position.beam >= extent.beams || position.bin >= extent.bins) return state;
  if (!state.measure.active) {
    state.selected = position;
    return state;
  }
  state.measure.points.push_back(at);
  state.measure.active = state.measure.points.size() < 2;
  return state;
}

ViewerState select_ping(ViewerState state, std::size_t ping, PixelPosition position, const ViewerExtent& extent) {
  if (ping >= extent.pings || position.beam >= extent.beams || position.bin >= extent.bins) return state;
  state.playing = false;
  state.ping = ping;
  state.selected = position;
  return state;
}

ViewerState play_on(ViewerState state, double seconds, const ViewerExtent& extent, double& carried) {
  if (!state.playing || extent.pings == 0) return state;
  carried += seconds * state.pings_per_second;
  const double whole = std::floor(carried);
  carried -= whole;
  state.ping = (state.ping + static_cast<std::size_t>(whole) % extent.pings) % extent.pings;
  return state;
}

}  // namespace insonify
