// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <Eigen/Core>

#include "returns/ping.hpp"

namespace insonify {

/// Returns the way from the place where the head transmitted to what it hears at `range` from `direction`, in world
/// axes [m]. A head at rest has range times direction. A head that moves by v and turns by w hears the echo at T = 2
/// range / c, where it is then and with the axes it has then (E44 solved for the place, exact):
///
///   e1 = exp(w T) world_from_head direction,  r1 = (c^2 - v^2) T / (2 (c + v e1)),  way = v T + r1 e1
///
/// direction    unit vector in head axes at reception
/// range        c T / 2 [m]
/// sound_speed  c, at the head [m/s]
///
/// Throws Error(argument) for a sound speed that is not > 0.
Eigen::Vector3d way_of_echo(const Ping& ping, const Eigen::Vector3d& direction, double range, double sound_speed);

/// Returns how far a scatterer was from the head at transmission [m], if it lay in `direction` (unit vector in head
/// axes at transmission) and is heard at `range`: T (c^2 - v^2) / (2 (c - v e0)), with the names of way_of_echo. Errors
/// as way_of_echo.
double distance_of_echo(const Ping& ping, const Eigen::Vector3d& direction, double range, double sound_speed);

}  // namespace insonify
