// SPDX-License-Identifier: BSD-3-Clause
#include "survey/mission.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "core/error.hpp"
#include "core/units.hpp"

namespace insonify {
namespace {

/// Throws Error(argument) if an item before item `i` has the same name.
template <typename Item>
void require_own_name(const std::vector<Item>& items, std::size_t i, const char* who, const char* what) {
  const std::string& name = items[i].name;
  if (!is_plain_name(name))
    fail(ErrorKind::argument, who, ": ", what, " '", name,
         "': a name must consist of letters, digits, '-', '_' and '.'");
  for (std::size_t before = 0; before < i; ++before)
    if (items[before].name == name)
      fail(ErrorKind::argument, who, ": two ", what, "s are called '", name, "', must have names of their own");
}

void require_at_least_0(double value, const std::string& item, const char* name, const char* unit) {
  if (!(value >= 0 && std::isfinite(value)))
    fail(ErrorKind::argument, item, ": ", name, " = ", value, " ", unit, ", must be finite and >= 0");
}

void require_valid(const HeadScan& scan, const std::string& head) {
  const double span = std::abs(scan.stop - scan.start);
  if (!(span > 0 && std::isfinite(span)))
    fail(ErrorKind::argument, head, ": scan from ", degrees(scan.start), " to ", degrees(scan.stop),
         " degrees, must be two finite angles");
  if (!(scan.step > 0 && scan.step <= span * (1 + 1e-9)))
    fail(ErrorKind::argument, head, ": scan.step = ", degrees(scan.step),
         " degrees, must be > 0 and at most the span of ", degrees(span));
  constexpr double most_directions = 1e6;
  if (!(span / scan.step <= most_directions))
    fail(ErrorKind::argument, head, ": scan.step = ", degrees(scan.step), " degrees makes ", span / scan.step,
         " directions, must be at most ", most_directions, "; take a larger step");
}

/// Throws Error(argument) unless all that is true and assumed of the installation is finite, and sound has a speed that
/// water may have.
void require_valid_installation(const MissionHead& head, const std::string& item) {
  const AssumedInstallation& assumed = head.assumed;
  for (const auto& [value, name] :
       {std::pair(head.latency, "latency"), std::pair(assumed.latency.value_or(0), "assumed latency"),
        std::pair(head.draught, "draught"), std::pair(assumed.draught.value_or(0), "assumed draught")})
    if (!std::isfinite(value)) fail(ErrorKind::argument, item, ": ", name, " = ", value, ", must be finite");
  if (const double c = assumed.sound_speed.value_or(1500); !(c >= 1300 && c <= 1700))
    fail(ErrorKind::argument, item, ": assumed sound speed = ", c, " m/s, must be within 1300 and 1700 m/s");
  if (assumed.vehicle_from_head && !assumed.vehicle_from_head->matrix().allFinite())
    fail(ErrorKind::argument, item, ": assumed mounting, must be finite");
}

}  // namespace

bool is_plain_name(const std::string& name) {
  const auto plain = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) || c == '-' || c == '_' || c == '.';
  };
  return !name.empty() && name.front() != '.' && std::all_of(name.begin(), name.end(), plain);
}

void require_valid_head(const Mission& mission, std::size_t i, const char* who) {
  require_own_name(mission.heads, i, who, "head");
  const MissionHead& head = mission.heads[i];
  const std::string item = std::string(who) + ": head '" + head.name + "'";
  require_at_least_0(head.interval, item, "time between pings", "s");
  require_at_least_0(head.distance, item, "distance between pings", "m");
  require_at_least_0(head.listening_time, item, "listening time", "s");
  require_valid_installation(head, item);
  const int given = (head.interval > 0) + (head.distance > 0) + !head.times.empty();
  if (mission.random_pings > 0) {
    if (given > 0 || head.scan)
      fail(ErrorKind::argument, item,
           ": pings once at each random pose; leave out rate_hz, every_m, times_s and [head.scan]");
    return;
  }
  if (given > 1 || (given == 0 && !head.scan))
    fail(ErrorKind::argument, item, ": must say when it pings by one of rate_hz, every_m and times");
  for (std::size_t k = 0; k < head.times.size(); ++k)
    if (!std::isfinite(head.times[k]) || (k > 0 && !(head.times[k] > head.times[k - 1])))
      fail(ErrorKind::argument, item, ": times[", k, "] = ", head.times[k],
           " s, must be finite and later than the one before");
  if (head.scan) require_valid(*head.scan, item);
}

