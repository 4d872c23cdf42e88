// SPDX-License-Identifier: BSD-3-Clause
// True delays (E68) against element by element: true_delays_accuracy [HEAD] prints the table of
// docs/results/accuracy.md, one row for each head, direction and range, and one for each head above a rough height
// field. Never asserted.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <string>
#include <utility>
#include <vector>

#include "accuracy/accuracy_task.hpp"
#include "beamforming/gridded/gridded_engine.hpp"
#include "beamforming/reference/element_series.hpp"
#include "beamforming/true_delays/true_delay_engine.hpp"
#include "core/random.hpp"
#include "core/units.hpp"
#include "store/sonar_file.hpp"

namespace {

using namespace insonify;

constexpr double c = 1500;
constexpr std::size_t checked_beams = 24, few = 100, some_of_field = 3000, many = 200000;
constexpr int repeats = 7;

/// Returns echoes within ten degrees of `azimuth`, all over the gate.
Echoes patch(const SonarHead& head, double azimuth, std::size_t count) {
  Echoes echoes;
  for (std::size_t i = 0; i < count; ++i) {
    const auto at = random_uniform(3, RandomStage::scene_points, {i, 0, 0});
    echoes.delay.push_back(2 * (head.gate.min_range + at[0] * (head.gate.max_range - head.gate.min_range)) / c);
    echoes.u.push_back(std::sin(azimuth + radians(10) * (2 * at[1] - 1)));
    echoes.amplitude.push_back(random_complex_normal(3, RandomStage::noise, {i, 0, 0}));
  }
  return echoes;
}

/// Relative L2 error of selected beams against the sum over each element.
struct Referee {
  std::vector<std::size_t> beams;
  ComplexGrid image;

  Referee(const Echoes& echoes, const SonarHead& head, const Medium& medium)
      : beams(picked(head.fan.beams(), std::min(checked_beams, head.fan.beams()))) {
    const SonarHead some = some_beams(head, beams.size());
    const ElementOptions options{1e-7};
    image = beam_from_elements(element_series(echoes, some, medium, options), some, medium, options);
  }
  double error(const ComplexGrid& other) const {
    double sum = 0;
    for (std::size_t b = 0; b < beams.size(); ++b) sum += (other.row(beams[b]) - image.row(b)).abs2().sum();
    return std::sqrt(sum / image.abs2().sum());
  }
};

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

double cpu_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// Prints the CPU time of an image by both methods, one after the other, on one thread.
void print_times(const Echoes& echoes, const SonarHead& head, const Medium& medium) {
  const GriddedEngine narrow(head, medium, {1e-3, 1});
  for (const double tolerance : {1e-3, 1e-4}) {
    const TrueDelayEngine wide(head, medium, {tolerance, 1});
    std::vector<double> narrow_seconds, wide_seconds;
    for (int k = 0; k < repeats; ++k) {
      const double start = cpu_seconds();
      (void)narrow.pressure(echoes);
      const double middle = cpu_seconds();
      (void)wide.pressure(echoes);
      narrow_seconds.push_back(middle - start);
      wide_seconds.push_back(cpu_seconds() - middle);
    }
    std::printf(" %.1f | %.1f | %.2f |", 1e3 * median(narrow_seconds), 1e3 * median(wide_seconds),
                median(wide_seconds) / median(narrow_seconds));
  }
  std::printf("\n");
}

void print_errors(const Echoes& echoes, const SonarHead& head, const Medium& medium) {
  const Referee referee(echoes, head, medium);
  std::printf(" %.2g |", referee.error(synthesize_gridded(echoes, head, medium, {1e-6, 1})));
  for (const double tolerance : {1e-3, 1e-4})
    std::printf(" %.2g |", referee.error(TrueDelayEngine(head, medium, {tolerance, 1}).pressure(echoes)));
  std::fflush(stdout);
}

void print_head(const std::string& name, double azimuth_in, double range) {
  SonarHead head = make_head(find_sonar(name).spec, c);
  const double edge = *std::max_element(head.fan.azimuth.begin(), head.fan.azimuth.end());
  if (azimuth_in > edge + radians(10)) return;
  const double azimuth = std::min(azimuth_in, edge);
  const Medium medium{c, {0.01, 0, 0}};
  std::printf("| %s | %.0f | %.3g |", name.c_str(), degrees(azimuth), range);
  const double bin = head.gate.bin_size, half = std::min(0.25 * range, 60 * bin);
  head.gate = {range - half, range + half, bin};
  print_errors(patch(head, azimuth, few), head, medium);
  head.gate = {0.75 * range, 1.25 * range, bin};
  print_times(patch(head, azimuth, many), head, medium);
}

/// Returns 10 m by 10 m of hills, ripples, and roughness at its own spacing of 2 cm, like a scanned reef.
SceneCloud rough_bed() {
  constexpr double cell = 0.02, rough = 0.015;
  constexpr int nodes = 500;
  const auto height = [](int i, int j) {
    const double x = cell * i, y = cell * j;
    const auto at = random_uniform(7, RandomStage::scene_points, {static_cast<std::uint64_t>(i * nodes + j), 0, 0});
    return 0.4 * std::sin(1.1 * x + 0.4 * y) + 0.1 * std::sin(5.3 * y - 2.7 * x) + rough * (2 * at[0] - 1);
  };
  SceneCloud scene;
  for (int i = 1; i + 1 < nodes; ++i)
    for (int j = 1; j + 1 < nodes; ++j) {
      const Eigen::Vector3d normal(height(i - 1, j) - height(i + 1, j), height(i, j - 1) - height(i, j + 1), 2 * cell);
      add_surfel(scene, {cell * i, cell * j - 5, height(i, j)}, normal.normalized(), cell * normal.norm() / 2);
    }
  return scene;
}

/// Compares all surfels that the head sees of the field from 2 m above it, each as one echo.
void print_field(const std::string& name, const SceneCloud& field) {
  SonarHead head = make_head(find_sonar(name).spec, c);
  head.gate.min_range = 1;
  head.gate.max_range = 5;
  SimulationOptions options;
  options.sampling.scatterers_per_cell = 0;
  const AccuracyTask task = task_of(field, head, pose_from_yaw_pitch_roll({1, 0, 2}, 0, radians(35), 0), {}, options);
  std::printf("| %s | rough field, %zu echoes | 1 to 5 |", name.c_str(), task.echoes.size());
  print_errors(some_echoes(task.echoes, some_of_field), task.head, task.medium);
  print_times(task.echoes, task.head, task.medium);
}

}  // namespace

int main(int argc, char** argv) {
  const std::string only = argc > 1 ? argv[1] : "";
  std::printf(
      "| head | direction [deg] | range [m] | narrow band: error | 1e-3: error | 1e-4: error | narrow band [ms] | 1e-3 "
      "[ms] "
      "| ratio | narrow band [ms] | 1e-4 [ms] | ratio |\n|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  const SceneCloud field = rough_bed();
  for (const char* name : {"oculus-m750d", "em2040", "aris-3000", "p900-45"})
    if (only.empty() || only == name) {
      for (const double degree : {0.0, 30.0, 60.0})
        for (const double range : {1.0, 5.0, 20.0}) print_head(name, radians(degree), range);
      print_field(name, field);
    }
}
