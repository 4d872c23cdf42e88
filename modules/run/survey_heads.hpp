// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "run/ping_setup.hpp"
#include "store/mission_file.hpp"

namespace insonify {

/// Returns head `h` of a mission with the settings that its file gives for all. Its run.toml has the pose of no ping.
/// Throws Error(content) for these settings, and Error(argument) for sonar, range and environment, naming the setting.
PingSetup set_up_survey_head(const MissionFile& file, std::size_t h, int threads = 0);

}  // namespace insonify