void require_valid_leg(const Mission& mission, std::size_t i, const char* who) {
  require_own_name(mission.legs, i, who, "leg");
  const MissionLeg& leg = mission.legs[i];
  const std::string item = std::string(who) + ": leg '" + leg.name + "'";
  const double begin = mission.trajectory.time.front(), end = mission.trajectory.time.back();
  if (!(leg.from < leg.to && leg.from >= begin && leg.to <= end))
    fail(ErrorKind::argument, item, ": from ", leg.from, " to ", leg.to, " s, must ascend within the trajectory's ",
         begin, " and ", end, " s");
  if (i > 0 && leg.from < mission.legs[i - 1].to)
    fail(ErrorKind::argument, item, ": begins at ", leg.from, " s, before leg '", mission.legs[i - 1].name,
         "' ends at ", mission.legs[i - 1].to, " s; legs must not overlap");
  require_at_least_0(leg.interval, item, "time between pings", "s");
  require_at_least_0(leg.distance, item, "distance between pings", "m");
  if (leg.interval > 0 && leg.distance > 0) fail(ErrorKind::argument, item, ": give rate_hz or every_m, not both");
  for (const std::string& name : leg.heads)
    if (std::none_of(mission.heads.begin(), mission.heads.end(), [&](const auto& head) { return head.name == name; }))
      fail(ErrorKind::argument, item, ": heads: there is no head '", name, "'");
}

double gap_of(const Trajectory& trajectory) {
  constexpr double times_usual = 10, least_gap = 5;
  constexpr std::size_t fewest_entries = 4;
  if (trajectory.time.size() < fewest_entries) return std::numeric_limits<double>::infinity();
  std::vector<double> apart(trajectory.time.size() - 1);
  for (std::size_t i = 0; i < apart.size(); ++i) apart[i] = trajectory.time[i + 1] - trajectory.time[i];
  const auto middle = apart.begin() + static_cast<std::ptrdiff_t>(apart.size() / 2);
  std::nth_element(apart.begin(), middle, apart.end());
  return std::max(least_gap, times_usual * *middle);
}

std::optional<TrajectoryGap> gap_at(const Trajectory& trajectory, double time, double max_gap) {
  const std::vector<double>& t = trajectory.time;
  const auto after = std::upper_bound(t.begin(), t.end(), time);
  if (after == t.begin() || after == t.end()) return {};
  const TrajectoryGap gap{*std::prev(after), *after};
  if (!(gap.to - gap.from > max_gap) || time == gap.from) return {};
  return gap;
}

void require_valid(const Mission& mission, const char* who) {
  if (mission.random_pings == 0) require_valid(mission.trajectory, who);
  if (mission.random_pings > 0 && !(mission.trajectory.time.empty() && mission.legs.empty()))
    fail(ErrorKind::argument, who, ": random poses have no order, must have neither trajectory nor legs");
  if (!mission.tide.time.empty() || !mission.tide.height.empty()) {
    if (mission.random_pings > 0)
      fail(ErrorKind::argument, who, ": a tide beside random poses, which have no time; leave one out");
    require_valid(mission.tide, mission.trajectory, who);
  }
  if (!(mission.max_gap > 0)) fail(ErrorKind::argument, who, ": max_gap = ", mission.max_gap, " s, must be > 0");
  if (mission.heads.empty()) fail(ErrorKind::argument, who, ": no head, must have at least one");
  for (std::size_t i = 0; i < mission.heads.size(); ++i) require_valid_head(mission, i, who);
  for (std::size_t i = 0; i < mission.legs.size(); ++i) require_valid_leg(mission, i, who);
}

}  // namespace insonify
