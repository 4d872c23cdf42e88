// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "run/ping_setup.hpp"
#include "store/mission_file.hpp"

namespace insonify {

/// A head of a mission, ready to ping at any pose.
struct SurveyHead {
  PingOptions options;  ///< sonar, scene and settings as for a ping; a run.toml of them has the pose of no ping
  PingSetup setup;
};

/// Returns head `h` of a mission with the settings that its file gives for all. Throws Error(content) for these, and
/// Error(argument) for sonar, range and environment, naming the setting.
SurveyHead set_up_survey_head(const CommonOptions& common, const MissionFile& file, std::size_t h);

}  // namespace insonify
