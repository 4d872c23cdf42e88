// SPDX-License-Identifier: BSD-3-Clause
#include "run/survey_heads.hpp"

#include "run/mission_heads.hpp"
#include "run/parse_values.hpp"
#include "run/run_settings.hpp"

namespace insonify {
namespace {

/// Drops the contributors of pings: surveys keep the labels that follow from them.
struct DroppedContributors : ContributorSink {
  void take(const Contributors&, std::size_t) override {}
};

}  // namespace

PingSetup set_up_survey_head(const MissionFile& file, std::size_t h, int threads) {
  const MissionSonar& sonar = file.sonars[h];
  Run run = load_mission_settings(file.path);
  run.simulation.seed = file.seed, run.simulation.threads = threads;
  run.scene.path = file.scene;
  run.head = {sonar.sonar, {}, file.environment, file.profile, sonar.settings};
  if (!sonar.range.empty()) run.head.range = parse_range(sonar.range);
  run.placement.pose.emplace();  // for run.toml, which demands one
  PingSetup head = set_up(set_up_head(run.head, std::nullopt, file.water.level), run);
  static DroppedContributors labels_alone;
  head.simulation.outputs.contributor_sink = &labels_alone;
  return head;
}

std::vector<PingSimulator> mission_heads(const MissionFile& file) {
  std::vector<PingSimulator> heads;
  for (std::size_t h = 0; h < file.mission.heads.size(); ++h) heads.push_back(set_up_survey_head(file, h).simulator());
  return heads;
}

}  // namespace insonify
