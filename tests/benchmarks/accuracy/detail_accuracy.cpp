// SPDX-License-Identifier: BSD-3-Clause
// Error against run time of levels of detail (E137), as tables in Markdown and a picture (docs/results/detail.md):
//   detail_accuracy PICTURE.png [SCENE SURFELS]...   (harbour of 10^6 and 10^7 surfels, reef of 10^6)
//
// Expected levels of a built-in scene of so many surfels, merged up to several widths, against the same scene of four
// million with ten scatterers per cell; the time of a warm ping with speckle and detection; and the edges of shadows.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <map>
#include <numeric>
#include <string>
#include <vector>

#include "../compared_levels.hpp"
#include "../wide_head.hpp"
#include "core/stop_watch.hpp"
#include "core/units.hpp"
#include "scene/built_in_scenes.hpp"
#include "simulate/ping_simulator.hpp"
#include "support/shadow_edges.hpp"
#include "view/line_chart_internal.hpp"

namespace {

using namespace insonify;

constexpr double widths[] = {0, 0.125, 0.25, 0.5, 1, 2};  // [beam widths]

/// Returns a head that resolves 12 cm, up to 30 m.
SonarHead head_of_12_cm() { return wide_head(6250, 30); }

/// A scene with the pose of a head.
struct View {
  std::string scene;
  Pose pose = scene == "reef" ? pose_from_yaw_pitch_roll({-8, 0, 0}, 0, radians(10), 0) : harbour_pose();
  PreparedScene of(std::size_t surfels) const { return PreparedScene(make_built_in_scene(scene, {.points = surfels})); }
};

SimulatedPing expected_level(const PreparedScene& scene, const Pose& pose, const SonarHead& head,
                             const SamplingSettings& sampling) {
  const SimulationOptions options{.sampling = sampling, .synthesis = {.method = SynthesisMethod::incoherent}};
  return PingSimulator(head, {}, options).ping(scene, {pose});
}

/// Returns the median wall and CPU time [ms] of seven warm pings.
std::pair<double, double> time_of(const PreparedScene& scene, const Pose& pose, const SonarHead& head,
                                  const SamplingSettings& sampling) {
  const PingSimulator simulator(head, {}, {.sampling = sampling});
  std::vector<double> wall, cpu;
  for (int k = 0; k < 8; ++k) {
    const std::clock_t begin = std::clock();
    StopWatch watch;
    simulator.ping(scene, {pose});
    if (k == 0) continue;
    wall.push_back(1e3 * watch.lap());
    cpu.push_back(1e3 * static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC);
  }
  std::sort(wall.begin(), wall.end()), std::sort(cpu.begin(), cpu.end());
  return {wall[3], cpu[3]};
}

/// Prints one row for each width. Returns error [dB] against run time [ms].
ChartLine print_rows(const View& view, std::size_t surfels, const Grid<double>& exact) {
  const PreparedScene scene = view.of(surfels);
  const SonarHead head = head_of_12_cm();
  const double millions = 1e-6 * static_cast<double>(surfels);
  char name[64];
  std::snprintf(name, sizeof name, "%s, %.3g million surfels", view.scene.c_str(), millions);
  ChartLine line{{}, {}, name, LineStyle::marked};
  for (const double width : widths) {
    const SamplingSettings sampling{.detail_width = width};
    const SimulatedPing ping = expected_level(scene, view.pose, head, sampling);
    const Grid<double> level = ping.ping.pressure.abs2().cast<double>();
    const auto [cells, far] = difference(level, exact);
    const auto [wall, cpu] = time_of(scene, view.pose, head, sampling);
    const SamplingReport& s = ping.report.sampling;
    std::printf("| %.3g million | %.3g | %zu | %zu | %.2f | %.2f | %.2f | %+.3f | %+.2f | %.0f | %.0f |\n", millions,
                width, s.in_gate, s.scatterers, cells, difference(mean_of(level, 8, 4), mean_of(exact, 8, 4)).first,
                100 * far, db_from_power(level.sum() / exact.sum()), worst_band(level, exact), wall, cpu);
    std::fflush(stdout);
    char label[16];
    std::snprintf(label, sizeof label, "%.3g", width);
    line.x.push_back(cells), line.y.push_back(wall), line.labels.emplace_back(label);
  }
  return line;
}

void print_edges() {
  std::printf("\n| widest node [beam widths] | mean | median | 95 %% |\n|---|---|---|---|\n");
  for (const double width : widths) {
    const std::vector<double> off = shadow_edge_errors({.detail_width = width}, true);
    std::printf("| %.3g | %+.1f | %.1f | %.1f |\n", width,
                std::accumulate(off.begin(), off.end(), 0.0) / static_cast<double>(off.size()),
                std::abs(off[off.size() / 2]), std::abs(off[off.size() * 95 / 100]));
  }
}

void draw(std::vector<ChartLine> lines, const std::string& path) {
  LineChart chart;
  chart.title = "Levels of detail: error against run time, by width of the widest node [beams]";
  chart.x_title = "Error of the expected level of a cell, rms [dB]", chart.y_title = "Wall time of a warm ping [ms]";
  chart.low_y = 100, chart.high_y = 100;
  for (const ChartLine& line : lines) {
    chart.high_x = std::max(chart.high_x, 1.1 * *std::max_element(line.x.begin(), line.x.end()));
    chart.low_y = std::min(chart.low_y, 0.8 * *std::min_element(line.y.begin(), line.y.end()));
    chart.high_y = std::max(chart.high_y, 1.2 * *std::max_element(line.y.begin(), line.y.end()));
  }
  chart.lines = std::move(lines);
  chart.y_scale = AxisScale::logarithmic;
  PictureOptions options;
  options.width = 1100, options.height = 700;
  draw_line_chart(chart, options, "detail_accuracy", path);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) return std::fprintf(stderr, "detail_accuracy PICTURE.png [SCENE SURFELS]...\n"), 2;
  std::vector<std::pair<std::string, std::size_t>> requested;
  for (int k = 2; k + 1 < argc; k += 2) requested.emplace_back(argv[k], std::strtoull(argv[k + 1], nullptr, 10));
  if (requested.empty()) requested = {{"harbour", 1000000}, {"harbour", 10000000}, {"reef", 1000000}};
  std::vector<ChartLine> lines;
  std::map<std::string, Grid<double>> exact;
  for (const auto& [scene, surfels] : requested) {
    const View view{scene};
    if (!exact.count(scene)) {
      exact[scene] = expected_level(view.of(4000000), view.pose, head_of_12_cm(), {.scatterers_per_cell = 10})
                         .ping.pressure.abs2()
                         .cast<double>();
      std::printf(
          "\n%s:\n\n| surfels | widest node [beam widths] | surfels and nodes in view | scatterers | rms of cells [dB] "
          "| "
          "of means over 8 beams x 4 bins [dB] | cells off by 10 dB [%%] | total [dB] | worst band [dB] | wall [ms] | "
          "CPU [ms] |\n|---|---|---|---|---|---|---|---|---|---|---|\n",
          scene.c_str());
    }
    lines.push_back(print_rows(view, surfels, exact.at(scene)));
  }
  print_edges();
  draw(std::move(lines), argv[1]);
}
