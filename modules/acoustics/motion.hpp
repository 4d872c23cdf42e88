// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <vector>

#include <Eigen/Core>

#include "acoustics/echoes.hpp"
#include "core/pose.hpp"
#include "sampling/scatterers.hpp"

namespace insonify {

/// The motion of a head during a ping, in world axes. Both parts are constant.
struct Motion {
  Eigen::Vector3d velocity = Eigen::Vector3d::Zero();   ///< velocity of the head's origin [m/s]
  Eigen::Vector3d turn_rate = Eigen::Vector3d::Zero();  ///< rotation vector per second [rad/s]
  /// Returns true if the head is at rest.
  bool none() const { return velocity.isZero(0) && turn_rate.isZero(0); }
};

/// Throws Error(argument) unless all is finite and the head turns by at most 100 rad/s.
void require_valid(const Motion& motion, const char* who);

/// Poses along a track. Between entries positions are linear in time, and attitudes follow the shortest turn.
struct Trajectory {
  std::vector<double> time;  ///< [s], strictly ascending
  std::vector<Pose> pose;    ///< world_from_head
};

/// Throws Error(argument) unless there are two entries at least, of one length, with ascending finite times and finite
/// poses whose rotations are right-handed and orthonormal within 1e-6.
void require_valid(const Trajectory& trajectory, const char* who);

/// Returns the pose at `time` [s]. Throws Error(argument) outside the trajectory's times, or for an invalid trajectory.
Pose pose_at(const Trajectory& trajectory, double time);

/// Returns the motion at `time` [s]. It is constant between entries; at an entry it is that of the next interval, at
/// the last entry that of the last interval. Give more entries for turns of half a circle and more, whose sense would
/// be ambiguous. Errors as pose_at.
Motion motion_at(const Trajectory& trajectory, double time);

/// Changes the echoes of a head at rest into those of a moving head (E44). Sound leaves the head at `world_from_head`
/// at time 0. The head receives it at the time `delay`, at the position of that time. With d the vector to the scatterer,
/// r0 = |d|,
///
///   delay = 2 (c r0 - v d) / (c^2 - v^2),  r1 = c delay - r0
///   amplitude *= r0 / r1 exp(i k (r1 - r0))                      spreading r0 r1 for r0^2, carrier phase k (r0 + r1)
///   u, v of the direction in head axes at reception
///   doppler = f (v d / r0 + v d1 / r1) / (c - v d / r0), d1 the way at reception: the rate of the delay, exact
///
/// The Doppler shift is to be applied as a shift of the carrier alone, exp(-2 pi i doppler (t - delay)): the envelope
/// keeps its length, which is off by v/c of it. Elevation and transmit patterns stay those at transmission. Phases are
/// reduced to a cycle in double.
///
/// scatterers        from which the echoes came, index by index
/// centre_frequency  [Hz], sound_speed [m/s], as in the echoes
/// echoes            changed in place; `v` only if there, `doppler` is made. Motion of none() changes nothing.
///
/// Throws Error(argument) for another number of echoes than scatterers, motion that is invalid or not slower than a
/// hundredth of the sound speed, frequency or sound speed that is not finite and > 0, a pose that is not finite, or a
/// range that is not finite and > 0.
void move_echoes(const Motion& motion, const Pose& world_from_head, const Scatterers& scatterers,
                 double centre_frequency, double sound_speed, Echoes& echoes);

/// Returns bounds for a motion slower than a hundredth of the sound speed: of the relative change of half the path, c
/// delay / 2, and of the change of direction cosines by a displacement.
double most_displacement(const Motion& motion, double sound_speed);

}  // namespace insonify
