// SPDX-License-Identifier: BSD-3-Clause
// A survey: a vehicle with a multibeam along a line over a scene, and the soundings of all its pings.
#include <iostream>

#include <insonify/core/units.hpp>
#include <insonify/scene/built_in_scenes.hpp>
#include <insonify/store/sonar_file.hpp>
#include <insonify/survey/simulate_survey.hpp>
#include <insonify/survey/waypoint_trajectory.hpp>

int main() {
  using namespace insonify;
  const SceneInMemory scene(make_built_in_scene("river", {.points = 100000}));
  SonarSpec spec = find_sonar("em2040").spec;
  spec.max_range = 12;
  const PingSimulator simulator(spec, Environment{Water{.temperature_c = 8}});

  // Ten metres at 2 m/s, a ping every half second; the head looks down.
  Mission mission;
  mission.trajectory = waypoint_trajectory({.points = {{15, 0, -0.5}, {25, 0, -0.5}}, .speed = 2});
  mission.heads = {{.name = "multibeam",
                    .vehicle_from_head = pose_from_yaw_pitch_roll({0, 0, 0}, 0, radians(90), 0),
                    .interval = 0.5}};
  const SurveyInMemory survey = simulate_survey(Survey(mission, {simulator}), scene);

  for (const PingOutcome& outcome : survey.of_head(0))
    std::cout << "ping " << outcome.ping.number << " at " << outcome.ping.time << " s: " << outcome.soundings.size()
              << " soundings " << outcome.failure << '\n';
}
