#include "acoustics/motion.hpp"

#include <algorithm>
#include <cmath>

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

// A head in motion, in its own axes at transmission.
struct MovingHead {
  Eigen::Vector3d velocity, axis;
  double turn_rate, sound_speed, centre_frequency;

  // Where a way in head axes at transmission points at `time`.
  Eigen::Vector3d turned(const Eigen::Vector3d& way, double time) const {
    return turn_rate > 0 ? Eigen::AngleAxisd(-turn_rate * time, axis) * way : way;
  }

  void move(double r0, Direction direction, std::size_t i, Echoes& echoes) const {
    const double c = sound_speed;
    const Eigen::Vector3d ahead = unit_vector(direction);
    const double closing = velocity.dot(ahead) / c, speed_2 = velocity.squaredNorm() / (c * c);

    // Out from here, back to where the head will be: a quadratic equation in the delay. (E44)
    const double delay = 2 * r0 / c * (1 - closing) / (1 - speed_2);
    const double longer = r0 * 2 * (speed_2 - closing) / (1 - speed_2);  // r1 - r0
    const double r1 = r0 + longer;
    const Eigen::Vector3d back = (r0 * ahead - velocity * delay) / r1;
    const double phase = 2 * pi * reduced_cycles(centre_frequency / c * longer);
    const Eigen::Vector3d seen = turned(back, delay);

    echoes.delay[i] = delay;
    echoes.amplitude[i] *= std::polar(r0 / r1, phase);
    echoes.u[i] = seen.y();
    if (!echoes.v.empty()) echoes.v[i] = seen.z();
    echoes.doppler[i] = centre_frequency * (closing + velocity.dot(back) / c) / (1 - closing);
  }
};

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
  const MovingHead head{head_from_world * motion.velocity, turn.normalized(), turn.norm(), sound_speed,
                        centre_frequency};
  echoes.doppler.resize(echoes.size());
  for (std::size_t i = 0; i < echoes.size(); ++i) {
    require_positive(scatterers.range[i], "range", "m");
    head.move(scatterers.range[i], {scatterers.azimuth[i], scatterers.elevation[i]}, i, echoes);
  }
}

}  // namespace insonify
