// SPDX-License-Identifier: BSD-3-Clause
#include "survey/survey_pings.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/units.hpp"
#include "survey/vehicle_state_internal.hpp"

namespace insonify {
namespace {

constexpr double leg_rounding = 1e-9;  // [s]; a ping at the end of a leg, up to rounding, belongs to the next leg

/// Returns the times before `to` at which the vehicle has gone a multiple of `distance` since `from`.
std::vector<double> times_by_distance(const Trajectory& t, double from, double to, double distance) {
  std::vector<double> times{from};
  double gone = 0, next = distance;
  Eigen::Vector3d at = pose_at(t, from).translation();
  double time = from;
  for (std::size_t i = 0; i < t.time.size() && time < to; ++i) {
    if (t.time[i] <= from) continue;
    const Eigen::Vector3d there = t.pose[i].translation();
    const double length = (there - at).norm();
    for (; next <= gone + length; next += distance) {
      const double then = time + (t.time[i] - time) * (next - gone) / length;
      if (then >= to - leg_rounding) return times;
      times.push_back(then);
    }
    gone += length, at = there, time = t.time[i];
  }
  return times;
}

/// Interval or distance between the pings of a head on a leg; both are 0 if the head has times of its own.
struct PingSpacing {
  double interval = 0, distance = 0;  // [s], [m]
};

PingSpacing spacing_on(const MissionHead& head, const MissionLeg& leg) {
  const bool own = leg.interval > 0 || leg.distance > 0;
  PingSpacing spacing{own ? leg.interval : head.interval, own ? leg.distance : head.distance};
  if (spacing.interval + spacing.distance == 0 && head.times.empty()) spacing.interval = head.listening_time;
  return spacing;
}

bool pings_on(const MissionHead& head, const MissionLeg& leg) {
  return leg.active &&
         (leg.heads.empty() || std::find(leg.heads.begin(), leg.heads.end(), head.name) != leg.heads.end());
}

double length_between(const Trajectory& t, double from, double to) {
  double length = 0;
  for (std::size_t i = 1; i < t.time.size(); ++i)
    if (t.time[i] > from && t.time[i - 1] < to)
      length += (t.pose[i].translation() - t.pose[i - 1].translation()).norm();
  return length;
}

/// Throws Error(argument) for a mission with too many pings, before their list fills the memory of the machine.
void require_countable(const Mission& mission, const std::vector<MissionLeg>& legs) {
  constexpr double most = most_survey_pings;
  double pings = 0;
  for (const MissionHead& head : mission.heads) {
    double of_head = 0;
    for (const MissionLeg& leg : legs) {
      if (!pings_on(head, leg)) continue;
      const auto [interval, distance] = spacing_on(head, leg);
      const double length = distance > 0 ? length_between(mission.trajectory, leg.from, leg.to) : 0;
      of_head += distance > 0   ? length / distance
                 : interval > 0 ? (leg.to - leg.from) / interval
                                : static_cast<double>(head.times.size());
    }
    pings += of_head;
    if (!(pings <= most))
      fail(ErrorKind::argument, "survey_pings: head '", head.name, "' asks for ", of_head,
           " pings, all heads must ask ", "for at most ", most,
           "; let it ping less often (rate_hz, every_m), faster over ground (speed_m_s), or divide ", "the mission");
  }
}

std::vector<double> times_on_leg(const Mission& mission, const MissionHead& head, const MissionLeg& leg) {
  const auto [interval, distance] = spacing_on(head, leg);
  if (distance > 0) return times_by_distance(mission.trajectory, leg.from, leg.to, distance);
  std::vector<double> times;
  if (interval > 0) {
    for (double k = 0; leg.from + k * interval < leg.to - leg_rounding; ++k) times.push_back(leg.from + k * interval);
    return times;
  }
  const bool last = leg.to == mission.trajectory.time.back();
  for (const double time : head.times)
    if (time >= leg.from && (time < leg.to || (last && time == leg.to))) times.push_back(time);
  return times;
}

/// The sweep of a scanning head: its directions, and the angle after `k` steps since the begin of a leg.
struct Sweep {
  const HeadScan& scan;
  std::int64_t directions;

