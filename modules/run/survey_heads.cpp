// SPDX-License-Identifier: BSD-3-Clause
#include "run/survey_heads.hpp"

#include "run/mission_heads.hpp"
#include "run/run_settings.hpp"

namespace insonify {
namespace {

/// Drops the contributors of pings: surveys keep the labels that follow from them.
struct DroppedContributors : ContributorSink {
  void take(const Contributors&, std::size_t) override {}
};

}  // namespace

SurveyHead set_up_survey_head(const CommonOptions& common, const MissionFile& file, std::size_t h) {
  PingOptions options = load_mission_settings(file.path);
  options.common = common;
  options.common.seed = file.seed;
  options.common.settings = file.sonars[h].settings;
  options.scene.path = file.scene;
  options.run.sonar = file.sonars[h].sonar;
  options.run.range = file.sonars[h].range;
  options.run.environment = file.environment;
  options.run.profile = file.profile;
  options.pose = "0,0,0,0,0,0";  // for run.toml, which demands one
  SurveyHead head{options, set_up_any_ping(options, file.water.level)};
  static DroppedContributors labels_alone;
  head.setup.simulation.outputs.contributor_sink = &labels_alone;
  return head;
}

std::vector<PingSimulator> mission_heads(const MissionFile& file) {
  std::vector<PingSimulator> heads;
  for (std::size_t h = 0; h < file.mission.heads.size(); ++h)
    heads.push_back(set_up_survey_head({}, file, h).setup.simulator());
  return heads;
}

}  // namespace insonify
