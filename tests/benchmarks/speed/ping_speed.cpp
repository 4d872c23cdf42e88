// SPDX-License-Identifier: BSD-3-Clause
// Times of warm pings of prepared scenes, as tables in Markdown (docs/results/speed.md):
//   ping_speed work [NAME]     some pings of the harbour of a million surfels: medians of five, or of eleven short ones
//   ping_speed presets [NAME]  every preset on harbour and plane: medians of three, of eleven short ones, or one if the first
//                              takes more than a second
//   ping_speed display [NAME [CELLS [DETAIL]]]  every preset as display images of 600 cells with noise, on the harbour, of
//                              surfels or of nodes so many beams wide: the same
// NAME: only those whose names contain it.
#include <algorithm>
#include <cstdio>
#include <ctime>
#include <functional>
#include <string>
#include <vector>

#include <sys/resource.h>

#include "../wide_head.hpp"
#include "core/stop_watch.hpp"
#include "core/units.hpp"
#include "files/peak_memory.hpp"
#include "scene/built_in_scenes.hpp"
#include "simulate/simulate_ping.hpp"
#include "store/sonar_file.hpp"

namespace {

using namespace insonify;

const Environment fresh_water{};

/// Wall and CPU time of a ping [s], pages that it fetched from the system, and its sizes.
struct PingTime {
  double wall = 0, cpu = 0;
  long pages = 0;
  StageSeconds stages;
  std::size_t scatterers = 0, samples = 0;
};

/// Returns the minor page faults of this process so far.
long page_faults() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return usage.ru_minflt;
}

PingTime time_ping(const PingSimulator& simulator, const PreparedScene& scene, const Pose& pose) {
  const std::clock_t begin = std::clock();
  const long pages = page_faults();
  StopWatch watch;
  const SimulatedPing result = simulator.ping(scene, {pose});
  PingTime time{watch.lap(),
                static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC,
                page_faults() - pages,
                result.report.seconds,
                result.report.sampling.scatterers,
                static_cast<std::size_t>(result.ping.pressure.size())};
  return time;
}

void sort_by_wall(std::vector<PingTime>& times) {
  std::sort(times.begin(), times.end(), [](const PingTime& a, const PingTime& b) { return a.wall < b.wall; });
}

/// Returns the median by wall time, after one ping that is not counted: of eleven if that takes less than 200 ms, of
/// one if it takes more than a second.
PingTime median_ping(int repeats, const PreparedScene& scene, const SonarHead& head, const Pose& pose,
                     const SimulationOptions& options = {}) {
  const PingSimulator simulator(head, fresh_water, options);
  const PingTime first = time_ping(simulator, scene, pose);
  if (first.wall < 0.2) repeats = 11;
  if (first.wall > 1) repeats = 1;
  std::vector<PingTime> times;
  for (int k = 0; k < repeats; ++k) times.push_back(time_ping(simulator, scene, pose));
  sort_by_wall(times);
  return times[times.size() / 2];
}

SonarHead preset(const std::string& name, double min_range, double max_range) {
  SonarSpec spec = find_sonar(name).spec;
  spec.min_range = min_range, spec.max_range = max_range;
  return make_head(spec, sound_speed(fresh_water.water));
}

void print_work(const std::string& name, const PingTime& t) {
  const double n = static_cast<double>(t.scatterers);
  std::printf("| %s | %zu | %zu | %.0f | %.0f | %.0f | %ld | %.0f / %.0f / %.0f |\n", name.c_str(), t.scatterers,
              t.samples, 1e3 * t.wall, 1e3 * t.cpu, 1e9 * t.cpu / n, t.pages,
              100 * (t.stages.sampling + t.stages.acoustics) / t.wall, 100 * t.stages.synthesis / t.wall,
              100 * t.stages.detection / t.wall);
  std::fflush(stdout);
}

