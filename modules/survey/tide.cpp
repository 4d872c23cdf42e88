// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <iterator>

#include "core/error.hpp"
#include "core/message.hpp"
#include "survey/mission.hpp"
#include "survey/vehicle_state_internal.hpp"

namespace insonify {

void require_valid(const TideSeries& tide, const Trajectory& trajectory, const char* who) {
  const auto& [time, height] = tide;
  if (time.size() != height.size() || time.size() < 2)
    fail(ErrorKind::argument, who, ": tide has ", time.size(), " times and ", height.size(),
         " heights, must have at least two of each, and as many of both");
  for (std::size_t k = 0; k < time.size(); ++k)
    if (!std::isfinite(time[k]) || !std::isfinite(height[k]) || (k > 0 && !(time[k] > time[k - 1])))
      fail(ErrorKind::argument, who, ": tide[", k, "] = ", height[k], " m at ", time[k],
           " s, must be finite and later than the one before");
  for (const double end : {trajectory.time.front(), trajectory.time.back()}) water_height_at(tide, end);
}

double water_height_at(const TideSeries& tide, double time) {
  const std::vector<double>& t = tide.time;
  if (t.size() < 2 || !(time >= t.front() && time <= t.back()))
    fail(ErrorKind::argument, "tide: there is no water level at ", time, " s; ",
         t.size() < 2 ? std::string("it must have at least two entries")
                      : printed("its entries from %g to %g s must reach there", t.front(), t.back()));
  const auto after = std::clamp<std::ptrdiff_t>(std::upper_bound(t.begin(), t.end(), time) - t.begin(), 1,
                                                static_cast<std::ptrdiff_t>(t.size()) - 1);
  const auto i = static_cast<std::size_t>(after);
  const double share = (time - t[i - 1]) / (t[i] - t[i - 1]);
  return (1 - share) * tide.height[i - 1] + share * tide.height[i];  // (E217)
}

Environment at_tide(Environment environment, const TideSeries& tide, double time) {
  if (tide.time.empty()) return environment;
  environment.water_level = water_height_at(tide, time);
  if (environment.surface) environment.surface->height = *environment.water_level;
  return environment;
}

Trajectory on_the_water(const Trajectory& trajectory, const TideSeries& tide) {
  std::vector<double> times;
  const double begin = trajectory.time.front(), end = trajectory.time.back();
  const auto within = [&](double time) { return time > begin && time < end; };
  std::vector<double> of_tide;
  std::copy_if(tide.time.begin(), tide.time.end(), std::back_inserter(of_tide), within);
  std::set_union(trajectory.time.begin(), trajectory.time.end(), of_tide.begin(), of_tide.end(),
                 std::back_inserter(times));
  Trajectory afloat;
  for (const double time : times) {
    Pose pose = vehicle_at(trajectory, time).pose;
    pose.translation().z() += water_height_at(tide, time);
    afloat.time.push_back(time);
    afloat.pose.push_back(pose);
  }
  return afloat;
}

}  // namespace insonify
