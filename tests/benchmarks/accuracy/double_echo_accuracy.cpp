// SPDX-License-Identifier: BSD-3-Clause
// Error against run time of echoes by way of two surfaces (E158): double_echo_accuracy [SURFELS], a table in Markdown
// (docs/results/double-echoes.md).
//
// Expected levels of their layer over a harbour, for several numbers of rays, against 64 rays per cell with other
// random numbers; and the time of a warm ping with speckle and detection.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>
#include <vector>

#include "../wide_head.hpp"
#include "core/stop_watch.hpp"
#include "core/units.hpp"
#include "scene/built_in_scenes.hpp"
#include "simulate/ping_simulator.hpp"

namespace {

using namespace insonify;

constexpr double rays_per_cell[] = {0.0625, 0.25, 1, 4, 16};
constexpr double reference_rays = 64;

/// Returns a head that resolves 12 cm, up to 30 m.
SonarHead head_of_12_cm() { return wide_head(6250, 30); }

const Pose pose = harbour_pose();

SimulationOptions options_with(double rays, std::uint64_t seed = 1) {
  SimulationOptions options;
  options.seed = seed;
  options.effects.double_echoes = rays;
  return options;
}

/// Expected levels of direct and double echoes.
struct Levels {
  Grid<double> direct, doubles;
};

Levels levels_of(const PreparedScene& scene, SimulationOptions options) {
  options.synthesis.method = SynthesisMethod::incoherent;
  options.outputs.layers = true;
  const Ping ping = PingSimulator(head_of_12_cm(), {}, options).ping(scene, {pose}).ping;
  const auto level = [&](std::size_t k) -> Grid<double> { return ping.layers.at(k).pressure.abs2().cast<double>(); };
  return {level(0), level(1)};
}

/// Returns the root mean square error of the whole image [dB], in cells where the double echoes are above the direct
/// ones less 20 dB.
double image_error(const Grid<double>& level, const Grid<double>& exact, const Grid<double>& direct) {
  double squares = 0, cells = 0;
  for (Eigen::Index i = 0; i < exact.size(); ++i) {
    const double d = direct.data()[i], e = exact.data()[i];
    if (!(e > 1e-2 * d) || e + d < 1e-6 * direct.maxCoeff()) continue;
    const double off = db_from_power((d + level.data()[i]) / (d + e));
    squares += off * off, ++cells;
  }
  return std::sqrt(squares / cells);
}

struct PingCost {
  double wall, cpu;  ///< medians of seven warm pings [ms]
  std::size_t echoes;
};

PingCost cost_of(const PreparedScene& scene, const SimulationOptions& options) {
  const PingSimulator simulator(head_of_12_cm(), {}, options);
  std::vector<double> wall, cpu;
  std::size_t echoes = 0;
  for (int k = 0; k < 8; ++k) {
    const std::clock_t begin = std::clock();
    StopWatch watch;
    const SimulatedPing ping = simulator.ping(scene, {pose});
    echoes = ping.report.layers.size() > 1 ? ping.report.layers[1].echoes : 0;
    if (k == 0) continue;
    wall.push_back(1e3 * watch.lap());
    cpu.push_back(1e3 * static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC);
  }
  std::sort(wall.begin(), wall.end()), std::sort(cpu.begin(), cpu.end());
  return {wall[3], cpu[3], echoes};
}

}  // namespace

int main(int argc, char** argv) {
  const std::size_t surfels = argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 1000000;
  const PreparedScene scene(make_built_in_scene("harbour", {.points = surfels}));
  StopWatch watch;
  scene.rays(SamplingOptions{}.footprint);
  std::printf("Tree of rays over %zu surfels: %.2f s.\n\n", scene.scene().size(), watch.lap());
  const Levels exact = levels_of(scene, options_with(reference_rays, 7));
  const Grid<double> exact_means = mean_of(exact.doubles, 8, 8), direct_means = mean_of(exact.direct, 8, 8);
  const PingCost alone = cost_of(scene, {});
  std::printf("Direct ping: %.0f ms, %.0f ms of CPU. All double echoes: %.2f dB re all direct ones.\n\n", alone.wall,
              alone.cpu, db_from_power(exact.doubles.sum() / exact.direct.sum()));
  std::printf(
      "| rays per cell | echoes | rms of cells [dB] | of means over 8 x 8 cells [dB] | total [dB] | wall [ms] | CPU "
      "[ms] | CPU over that of the direct ping |\n|---|---|---|---|---|---|---|---|\n");
  for (const double rays : rays_per_cell) {
    const Grid<double> level = levels_of(scene, options_with(rays)).doubles;
    const PingCost cost = cost_of(scene, options_with(rays));
    std::printf("| %.4g | %zu | %.2f | %.2f | %+.3f | %.0f | %.0f | %.2f |\n", rays, cost.echoes,
                image_error(level, exact.doubles, exact.direct),
                image_error(mean_of(level, 8, 8), exact_means, direct_means),
                db_from_power(level.sum() / exact.doubles.sum()), cost.wall, cost.cpu, cost.cpu / alone.cpu);
    std::fflush(stdout);
  }
}