void time_work(const std::string& part) {
  const SceneCloud scene = make_built_in_scene("harbour", {.points = 1000000});
  const PreparedScene harbour(scene);
  const Pose pose = harbour_pose();
  const SimulationOptions unsplit{.sampling = {.scatterers_per_cell = 0}},
      merged{.sampling = {.detail_width = usual_detail_width}};
  std::printf(
      "| warm ping with detection | scatterers | samples | wall [ms] | CPU [ms] | CPU per scatterer [ns] | page faults "
      "| "
      "sampling / synthesis / detection [%% of wall] |\n|---|---|---|---|---|---|---|---|\n");
  const auto time = [&](const std::string& name, const SonarHead& head, const SimulationOptions& options = {}) {
    if (name.find(part) != std::string::npos) print_work(name, median_ping(5, harbour, head, pose, options));
  };
  time("512 beams, 2.5 cm, 0.5:15 m", wide_head(30e3, 15));
  time("512 beams, 12 cm, 0.5:30 m", wide_head(6250, 30));
  time("512 beams, 12 cm, 0.5:30 m, unsplit", wide_head(6250, 30), unsplit);
  time("512 beams, 12 cm, 0.5:30 m, merged", wide_head(6250, 30), merged);
  SimulationOptions display, merged_display = merged;
  display.outputs.display_bins = merged_display.outputs.display_bins = 500;
  time("512 beams, 12 cm, 0.5:30 m, 500 display cells", wide_head(6250, 30), display);
  time("512 beams, 12 cm, 0.5:30 m, 500 display cells, merged", wide_head(6250, 30), merged_display);
  time("512 beams, 2.5 cm, 0.5:8 m, unsplit", wide_head(30e3, 8), unsplit);
  time("oculus-m750d, 0.5:30 m", preset("oculus-m750d", 0.5, 30));
  time("oculus-m750d, 0.5:40 m", preset("oculus-m750d", 0.5, 40));
  time("oculus-m1200d, 0.5:30 m", preset("oculus-m1200d", 0.5, 30));
  time("p900-45, 0.5:30 m", preset("p900-45", 0.5, 30));
  time("p900-45, 0.5:30 m, merged", preset("p900-45", 0.5, 30), merged);
  time("waterlinked-3d15, 0.3:15 m", preset("waterlinked-3d15", 0.3, 15));
}

/// Returns the pose of a preset in the harbour, as it is mounted.
Pose pose_of(const SonarFile& file) {
  const Eigen::Vector3d tilt = file.mounting.isZero(0) ? Eigen::Vector3d(0, radians(10), 0) : file.mounting;
  return pose_from_yaw_pitch_roll({5, 0, -3}, tilt.x(), tilt.y(), tilt.z());
}

