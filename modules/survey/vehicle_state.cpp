// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include <Eigen/Geometry>

#include "survey/vehicle_state_internal.hpp"

namespace insonify {

Trajectory entries_about(const Trajectory& t, double time) {
  const auto after = std::upper_bound(t.time.begin(), t.time.end(), time) - t.time.begin();
  const auto i =
      static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(after, 1, static_cast<std::ptrdiff_t>(t.time.size()) - 1));
  return {{t.time[i - 1], t.time[i]}, {t.pose[i - 1], t.pose[i]}};
}

VehicleState vehicle_at(const Trajectory& trajectory, double time) {
  const Trajectory near = entries_about(trajectory, time);
  const double within = std::clamp(time, near.time.front(), near.time.back()), beyond = time - within;
  VehicleState state{pose_at(near, within), motion_at(near, within)};
  if (beyond == 0) return state;
  const auto& [velocity, turn_rate] = state.motion;
  state.pose.translation() += beyond * velocity;
  state.pose.linear() =
      Eigen::AngleAxisd(turn_rate.norm() * beyond, turn_rate.stableNormalized()) * state.pose.linear();
  return state;
}

}  // namespace insonify
