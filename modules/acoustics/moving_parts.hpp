// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <vector>

#include <Eigen/Core>

#include "acoustics/echoes.hpp"
#include "acoustics/motion.hpp"
#include "core/pose.hpp"
#include "sampling/scatterers.hpp"
#include "scene/scene_cloud.hpp"

namespace insonify {

/// Moves scatterers of moving parts (ScenePart) from their positions at transmission to the positions at which sound meets
/// them (E145). With d the vector from the head to the scatterer, w = velocity + turn_rate x arm its velocity and r =
/// |d|,
///
///   t = (w d + sqrt((w d)^2 + (c^2 - w^2) r^2)) / (c^2 - w^2),   d becomes d + w t, r becomes c t
///
/// exact for a constant w. Incidence and area stay those at transmission.
///
/// scatterers   in the axes of a head at `world_from_head`, of surfels of `scene`; range, azimuth and elevation change
/// returns      the velocities of the scatterers in head axes [m/s]; empty if no part moves
///
/// Throws Error(argument) for a scatterer that is not slower than a hundredth of the sound speed, naming the part.
std::vector<Eigen::Vector3d> meet_moving_parts(const SceneCloud& scene, const Pose& world_from_head, double sound_speed,
                                               Scatterers& scatterers);

/// Shifts the carriers of echoes by the motion of their scatterers (E146). With a the direction of the way out, b that
/// of the way from the head at reception to the scatterer, and the head's velocity v, frequencies are received as
///
///   f (c - w a) (c + v b) / ((c - v a) (c + w b))
///
/// velocity     as meet_moving_parts returns it; if empty nothing changes
/// scatterers   where sound met them
/// echoes       of these scatterers, as move_echoes leaves them; `doppler` is made if the head rests
void shift_by_parts(const std::vector<Eigen::Vector3d>& velocity, const Motion& head, const Pose& world_from_head,
                    const Scatterers& scatterers, double centre_frequency, double sound_speed, Echoes& echoes);

}  // namespace insonify
