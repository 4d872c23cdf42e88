// SPDX-License-Identifier: BSD-3-Clause
#include "core/units.hpp"
#include "store/cube.hpp"

namespace insonify {

Cube make_cube(const SonarHead& head, const Medium& medium, const SimulationOptions& options) {
  require_valid(head, "make_cube");
  require_valid(medium, "make_cube");
  Cube cube;
  cube.sound_speed = medium.sound_speed;
  cube.absorption_db_per_m = medium.absorption.a0 / nepers_per_db;
  cube.centre_frequency = head.pulse.centre_frequency;
  cube.bandwidth = head.pulse.bandwidth;
  cube.source_level_db = head.pulse.source_level_db;
  cube.seed = options.seed;
  cube.tolerance = options.synthesis.tolerance;
  cube.sonar = head.name;
  cube.insonify_version = INSONIFY_VERSION;
  return cube;
}

}  // namespace insonify
