// SPDX-License-Identifier: BSD-3-Clause
// A mission file over any scene, as `insonify survey` runs it: its heads, its scene and its pings, which tell progress.
#include <iostream>

#include <insonify/core/error.hpp>
#include <insonify/run/mission_heads.hpp>
#include <insonify/run_scenes/scene_source_of.hpp>
#include <insonify/survey/simulate_survey.hpp>

namespace {

/// Keeps the pings in memory and says which is done.
struct Counted : insonify::SurveyInMemory {
  std::size_t done = 0;
  void ping_done(const insonify::PingOutcome* made) override {
    std::cout << "ping " << ++done << ": " << (made ? made->soundings.size() : 0) << " soundings\n";
  }
};

}  // namespace

int main(int count, char** words) try {
  using namespace insonify;
  if (count != 2) fail(ErrorKind::argument, "usage: 07_mission MISSION.toml");
  MissionFile file = load_mission(words[1]);
  const auto scene = scene_source_of(file);
  draw_poses(file, *scene);  // nothing without [randomise.pose]
  const Survey survey(file.mission, mission_heads(file), {file.randomise, file.seed, file.coverage});
  Counted pings;
  simulate_survey(survey, survey.blocks(), *scene, pings);
  std::cout << pings.of_head(0).size() << " pings of " << survey.mission().heads[0].name << '\n';
} catch (const insonify::Error& error) {
  std::cerr << error.what() << '\n';
  return 1;
}