void time_presets(const std::string& part) {
  const SceneCloud harbour = make_built_in_scene("harbour", {.points = 300000});
  SceneCloud plane = make_built_in_scene("plane", {.points = 300000, .size = {60, 60}});
  for (auto& point : plane.point) point.z() -= 8;
  const PreparedScene scenes[] = {PreparedScene(harbour), PreparedScene(plane)};
  std::printf(
      "| preset | range [m] | beams x bins | own rate [Hz] | harbour: scatterers | ms per ping | pings per second | "
      "real-time factor | CPU per scatterer [ns] | sampling / synthesis / detection [%% of wall] | plane: ms per ping "
      "| "
      "real-time factor |\n|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  int in_real_time = 0, all = 0;
  for (const SonarFile& file : list_sonars()) {
    if (file.spec.name.find(part) == std::string::npos) continue;
    const double far = std::min(file.spec.max_range, 30.0), near = std::min(file.spec.min_range, 0.5 * far);
    const SonarHead head = preset(file.spec.name, near, far);
    const Pose pose = pose_of(file);
    const double rate = std::min(10.0, sound_speed(fresh_water.water) / (2 * far));
    const PingTime over_harbour = median_ping(3, scenes[0], head, pose),
                   over_plane = median_ping(3, scenes[1], head, pose);
    const StageSeconds& stages = over_harbour.stages;
    const double percent = 100 / over_harbour.wall;
    std::printf(
        "| %s | %.3g:%.3g | %zu x %zu | %.3g | %zu | %.0f | %.3g | %.2f | %.0f | %.0f / %.0f / %.0f | %.0f | %.2f |\n",
        file.spec.name.c_str(), near, far, head.fan.beams(), head.gate.bins(), rate, over_harbour.scatterers,
        1e3 * over_harbour.wall, 1 / over_harbour.wall, 1 / (rate * over_harbour.wall),
        1e9 * over_harbour.cpu / static_cast<double>(over_harbour.scatterers),
        percent * (stages.sampling + stages.acoustics), percent * stages.synthesis, percent * stages.detection,
        1e3 * over_plane.wall, 1 / (rate * over_plane.wall));
    std::fflush(stdout);
    ++all, in_real_time += rate * over_harbour.wall <= 1;
  }
  std::printf("\n%d of %d presets keep their own rate on the harbour.\n", in_real_time, all);
}

/// A preset on the harbour, and the medians of its rounds.
struct DisplayedPreset {
  SonarFile file;
  double far, near;
  SonarHead head;
  std::vector<PingTime> rounds{};

  explicit DisplayedPreset(const SonarFile& of)
      : file(of),
        far(std::min(of.spec.max_range, 30.0)),
        near(std::min(of.spec.min_range, 0.5 * far)),
        head(preset(of.spec.name, near, far)) {}
};

/// Times display images of every preset on the harbour, by the rate of the sonar: in rounds over all presets, so that a
/// slow minute of the machine does not fall on one preset alone. Those that take more than a second get one round.
void time_display(const std::string& part, int cells, double detail) {
  constexpr int rounds = 5;
  const PreparedScene harbour(make_built_in_scene("harbour", {.points = 300000}));
  const SimulationOptions options{
      .sampling = {.detail_width = detail}, .effects = {.noise = true}, .outputs = {.display_bins = cells}};
  std::vector<DisplayedPreset> presets;
  for (const SonarFile& file : list_sonars())
    if (file.spec.name.find(part) != std::string::npos) presets.emplace_back(file);
  for (int k = 0; k < rounds; ++k)
    for (DisplayedPreset& p : presets)
      if (k == 0 || p.rounds[0].wall < 1) p.rounds.push_back(median_ping(3, harbour, p.head, pose_of(p.file), options));
  std::printf(
      "| preset | range [m] | beams x cells | scatterers | ms per image, median (fastest, slowest round) | CPU [ms] | "
      "real-time factor | sampling / echoes / drawing / detection [%% of wall] |\n|---|---|---|---|---|---|---|---|\n");
  int in_real_time = 0;
  for (DisplayedPreset& p : presets) {
    sort_by_wall(p.rounds);
    const PingTime& t = p.rounds[p.rounds.size() / 2];
    const double rate = std::min(10.0, sound_speed(fresh_water.water) / (2 * p.far)), percent = 100 / t.wall;
    std::printf("| %s | %.3g:%.3g | %zu x %d | %zu | %.0f (%.0f, %.0f) | %.0f | %.2f | %.0f / %.0f / %.0f / %.0f |\n",
                p.file.spec.name.c_str(), p.near, p.far, p.head.fan.beams(), cells, t.scatterers, 1e3 * t.wall,
                1e3 * p.rounds.front().wall, 1e3 * p.rounds.back().wall, 1e3 * t.cpu, 1 / (rate * t.wall),
                percent * t.stages.sampling, percent * t.stages.acoustics, percent * t.stages.synthesis,
                percent * t.stages.detection);
    in_real_time += rate * t.wall <= 1;
  }
  std::printf("\n%d of %zu presets keep their own rate as display images.\n", in_real_time, presets.size());
}

}  // namespace

int main(int argc, char** argv) {
  keep_freed_memory();
  const std::string what = argc > 1 ? argv[1] : "", part = argc > 2 ? argv[2] : "";
  if (what == "work") return time_work(part), 0;
  if (what == "presets") return time_presets(part), 0;
  if (what == "display")
    return time_display(part, argc > 3 ? std::stoi(argv[3]) : 600, argc > 4 ? std::stod(argv[4]) : 0), 0;
  std::fprintf(stderr, "ping_speed work|presets|display [NAME [CELLS [DETAIL]]]\n");
  return 2;
}
