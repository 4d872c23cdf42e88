// SPDX-License-Identifier: BSD-3-Clause
// Time of one ping of a prepared harbour, as a table in Markdown: sampling_speed [REPEATS [MOST_POINTS]].
//
// Medians and quartiles of wall times and medians of CPU times, warm. Gates are chosen so that each row holds the
// scatterers it names.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include "acoustics/direct_echoes.hpp"
#include "beamforming/gridded/gridded_engine.hpp"
#include "beamforming/head_patterns.hpp"
#include "core/units.hpp"
#include "sampling/find_scatterers.hpp"
#include "scene/built_in_scenes.hpp"
#include "sonar/elevation_pattern.hpp"
#include "sonar/sonar_spec.hpp"

namespace {

using namespace insonify;

const Pose pose = pose_from_yaw_pitch_roll({0, 0, -3}, 0, radians(10), 0);
const Medium water{};

// A forward-looking head of 512 beams x 130 x 20 degrees at 750 kHz, resolving 2.5 cm.
SonarHead head_to(double max_range) {
  SonarSpec spec;
  spec.name = "bench";
  spec.centre_frequency = 750e3;
  spec.bandwidth = 30e3;
  spec.beams = 512;
  spec.field_of_view = radians(130);
  spec.beam_width = radians(1);
  spec.elevation_width = radians(20);
  spec.min_range = 1;
  spec.max_range = max_range;
  return make_head(spec, water.sound_speed);
}

SamplingOptions options_for(const SonarHead& head, double per_cell, int threads) {
  SamplingOptions options;
  options.scatterers_per_cell = per_cell;
  options.range_resolution = range_resolution(head.pulse, water.sound_speed);
  options.elevation_half_extent = sampled_half_extent(head, -40);
  options.threads = threads;
  return options;
}

std::size_t count(const PreparedScene& scene, double max_range, double per_cell) {
  const SonarHead head = head_to(max_range);
  return find_scatterers(scene, pose, head.fan, head.gate, options_for(head, per_cell, 0)).scatterers.size();
}

// Returns the x at which f, which grows with x, reaches `wanted`, within 3 %.
double solve(double low, double high, double wanted, const std::function<std::size_t(double)>& f) {
  for (int step = 0; step < 24; ++step) {
    const double middle = (low + high) / 2, found = static_cast<double>(f(middle));
    if (std::abs(found / wanted - 1) < 0.03) return middle;
    (found < wanted ? low : high) = middle;
  }
  return (low + high) / 2;
}

// Wall times of one stage, and CPU times of all its threads, one entry per repeat [ms].
struct Times {
  std::vector<double> ms, cpu;

  template <typename Work>
  auto measure(Work&& work) {
    const auto start = std::chrono::steady_clock::now();
    const std::clock_t cpu_start = std::clock();
    auto result = work();
    ms.push_back(std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
    cpu.push_back(1e3 * static_cast<double>(std::clock() - cpu_start) / CLOCKS_PER_SEC);
    return result;
  }
  void forget() {
    ms.clear();
    cpu.clear();
  }
  double median_cpu() {
    std::sort(cpu.begin(), cpu.end());
    return cpu[cpu.size() / 2];
  }
  std::string text() {
    std::sort(ms.begin(), ms.end());
    const auto at = [&](double q) {
      return ms[static_cast<std::size_t>(q * static_cast<double>(ms.size() - 1) + 0.5)];
    };
    char cell[64];
    std::snprintf(cell, sizeof cell, "%.1f (%.1f .. %.1f)", at(0.5), at(0.25), at(0.75));
    return cell;
  }
};

void print_row(const char* name, const PreparedScene& scene, double max_range, double per_cell, int repeats) {
  const SonarHead head = head_to(max_range);
  const GriddedEngine synthesizer(head, water, {1e-4, 0});
  const EchoOptions echo_options = with_patterns({}, head);
  Times one_core, sampling, sound, ping;
  SamplingReport report;
  for (int r = -1; r < repeats; ++r) {  // the first, cold one does not count
    if (r == 0)
      for (Times* t : {&one_core, &sampling, &sound, &ping}) t->forget();
    one_core.measure([&] { return find_scatterers(scene, pose, head.fan, head.gate, options_for(head, per_cell, 1)); });
    ping.measure([&] {
      const Sampling seen = sampling.measure(
          [&] { return find_scatterers(scene, pose, head.fan, head.gate, options_for(head, per_cell, 0)); });
      report = seen.report;
      return sound.measure([&] {
        return synthesizer.pressure(
            direct_echoes(seen.scatterers, scene.scene().materials, head.pulse, water, echo_options));
      });
    });
  }
  std::printf("| %zu | %s | %.1f | %zu | %zu | %zu | %s | %s | %.1f | %s | %s | %.1f |\n", report.surfels, name,
              max_range, report.in_gate, report.visible, report.scatterers, one_core.text().c_str(),
              sampling.text().c_str(), sampling.median_cpu(), sound.text().c_str(), ping.text().c_str(),
              ping.median_cpu());
  std::fflush(stdout);
}

// Returns the harbour, and `copies` more of it far out of reach.
SceneCloud with_far_copies(const SceneCloud& harbour, int copies) {
  SceneCloud scene = harbour;
  for (int c = 1; c <= copies; ++c)
    for (std::size_t i = 0; i < harbour.size(); ++i)
      add_surfel(scene, harbour.origin + harbour.point[i].cast<double>() + Eigen::Vector3d(0, 200.0 * c, 0),
                 harbour.normal[i].cast<double>(), harbour.area[i], harbour.material[i]);
  return scene;
}

void print_rows(const SceneCloud& scene, double view_of_50000, int repeats) {
  const PreparedScene prepared(scene);
  const double split = solve(2, 60, 7e5, [&](double range) { return count(prepared, range, 10); });
  print_row("split, 10 per cell", prepared, split, 10, repeats);
  print_row("unsplit, one view", prepared, view_of_50000, 0, repeats);
}

}  // namespace

int main(int argc, char** argv) {
  const int repeats = argc > 1 ? std::max(1, std::atoi(argv[1])) : 15;
  const double most_points = argc > 2 ? std::atof(argv[2]) : 1e7;
  double load[3] = {0, 0, 0};
  if (getloadavg(load, 3) < 1) load[0] = 0;
  std::printf("%u cores, load average %.1f, %d repeats: median (quartiles) [ms].\n\n",
              std::thread::hardware_concurrency(), load[0], repeats);
  std::puts(
      "| surfels in the scene | ping | gate, m | in gate | seen | scatterers | sampling, 1 core | sampling, all cores "
      "| its CPU time | echoes and synthesis | ping | its CPU time "
      "|\n|---|---|---|---|---|---|---|---|---|---|---|---|");

  const SceneCloud harbour = make_built_in_scene("harbour", {.points = 1000000});
  const PreparedScene prepared(harbour);
  const double view = solve(2, 60, 5e4, [&](double range) { return count(prepared, range, 0); });
  const double per_cell = solve(0.01, 10, 7e5, [&](double n) { return count(prepared, 25, n); });
  print_row("split, whole view", prepared, 25, per_cell, repeats);
  for (const double points : {1e5, 1e6, 1e7})
    if (points <= most_points)
      print_rows(make_built_in_scene("harbour", {.points = static_cast<std::size_t>(points)}), view, repeats);
  if (most_points >= 1e7) print_rows(with_far_copies(harbour, 9), view, repeats);
}
