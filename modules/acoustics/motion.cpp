// SPDX-License-Identifier: BSD-3-Clause
#include "acoustics/motion.hpp"

#include <algorithm>
#include <cmath>

#include "acoustics/echo_loops_internal.hpp"
#include "core/error.hpp"
#include "core/units.hpp"

namespace insonify {
namespace {

/// One leg of a trajectory, and how far along it a time is.
struct TrajectoryLeg {
  const Pose& from;
  const Pose& to;
  double duration, part;
};

TrajectoryLeg leg_at(const Trajectory& t, double time, const char* who) {
  require_valid(t, who);
  if (!(time >= t.time.front() && time <= t.time.back()))
    fail(ErrorKind::argument, who, ": time = ", time, " s, must be within the trajectory's ", t.time.front(), " and ",
         t.time.back(), " s");
  const auto after = static_cast<std::size_t>(std::upper_bound(t.time.begin(), t.time.end(), time) - t.time.begin());
  const std::size_t i = std::min(after, t.time.size() - 1) - 1;
  const double duration = t.time[i + 1] - t.time[i];
  return {t.pose[i], t.pose[i + 1], duration, (time - t.time[i]) / duration};
}

void require_positive(double value, const char* name, const char* unit) {
  if (!(value > 0) || !std::isfinite(value))
    fail(ErrorKind::argument, "move_echoes: ", name, " = ", value, " ", unit, ", must be finite and > 0");
}

}  // namespace

void require_valid(const Motion& motion, const char* who) {
  if (!motion.velocity.allFinite())
    fail(ErrorKind::argument, who, ": motion.velocity = ", motion.velocity.transpose(), " m/s, must be finite");
  if (!(motion.turn_rate.norm() <= 100))
    fail(ErrorKind::argument, who, ": motion.turn_rate = ", motion.turn_rate.transpose(),
         " rad/s, must be finite and at most 100 rad/s (is it in degrees?)");
}

void require_valid(const Trajectory& t, const char* who) {
  if (t.time.size() != t.pose.size())
    fail(ErrorKind::argument, who, ": trajectory has ", t.time.size(), " times, but ", t.pose.size(), " poses");
  if (t.time.size() < 2)
    fail(ErrorKind::argument, who, ": trajectory has ", t.time.size(), " entries, must have two at least");
  for (std::size_t i = 0; i < t.time.size(); ++i) {
    if (!std::isfinite(t.time[i]))
      fail(ErrorKind::argument, who, ": trajectory: time[", i, "] = ", t.time[i], " s, must be finite");
    if (i > 0 && !(t.time[i] > t.time[i - 1]))
      fail(ErrorKind::argument, who, ": trajectory: time[", i, "] = ", t.time[i],
           " s, must be later than the entry before it, ", t.time[i - 1], " s");
    const Eigen::Matrix3d r = t.pose[i].linear();
    if (!t.pose[i].matrix().allFinite() || !(r * r.transpose()).isIdentity(1e-6) || r.determinant() < 0)
      fail(ErrorKind::argument, who, ": trajectory: pose[", i, "] must be finite, its rotation orthonormal");
  }
}

Pose pose_at(const Trajectory& trajectory, double time) {
  const TrajectoryLeg leg = leg_at(trajectory, time, "pose_at");
  const Eigen::Quaterniond from(leg.from.linear()), to(leg.to.linear());
  Pose pose = Pose::Identity();
  pose.translation() = leg.from.translation() + leg.part * (leg.to.translation() - leg.from.translation());
  pose.linear() = from.slerp(leg.part, to).toRotationMatrix();
  return pose;
}

Motion motion_at(const Trajectory& trajectory, double time) {
  const TrajectoryLeg leg = leg_at(trajectory, time, "motion_at");
  const Eigen::AngleAxisd turn(Eigen::Matrix3d(leg.to.linear() * leg.from.linear().transpose()));
  return {(leg.to.translation() - leg.from.translation()) / leg.duration, turn.axis() * (turn.angle() / leg.duration)};
}

void move_echoes(const Motion& motion, const Pose& world_from_head, const Scatterers& scatterers,
                 double centre_frequency, double sound_speed, Echoes& echoes) {
  constexpr const char* who = "move_echoes";
  require_valid(motion, who);
  require_positive(centre_frequency, "centre_frequency", "Hz");
  require_positive(sound_speed, "sound_speed", "m/s");
  if (!(motion.velocity.norm() < sound_speed / 100))
    fail(ErrorKind::argument, who, ": motion.velocity = ", motion.velocity.norm(),
         " m/s, must be below a hundredth of the sound speed, ", sound_speed / 100, " m/s");
  if (!world_from_head.matrix().allFinite()) fail(ErrorKind::argument, who, ": world_from_head must be finite");
  if (echoes.size() != scatterers.size())
    fail(ErrorKind::argument, who, ": ", echoes.size(), " echoes, but ", scatterers.size(), " scatterers");
  if (motion.none()) return;

  const Eigen::Matrix3d head_from_world = world_from_head.linear().transpose();
  const Eigen::Vector3d turn = head_from_world * motion.turn_rate;
  const Eigen::Vector3d velocity = head_from_world * motion.velocity, axis = turn.normalized();
  const kernels::MovingHead head{{velocity.x(), velocity.y(), velocity.z()},
                                 {axis.x(), axis.y(), axis.z()},
                                 turn.norm() / (2 * pi),
                                 sound_speed,
                                 centre_frequency};
  for (const double range : scatterers.range) require_positive(range, "range", "m");
  echoes.doppler.resize(echoes.size());
  std::vector<double> unused(echoes.v.empty() ? echoes.size() : 0);
  kernels::move_echoes(scatterers.range.data(), scatterers.azimuth.data(), scatterers.elevation.data(), echoes.size(),
                       head,
                       {echoes.delay.data(), echoes.u.data(), echoes.v.empty() ? unused.data() : echoes.v.data(),
                        reinterpret_cast<double*>(echoes.amplitude.data())},
                       echoes.doppler.data());
}

double most_displacement(const Motion& motion, double sound_speed) {
  return 1.03 * motion.velocity.norm() / sound_speed;
}

}  // namespace insonify
