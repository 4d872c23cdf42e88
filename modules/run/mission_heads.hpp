// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <vector>

#include "simulate/ping_simulator.hpp"
#include "store/mission_file.hpp"

namespace insonify {

/// Returns the simulators of the heads of a mission, in its order, with sonar, range, environment and all that the table
/// [ping] of its file says, as `insonify survey` makes them. Throws Error(content) with file and line for settings,
/// Error(file) and Error(argument) for sonars and environments.
std::vector<PingSimulator> mission_heads(const MissionFile& file);

}  // namespace insonify
