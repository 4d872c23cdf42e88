// SPDX-License-Identifier: BSD-3-Clause
// The first ping through the API: from a scene, a sonar and a pose to levels and points.
#include <iostream>

#include <insonify/core/units.hpp>
#include <insonify/scene/built_in_scenes.hpp>
#include <insonify/simulate/ping_simulator.hpp>
#include <insonify/store/sonar_file.hpp>

int main() {
  using namespace insonify;

  // The scene: a harbour of 100 000 surfels. For a cloud of your own include <insonify/scene_io/load_scene.hpp>, link
  // insonify::scene_io, and write: const SceneCloud scene = load_scene("reef.pcd").scene;
  const SceneCloud scene = make_built_in_scene("harbour", {.points = 100000});

  // The sonar: a preset limited to 20 m, in water of 8 deg C.
  SonarSpec spec = find_sonar("p900-45").spec;
  spec.max_range = 20;
  const PingSimulator simulator(spec, Environment{Water{.temperature_c = 8}});

  // The pose: 3 m deep, looking along +x, nose 10 degrees down.
  const Pose pose = pose_from_yaw_pitch_roll({0, 0, -3}, 0, radians(10), 0);

  const SimulatedPing result = simulator.ping(PreparedScene(scene), {pose});
  std::cout << result.report.sampling.scatterers << " scatterers, " << result.soundings.size()
            << " soundings, mean level " << mean_level_db(result.ping, 5, 20) << " dB re 1 uPa\n";
}
