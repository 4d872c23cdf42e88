// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>

#include <Eigen/Core>

#include "returns/ping.hpp"

namespace insonify {

/// Returns the vector from the head at transmission to the scatterer whose echo the head receives at `range` from
/// `direction` [m, world axes]. For a head at rest this is range times direction. A head that moves by v and turns by w
/// receives the echo at T = 2 range / c, at the position and with the axes of that time (E44 solved for the scatterer,
/// exact):
///
///   e1 = exp(w T) world_from_head direction,  r1 = (c^2 - v^2) T / (2 (c + v e1)),  way = v T + r1 e1
///
/// direction    unit vector in head axes at reception
/// range        c T / 2 [m]
/// sound_speed  c, at the head [m/s]
///
/// Throws Error(argument) for a sound speed that is not > 0.
Eigen::Vector3d way_of_echo(const Ping& ping, const Eigen::Vector3d& direction, double range, double sound_speed);

/// Returns the vector from the head at transmission to the scatterer whose echo beam `beam` receives at `range` [m,
/// world axes]. The elevation of the beam is that of what was sent, so it holds at transmission; the cone about the
/// array, by which a line array resolves directions, holds at reception (E219). A planar array resolves both at
/// reception, as way_of_echo. Arguments and errors are those of way_of_echo.
Eigen::Vector3d way_of_beam(const Ping& ping, std::size_t beam, double range, double sound_speed);

/// Returns the distance from the head at transmission to a scatterer [m]. The scatterer lies in `direction` (unit
/// vector in head axes at transmission), and its echo arrives at `range`. The distance is T (c^2 - v^2) / (2 (c - v
/// e0)), with the names of way_of_echo. Throws Error as way_of_echo does.
double distance_of_echo(const Ping& ping, const Eigen::Vector3d& direction, double range, double sound_speed);

}  // namespace insonify