  explicit Sweep(const HeadScan& of) : scan(of) {
    const double span = std::abs(of.stop - of.start);
    directions = static_cast<std::int64_t>(span / of.step + 1e-9) + (span < 2 * pi - 1e-9 ? 1 : 0);
  }
  /// Returns the number of steps from the begin of one sweep to the next.
  std::int64_t length() const {
    return scan.mode == ScanMode::sector ? std::max<std::int64_t>(1, directions - 1) : directions;
  }
  double angle(std::int64_t k) const {
    const std::int64_t sweep = k / length(), j = k % length();
    const bool back = scan.mode == ScanMode::sector && sweep % 2 == 1;
    const double step = scan.stop < scan.start ? -scan.step : scan.step;
    return scan.start + step * static_cast<double>(back ? directions - 1 - j : j);
  }
};

void add_pings(const Mission& mission, std::size_t h, const MissionLeg& leg, std::vector<SurveyPing>& pings,
               std::size_t first) {
  const MissionHead& head = mission.heads[h];
  if (!pings_on(head, leg)) return;
  const std::vector<double> times = times_on_leg(mission, head, leg);
  const std::int64_t sweep = pings.size() > first ? pings.back().sweep + 1 : 0;
  for (std::size_t k = 0; k < times.size(); ++k) {
    SurveyPing ping{h, static_cast<std::int64_t>(pings.size() - first), times[k], 0, 0};
    if (head.scan) {
      const Sweep turn(*head.scan);
      const auto step = static_cast<std::int64_t>(k);
      if (head.scan->mode == ScanMode::single && step >= turn.directions) break;
      ping.sweep = sweep + step / turn.length();
      ping.scan_angle = turn.angle(step);
    }
    if (!gap_at(mission.trajectory, ping.time, mission.max_gap)) pings.push_back(ping);
  }
}

void require_apart(const MissionHead& head, const std::vector<SurveyPing>& pings, std::size_t first) {
  for (std::size_t p = first + 1; p < pings.size(); ++p)
    if (const double apart = pings[p].time - pings[p - 1].time; apart < head.listening_time * (1 - leg_rounding))
      fail(ErrorKind::argument, "survey_pings: head '", head.name, "': pings ", pings[p - 1].number, " and ",
           pings[p].number, " at ", pings[p - 1].time, " and ", pings[p].time, " s are ", apart,
           " s apart, must be at least 2 max_range / c = ", head.listening_time, " s");
}

/// Returns the pings at random poses: each head pings once at each, a second apart.
std::vector<SurveyPing> pings_at_random(const Mission& mission) {
  const double all = static_cast<double>(mission.random_pings) * static_cast<double>(mission.heads.size());
  if (!(all <= most_survey_pings))
    fail(ErrorKind::argument, "survey_pings: ", all, " pings at random poses, must be at most ", most_survey_pings);
  std::vector<SurveyPing> pings;
  for (std::size_t h = 0; h < mission.heads.size(); ++h)
    for (std::int64_t k = 0; k < mission.random_pings; ++k) pings.push_back({h, k, static_cast<double>(k), 0, 0});
  return pings;
}

/// Returns the drawn pose of a ping. Throws Error(argument) if none is drawn for it.
const Pose& random_pose_of(const Mission& mission, const SurveyPing& ping) {
  const auto i = static_cast<std::size_t>(ping.number);
  if (ping.number < 0 || i >= mission.poses.size())
    fail(ErrorKind::argument, "event_of: ping ", ping.number, " has none of ", mission.poses.size(),
         " drawn poses; draw_poses must draw all of them over the scene");
  return mission.poses[i];
}

/// Returns time, pose and motion of a ping of a head that is mounted like this on its vehicle.
PingEvent event_on(const VehicleState& vehicle, const Pose& mount, const SurveyPing& ping) {
  Motion motion = vehicle.motion;
  motion.velocity += motion.turn_rate.cross(Eigen::Vector3d(vehicle.pose.linear() * mount.translation()));
  const Pose head = vehicle.pose * mount * Eigen::AngleAxisd(ping.scan_angle, Eigen::Vector3d::UnitZ());
  return {head, motion, ping.time, random_stream_of(ping)};
}

}  // namespace

std::vector<SurveyPing> survey_pings(const Mission& mission) {
  require_valid(mission, "survey_pings");
  if (mission.random_pings > 0) return pings_at_random(mission);
  const Trajectory& t = mission.trajectory;
  const std::vector<MissionLeg> whole{{"all", t.time.front(), t.time.back()}};
  require_countable(mission, mission.legs.empty() ? whole : mission.legs);
  std::vector<SurveyPing> pings;
  for (std::size_t h = 0; h < mission.heads.size(); ++h) {
    const std::size_t first = pings.size();
    for (const MissionLeg& leg : mission.legs.empty() ? whole : mission.legs) add_pings(mission, h, leg, pings, first);
    require_apart(mission.heads[h], pings, first);
  }
  if (pings.empty())
    fail(ErrorKind::argument, "survey_pings: no head pings on any leg outside of gaps of the trajectory");
  return pings;
}

PingEvent event_of(const Mission& mission, const SurveyPing& ping) {
  const Pose& mount = mission.heads.at(ping.head).vehicle_from_head;
  if (mission.random_pings > 0) return event_on({random_pose_of(mission, ping), {}}, mount, ping);
  const Trajectory near = entries_about(mission.trajectory, ping.time);
  return event_on({pose_at(near, ping.time), motion_at(near, ping.time)}, mount, ping);
}

PingEvent believed_event_of(const Mission& mission, const SurveyPing& ping) {
  const MissionHead& head = mission.heads.at(ping.head);
  const AssumedInstallation& assumed = head.assumed;
  const double late = head.latency - assumed.latency.value_or(head.latency), time = ping.time - late;  // (E216)
  VehicleState vehicle{};
  if (mission.random_pings > 0)
    vehicle.pose = random_pose_of(mission, ping);
  else
    vehicle = vehicle_at(mission.trajectory, time);
  if (!mission.navigation.nodes.empty()) {
    const Pose reported = believed_pose(mission.navigation, time, vehicle.pose);
    const Eigen::Matrix3d turned = reported.linear() * vehicle.pose.linear().transpose();
    vehicle = {reported, {turned * vehicle.motion.velocity, turned * vehicle.motion.turn_rate}};
  }
  PingEvent event = event_on(vehicle, assumed.vehicle_from_head.value_or(head.vehicle_from_head), ping);
  event.world_from_head.translation().z() -= assumed.draught.value_or(head.draught) - head.draught;
  return event;
}

std::int64_t random_stream_of(const SurveyPing& ping) {
  return (static_cast<std::int64_t>(ping.head) << 40) + ping.number;
}

std::vector<SurveyBlock> survey_blocks(const std::vector<SurveyPing>& pings,
                                       const std::vector<std::size_t>& per_block) {
  std::vector<SurveyBlock> blocks;
  for (std::size_t p = 0; p < pings.size(); ++p) {
    const bool same_head = !blocks.empty() && blocks.back().head == pings[p].head;
    if (!same_head || blocks.back().end - blocks.back().begin == per_block.at(pings[p].head))
      blocks.push_back({pings[p].head, same_head ? blocks.back().number + 1 : 0, p, p});
    blocks.back().end = p + 1;
  }
  return blocks;
}

}  // namespace insonify
