// SPDX-License-Identifier: BSD-3-Clause
// Display cells without samples (E180 to E184) against means of samples, and their time, as tables in Markdown
// (docs/results/display.md):
//   display_accuracy scenes [SEEDS [SCENE|SONAR]]  level, contrast and likeness, by scene and head, with noise (64 seeds)
//   display_accuracy cells [SEEDS [PICTURE.png]]   error and CPU time by number of cells (12 seeds)
//   display_accuracy motion [PAIRS [SCENE|SONAR]]  how alike images are after a move (8 pairs)
//   display_accuracy paths [SEEDS]    levels of echoes by way of other surfaces (8 seeds)
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "display_comparison.hpp"
#include "display_scenes.hpp"
#include "view/line_chart_internal.hpp"

namespace {

using namespace insonify;

constexpr const char* compared_sonars[] = {"oculus-m750d",     "p900-45",  "gemini-720is",
                                           "gemini-1200ik-hf", "m900-130", "oculus-m1200d"};

/// Correlations of beams 1, 2, 3 and 4 apart, and of cells side by side, in the images of all seeds.
struct Likeness {
  double beams[4] = {}, next_cell = 0;
};
Likeness likeness_of(const Moments& m, Beams among) {
  Likeness of;
  for (const Grid<float>& image : m.images) {
    const double part = 1 / static_cast<double>(m.images.size());
    for (Eigen::Index apart = 1; apart <= 4; ++apart)
      of.beams[apart - 1] += part * correlation(image, image, m.mean, apart, 0, among);
    of.next_cell += part * correlation(image, image, m.mean, 0, 1, among);
  }
  return of;
}

void print_likeness(const Likeness& drawn, const Likeness& samples) {
  for (std::size_t k = 0; k < 4; ++k)
    std::printf("%s%.2f / %.2f", k == 0 ? " " : ", ", drawn.beams[k], samples.beams[k]);
  std::printf(" | %.2f / %.2f |", drawn.next_cell, samples.next_cell);
}

/// A head with 100 cells at 3 to 8 m in one of the scenes that are compared.
Rig rig_of(const View& view, const char* sonar, bool noise) {
  Rig rig{PreparedScene(scene_of(view, view.points)), head_of(sonar, 3, 8), 100, noise};
  if (view.scene == "reef in a tank") rig.environment = tank(), rig.effects.mirrors = Choice::always;
  return rig;
}

/// Prints a row of print_scenes.
void print_scene(const View& view, const char* sonar, int seeds) {
  const Rig rig = rig_of(view, sonar, true);
  const Moments a = moments_of(rig, false, view.pose(), seeds, Images::kept),
                b = moments_of(rig, true, view.pose(), seeds, Images::kept);
  const Difference d = difference(a, b, seeds);
  const BandDifference band = band_difference(a, b);
  std::printf("| %s | %s%s | %+.3f (%.3f) | %+.3f (%.3f) | %.3f | %.2f | %.1f | %.3f / %.3f | %.3f / %.3f |",
              view.scene.c_str(), sonar, a.drawn ? "" : " (samples)", d.total, sampling_error_db(a.sums, b.sums),
              band.worst, band.worst_error, band.rms, d.rms, d.off, d.contrast[0], d.contrast[1], d.middle[0],
              d.middle[1]);
  for (const Beams among : {Beams::all, Beams::middle_half})
    print_likeness(likeness_of(a, among), likeness_of(b, among));
  std::printf(" %.3f (%.3f) | %.3f / %.3f |\n", largest_distance(relative_levels(a), relative_levels(b)),
              largest_distance(relative_levels(b, 0, 2), relative_levels(b, 1, 2)), a.median_cpu(), b.median_cpu());
  std::fflush(stdout);
}

void print_scenes(int seeds, const std::string& only) {
  std::puts(
      "| scene | sonar | total [dB] | worst band [dB] | rms of bands [dB] | rms of cells [dB] | cells off by 1 dB [%] "
      "| contrast: drawn / "
      "samples | in the middle half of the beams | beams 1, 2, 3, 4 apart | next cell | beams of the middle half | "
      "next cell there | KS distance | CPU [s] |");
  std::puts("|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|");
  for (const View& view : compared_views())
    for (const char* sonar : compared_sonars)
      if (only.empty() || only == view.scene || only == sonar) print_scene(view, sonar, seeds);
}

/// CPU time [s] of images of so many cells, and the error of drawn ones in words.
struct CellCurve {
  std::vector<double> cells, drawn, samples;
  std::vector<std::string> errors;
};

void draw_curve(const CellCurve& curve, const std::string& path) {
  LineChart chart;
  chart.title = "Display cells: CPU time and error of the expected level of a cell, by number of cells";
  chart.x_title = "Cells along range", chart.y_title = "CPU time of an image [s]";
  chart.lines = {{curve.cells, curve.drawn, "drawn, with the rms error of cells", LineStyle::marked, curve.errors},
                 {curve.cells, curve.samples, "means of samples", LineStyle::marked}};
  chart.low_x = 0.8 * curve.cells.front(), chart.high_x = 1.25 * curve.cells.back();
  chart.low_y = 0.8 * *std::min_element(curve.drawn.begin(), curve.drawn.end());
  chart.high_y = 1.5 * *std::max_element(curve.samples.begin(), curve.samples.end());
  chart.x_scale = chart.y_scale = AxisScale::logarithmic;
  PictureOptions options;
  options.width = 1100, options.height = 700;
  draw_line_chart(chart, options, "display_accuracy", path);
}

void print_cells(int seeds, const std::string& picture) {
  std::puts(
      "| cells | samples a cell | rms of cells [dB] | worst band [dB] | contrast drawn / of samples | CPU drawn / of "
      "samples "
      "[s] |");
  std::puts("|---|---|---|---|---|---|");
  const View& view = view_of("harbour");
  Rig rig{PreparedScene(scene_of(view, view.points)), head_of("oculus-m750d", 0.1, 30), 0, false};
  const int bins = static_cast<int>(rig.head.gate.bins());
  CellCurve curve;
  for (const int cells : {100, 200, 400, 600, 1200, 2400, bins / 4, bins}) {
    rig.cells = cells;
    const Moments a = moments_of(rig, false, view.pose(), seeds), b = moments_of(rig, true, view.pose(), seeds);
    const Difference d = difference(a, b, seeds);
    const BandDifference band = band_difference(a, b);
    std::printf("| %d%s | %.1f | %.2f | %+.3f (%.3f) | %.3f / %.3f | %.3f / %.3f |\n", cells,
                a.drawn ? "" : " (samples)", static_cast<double>(bins) / cells, d.rms, band.worst, band.worst_error,
                d.contrast[0], d.contrast[1], a.median_cpu(), b.median_cpu());
    std::fflush(stdout);
    char error[16];
    std::snprintf(error, sizeof error, "%.2f dB", d.rms);
    curve.cells.push_back(cells), curve.drawn.push_back(a.median_cpu()), curve.samples.push_back(b.median_cpu());
    curve.errors.emplace_back(error);
  }
  if (!picture.empty()) draw_curve(curve, picture);
}

/// Prints a row of print_motion.
void print_moves(const View& view, const char* sonar, int pairs) {
  const double moves[][3] = {{0, 0.01, 0}, {0, 0.03, 0}, {0, 0.1, 0}, {0.01, 0, 0},
                             {0.03, 0, 0}, {0.1, 0, 0},  {0, 0, 0.1}};  // ahead and aside [m], turn [deg]
  constexpr std::size_t count = std::size(moves);
  const Rig rig = rig_of(view, sonar, false);
  if (view.scene == "harbour") pairs *= 4;                             // a quarter of its cells hear the bed
  if (view.scene == "reef in a tank") pairs = std::max(2, pairs / 2);  // its samples take seconds
  Changes changes[2][count];
  for (const bool phases : {false, true})
    for (int seed = 1; seed <= pairs; ++seed) {
      const auto image = [&](const Pose& pose) {
        return rig.ping(phases, static_cast<std::uint64_t>(seed), pose).intensity;
      };
      const Grid<double> before = image(view.pose());
      for (std::size_t k = 0; k < count; ++k)
        changes[phases ? 1 : 0][k].add(before, image(view.pose(moves[k][0], moves[k][1], moves[k][2])));
    }
  std::printf("| %s | %s |", view.scene.c_str(), sonar);
  double off[2] = {0, 0};
  for (std::size_t k = 0; k < count; ++k) {
    const auto after = [&](int phases, Beams among) { return changes[phases][k].correlation(among); };
    std::printf(" %.2f / %.2f |", after(0, Beams::middle_half), after(1, Beams::middle_half));
    for (const Beams among : {Beams::middle_half, Beams::all}) {
      double& most = off[among == Beams::all ? 1 : 0];
      most = std::max(most, std::abs(after(0, among) - after(1, among)));
    }
  }
  std::printf(" %.2f | %.2f |\n", off[0], off[1]);
  std::fflush(stdout);
}

void print_motion(int pairs, const std::string& only) {
  std::puts(
      "| scene | sonar | 1 cm aside | 3 cm | 10 cm | 1 cm ahead | 3 cm | 10 cm | 0.1 deg of yaw | most apart | of all "
      "beams |");
  std::puts("|---|---|---|---|---|---|---|---|---|---|---|");
  for (const View& view : compared_views())
    for (const char* sonar : compared_sonars)
      if (only.empty() || only == view.scene || only == sonar) print_moves(view, sonar, pairs);
}

/// Prints a row of print_paths.
void print_paths_of(const char* name, const char* scene, const Environment& environment, const EffectSettings& effects,
                    int seeds) {
  const View& view = view_of(scene);
  const Rig rig{PreparedScene(scene_of(view, 100000)), head_of("oculus-m750d", 3, 8), 100, false, environment, effects};
  const Moments a = moments_of(rig, false, view.pose(), seeds), b = moments_of(rig, true, view.pose(), seeds);
  const Difference d = difference(a, b, seeds);
  std::printf("| %s%s | %+.3f | %+.3f | %.2f | %.1f | %.3f / %.3f | %.3f / %.3f |\n", name, a.drawn ? "" : " (samples)",
              d.total, band_difference(a, b).worst, d.rms, d.off, d.contrast[0], d.contrast[1], a.median_cpu(),
              b.median_cpu());
  std::fflush(stdout);
}

void print_paths(int seeds) {
  std::puts(
      "| paths | total [dB] | worst band [dB] | rms of cells [dB] | cells off by 1 dB [%] | contrast drawn / of "
      "samples "
      "| CPU drawn / of samples [s] |");
  std::puts("|---|---|---|---|---|---|---|");
  Environment sea;
  sea.surface = SeaSurface{3.5, 1e-4};
  EffectSettings effects;
  effects.multipath = Choice::always;
  print_paths_of("plane, calm surface 1 m above the head", "plane", sea, effects, seeds);
  effects = {}, effects.mirrors = Choice::always;
  print_paths_of("reef in a tank: ghosts and glints", "reef", tank(), effects, seeds);
  effects = {}, effects.double_echoes = 1;
  print_paths_of("reef, double echoes", "reef", {}, effects, seeds);
}

}  // namespace

int main(int argc, char** argv) {
  const std::string table = argc > 1 ? argv[1] : "scenes";
  const int seeds = argc > 2 ? std::max(2, std::atoi(argv[2])) : 64;
  if (table == "cells")
    print_cells(argc > 2 ? seeds : 12, argc > 3 ? argv[3] : "");
  else if (table == "motion")
    print_motion(argc > 2 ? seeds : 8, argc > 3 ? argv[3] : "");
  else if (table == "paths")
    print_paths(argc > 2 ? seeds : 8);
  else
    print_scenes(seeds, argc > 3 ? argv[3] : "");
}
