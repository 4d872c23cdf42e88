// SPDX-License-Identifier: BSD-3-Clause
// From a scene to echoes: the built-in harbour of 200 000 surfels, 512 beams. Argument 0: scatterers per cell.
#include <benchmark/benchmark.h>

#include "acoustics/direct_echoes.hpp"
#include "core/pose.hpp"
#include "core/units.hpp"
#include "sampling/find_scatterers.hpp"
#include "scene/built_in_scenes.hpp"
#include "sonar/sonar_spec.hpp"

using namespace insonify;

namespace {

struct Harbour {
  SceneCloud scene = make_built_in_scene("harbour", {.points = 200000});
  Pose pose = pose_from_yaw_pitch_roll({0, 0, -3}, 0, radians(10), 0);
  SonarHead head;

  Harbour() {
    SonarSpec s;
    s.name = "bench";
    s.centre_frequency = 750e3;
    s.bandwidth = 30e3;
    s.beams = 512;
    s.field_of_view = radians(120);
    s.beam_width = radians(1);
    s.elevation_width = radians(20);
    s.min_range = 1;
    s.max_range = 40;
    head = make_head(s, 1500);
  }
  Scatterers find(const benchmark::State& state) const {
    SamplingOptions o;
    o.scatterers_per_cell = static_cast<double>(state.range(0));
    o.range_resolution = range_resolution(head.pulse, 1500);
    return find_scatterers(scene, pose, head.fan, head.gate, o).scatterers;
  }
};

const Harbour& harbour() {
  static const Harbour harbour;
  return harbour;
}

void find_scatterers_of_harbour(benchmark::State& state) {
  std::size_t found = 0;
  for (auto _ : state) found = harbour().find(state).size();
  state.counters["scatterers"] = static_cast<double>(found);
}
BENCHMARK(find_scatterers_of_harbour)->Arg(0)->Arg(10)->Unit(benchmark::kMillisecond)->UseRealTime();

void direct_echoes_of_harbour(benchmark::State& state) {
  const Scatterers scatterers = harbour().find(state);
  for (auto _ : state)
    benchmark::DoNotOptimize(direct_echoes(scatterers, harbour().scene.materials, harbour().head.pulse, Medium{},
                                           {.elevation_width = 0.35}));
  state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations() * scatterers.size()));
}
BENCHMARK(direct_echoes_of_harbour)->Arg(0)->Arg(10)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
