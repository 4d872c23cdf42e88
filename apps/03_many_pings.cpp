// SPDX-License-Identifier: BSD-3-Clause
// Many pings of one scene: prepare it once, ping along a track, store all pings in one cube.
#include <iostream>

#include <insonify/core/units.hpp>
#include <insonify/returns/coverage.hpp>
#include <insonify/scene/built_in_scenes.hpp>
#include <insonify/simulate/ping_simulator.hpp>
#include <insonify/store/cube.hpp>
#include <insonify/store/sonar_file.hpp>

int main(int argc, char** argv) {
  using namespace insonify;

  // The scene is checked and sorted into blocks once; a ping then tests only the blocks within reach of its fan.
  const SceneCloud scene = make_built_in_scene("harbour", {.points = 100000});
  const PreparedScene prepared(scene);

  const Environment environment{Water{.temperature_c = 8}};
  SonarSpec spec = find_sonar("p900-45").spec;
  spec.max_range = 15;
  spec.beams = 64;

  // A simulator is one head in one environment: what forms its beams is made in the first ping and used by all.
  const PingSimulator simulator(spec, environment, {.outputs = {.scatterers = true}});

  // Eight pings along the quay, half a second apart; what they did to each surfel adds up.
  const SonarHead& head = simulator.head();
  Cube cube = make_cube(head, medium_of(environment, head.pulse.centre_frequency));
  std::vector<CoveredSurfel> covered;
  for (int k = 0; k < 8; ++k) {
    const Pose pose = pose_from_yaw_pitch_roll({1.5 * k, 2, -3}, radians(20), radians(15), 0);
    const SimulatedPing result = simulator.ping(prepared, {.world_from_head = pose, .time = 0.5 * k, .number = k});
    add(covered, coverage_of(scene, result.outputs.scatterers, head, result.report.medium));
    std::cout << "ping " << k << ": " << result.soundings.size() << " soundings\n";
    cube.pings.push_back(result.ping);
  }
  std::cout << covered.size() << " of " << scene.size() << " surfels were insonified\n";

  // With a file name, write the cube; to draw it: insonify image CUBE --view waterfall -o waterfall.png
  if (argc > 1) write_cube(argv[1], cube);
}
