#include "plan_costs.hpp"

#include <ctime>

#include "core/units.hpp"
#include "files/peak_memory.hpp"
#include "scene/built_in_scenes.hpp"
#include "store/sonar_file.hpp"

namespace insonify {

std::vector<PlanCase> cost_cases() {
  std::vector<PlanCase> cases;
  const Environment water;
  const auto add = [&](const char* what, const char* scene, std::size_t points, const char* sonar, double near,
                       double far, double per_cell, SynthesisMethod method = SynthesisMethod::gridded) {
    SonarSpec spec = find_sonar(sonar).spec;
    spec.min_range = near, spec.max_range = far;
    const bool harbour = scene == std::string("harbour");
    PlanCase& c =
        cases.emplace_back(PlanCase{what,
                                    sonar,
                                    make_built_in_scene(scene, {.points = points, .size = {20, 20}}),
                                    make_head(spec, sound_speed(water.water)),
                                    {pose_from_yaw_pitch_roll({0, 0, harbour ? -3.0 : 3.0}, 0, radians(15), 0)},
                                    water,
                                    {}});
    c.options.threads = 1;
    c.options.sampling.scatterers_per_cell = per_cell;
    c.options.synthesis = {.method = method, .true_delays = Choice::never};
  };
  using enum SynthesisMethod;
  add("many scatterers", "plane", 100000, "p900-45", 4, 12, 10);
  add("large scene", "harbour", 1000000, "oculus-m750d", 0.5, 20, 0);
  add("large image", "harbour", 60000, "oculus-m750d", 0.5, 60, 0);
  add("scanning head", "harbour", 200000, "imagenex-881l", 0.5, 20, 1);
  add("many bins", "harbour", 200000, "gemini-720im", 1, 20, 1);
  add("incoherent", "harbour", 100000, "gemini-720im", 1, 20, 1, incoherent);
  add("direct", "plane", 2000, "gemini-720im", 4, 7, 0, direct);
  add("element-exact", "plane", 2000, "gemini-720im", 4, 7, 0, element_exact);
  add("true delays", "harbour", 100000, "gemini-720im", 1, 20, 1, true_delays);
  add("true delays of many", "plane", 100000, "p900-45", 4, 12, 10, true_delays);
  add("true delays, large image", "harbour", 60000, "oculus-m750d", 0.5, 60, 0, true_delays);
  add("true delays, long array", "harbour", 60000, "aris-3000", 1, 10, 1, true_delays);
  add("true delays, planar array", "plane", 20000, "waterlinked-3d15", 3, 6, 0, true_delays);
  return cases;
}

PlanCost measure_cost(const PlanCase& c) {
  const PingPlan plan = plan_ping(c.cloud, c.head, c.event, c.environment, c.options);
  forget_peak_memory();
  const double before = peak_memory_mib();
  const std::clock_t start = std::clock();
  const SimulatedPing ping = simulate_ping(c.cloud, c.head, c.event.world_from_head, c.environment, plan.options);
  const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  return {c.scene,
          plan.seconds,
          seconds,
          plan.mib,
          peak_memory_mib() - before,
          plan.scatterers,
          static_cast<double>(ping.report.sampling.scatterers)};
}

}  // namespace insonify
