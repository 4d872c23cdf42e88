// True delays (E68) against element by element: true_delays_accuracy [SCENE.pcd | HEAD] prints the table of
// docs/accuracy.md, one row for each head, direction and range, or for the scene. Never asserted.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <string>
#include <utility>
#include <vector>

#include "accuracy/accuracy_task.hpp"
#include "beamforming/element_series.hpp"
#include "beamforming/ping_synthesizer.hpp"
#include "beamforming/wideband_synthesizer.hpp"
#include "core/random.hpp"
#include "core/units.hpp"
#include "scene_io/load_scene.hpp"
#include "store/sonar_file.hpp"

namespace {

using namespace insonify;

constexpr double c = 1500;
constexpr std::size_t checked_beams = 24, few = 100, many = 200000;
constexpr int repeats = 3;

/// Echoes within ten degrees of `azimuth`, all over the gate.
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

/// Relative L2 error of the beams picked, against each element summed.
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

/// Processor time of an image by both methods, one after the other, on one thread.
void print_times(const Echoes& echoes, const SonarHead& head, const Medium& medium) {
  const PingSynthesizer narrow(head, medium, {1e-3, 1});
  for (const double tolerance : {1e-3, 1e-4}) {
    const WidebandSynthesizer wide(head, medium, {tolerance, 1});
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
    std::printf(" %.2g |", referee.error(synthesize_true_delays(echoes, head, medium, {tolerance, 1})));
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

void print_scene(const std::string& path) {
  SonarHead head = make_head(find_sonar("oculus-m750d").spec, c);
  head.gate.min_range = 0.5;
  head.gate.max_range = 9;
  SimulationOptions options;
  options.sampling.scatterers_per_cell = 0;
  const AccuracyTask task =
      task_of(load_scene(path).scene, head, pose_from_yaw_pitch_roll({-1, 4, -2.2}, 0, radians(15), 0), {}, options);
  std::printf("| reef, %zu echoes | | 0.5 to 9 |", task.echoes.size());
  const Echoes some = some_echoes(task.echoes, 5000);
  print_errors(some, task.head, task.medium);
  print_times(task.echoes, task.head, task.medium);
}

}  // namespace

int main(int argc, char** argv) {
  const std::string only = argc > 1 ? argv[1] : "";
  std::printf(
      "| head | direction [deg] | range [m] | narrow band: error | 1e-3: error | 1e-4: error | narrow band [ms] | 1e-3 "
      "[ms] "
      "| ratio | narrow band [ms] | 1e-4 [ms] | ratio |\n|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  if (only.find(".pcd") != std::string::npos) return print_scene(only), 0;
  for (const char* name : {"oculus-m750d", "em2040", "aris-3000", "p900-45"})
    if (only.empty() || only == name)
      for (const double degree : {0.0, 30.0, 60.0})
        for (const double range : {1.0, 5.0, 20.0}) print_head(name, radians(degree), range);
}
