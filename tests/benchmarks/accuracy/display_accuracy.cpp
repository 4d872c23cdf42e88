// SPDX-License-Identifier: BSD-3-Clause
// Display cells without samples (E180 to E184) against means of samples, and their time, as tables in Markdown
// (docs/results/display.md):
//   display_accuracy scenes [SEEDS [SCENE|SONAR]]  level, contrast and likeness, by scene and head, with noise (64 seeds)
//   display_accuracy cells [SEEDS]    error and CPU time by number of cells (12 seeds)
//   display_accuracy motion           how alike images are after a move
//   display_accuracy paths [SEEDS]    levels of echoes by way of other surfaces (8 seeds)
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>
#include <vector>

#include "core/units.hpp"
#include "display_scenes.hpp"
#include "simulate/ping_simulator.hpp"
#include "store/sonar_file.hpp"

namespace {

using namespace insonify;

SonarHead head_of(const std::string& preset, double min_range, double max_range) {
  SonarSpec spec = find_sonar(preset).spec;
  spec.min_range = min_range, spec.max_range = max_range;
  return make_head(spec, sound_speed(Water{}));
}

/// A scene, a head and a number of cells, pinged in both ways.
struct Rig {
  PreparedScene scene;
  SonarHead head;
  int cells;
  bool noise;
  Environment environment{};
  EffectSettings effects{};

  struct Image {
    Grid<double> intensity;
    double cpu;
    bool drawn;
  };
  Image ping(bool phases, std::uint64_t seed, const Pose& pose) const {
    SimulationOptions o;
    o.seed = seed, o.threads = 1, o.effects = effects, o.effects.noise = noise;
    o.outputs.display_bins = cells, o.synthesis.phases = phases;
    const std::clock_t begin = std::clock();
    const SimulatedPing made = PingSimulator(head, environment, o).ping(scene, {pose});
    const double cpu = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
    return {made.ping.pressure.cast<std::complex<double>>().abs2(), cpu, !made.report.options.synthesis.phases};
  }
};

struct Moments {
  Grid<double> mean, square;
  std::vector<double> cpu{}, sums{};  ///< CPU time and total intensity of each image
  bool drawn = false;
  double median_cpu() const {
    std::vector<double> sorted = cpu;
    std::sort(sorted.begin(), sorted.end());
    return sorted[sorted.size() / 2];
  }
};
Moments moments_of(const Rig& rig, bool phases, const Pose& pose, int seeds) {
  Moments m;
  for (int seed = 1; seed <= seeds; ++seed) {
    const Rig::Image image = rig.ping(phases, static_cast<std::uint64_t>(seed), pose);
    if (seed == 1) m.mean = m.square = Grid<double>::Zero(image.intensity.rows(), image.intensity.cols());
    m.mean += image.intensity / seeds, m.square += image.intensity.square() / seeds;
    m.cpu.push_back(image.cpu), m.sums.push_back(image.intensity.sum()), m.drawn = image.drawn;
  }
  return m;
}

/// Differences of two images, over cells within 40 dB of the strongest.
struct Difference {
  double total = 0, band = 0, rms = 0, off = 0, contrast[2] = {0, 0};
  double middle[2] = {0, 0};  ///< contrast of the middle half of the beams, which receive no grating lobes
};
Difference difference(const Moments& a, const Moments& b, int seeds) {
  Difference d;
  d.total = db_from_power(a.mean.sum() / b.mean.sum());
  for (Eigen::Index k = 0; k < 10; ++k) {
    const Eigen::Index first = k * b.mean.cols() / 10, count = (k + 1) * b.mean.cols() / 10 - first;
    const double energy = b.mean.middleCols(first, count).sum();
    if (energy < 1e-3 * b.mean.sum()) continue;
    const double off = db_from_power(a.mean.middleCols(first, count).sum() / energy);
    if (std::abs(off) > std::abs(d.band)) d.band = off;
  }
  double cells = 0, noise = 0, middle = 0;
  const double unbiased = seeds / (seeds - 1.0);
  for (Eigen::Index i = 0; i < b.mean.size(); ++i) {
    const double ma = a.mean.data()[i], mb = b.mean.data()[i];
    if (!(ma > 0) || mb < 1e-4 * b.mean.maxCoeff()) continue;
    const double va = unbiased * (a.square.data()[i] / (ma * ma) - 1),
                 vb = unbiased * (b.square.data()[i] / (mb * mb) - 1);
    const double off = db_from_power(ma / mb), sampled = 18.86 * (va + vb) / seeds;
    d.rms += off * off, noise += sampled, ++cells;
    d.off += std::abs(off) > 1 + 2.5 * std::sqrt(sampled);
    d.contrast[0] += va, d.contrast[1] += vb;
    const Eigen::Index beam = i / b.mean.cols();
    if (beam < b.mean.rows() / 4 || beam >= 3 * b.mean.rows() / 4) continue;
    d.middle[0] += va, d.middle[1] += vb, ++middle;
  }
  d.rms = std::sqrt(std::max(0.0, d.rms - noise) / cells), d.off *= 100 / cells;
  for (const int k : {0, 1})
    d.contrast[k] = std::sqrt(d.contrast[k] / cells), d.middle[k] = std::sqrt(d.middle[k] / middle);
  return d;
}

/// Standard deviation of Difference::total by the number of seeds [dB], from the spread of the sums of the images.
double total_noise(const Moments& a, const Moments& b, int seeds) {
  const auto relative_variance = [&](const std::vector<double>& sums) {
    double mean = 0, square = 0;
    for (const double s : sums) mean += s / seeds, square += s * s / seeds;
    return std::max(0.0, square / (mean * mean) - 1) / (seeds - 1);
  };
  return 4.343 * std::sqrt(relative_variance(a.sums) + relative_variance(b.sums));
}

/// Returns the correlation of two images, each relative to its mean, `beams` and `cells` apart.
double correlation(const Grid<double>& a, const Grid<double>& b, const Grid<double>& mean, Eigen::Index beams = 0,
                   Eigen::Index cells = 0) {
  double ab = 0, aa = 0, bb = 0;
  const double least = 1e-4 * mean.maxCoeff();
  for (Eigen::Index i = 0; i + beams < a.rows(); ++i)
    for (Eigen::Index j = 0; j + cells < a.cols(); ++j) {
      if (mean(i, j) < least || mean(i + beams, j + cells) < least) continue;
      const double x = a(i, j) / mean(i, j) - 1, y = b(i + beams, j + cells) / mean(i + beams, j + cells) - 1;
      ab += x * y, aa += x * x, bb += y * y;
    }
  return ab / std::sqrt(aa * bb);
}

/// Largest distance between the distributions of two samples (Kolmogorov and Smirnov).
double largest_distance(std::vector<double> a, std::vector<double> b) {
  std::sort(a.begin(), a.end()), std::sort(b.begin(), b.end());
  double most = 0;
  for (std::size_t i = 0, j = 0; i < a.size() && j < b.size();) {
    a[i] <= b[j] ? ++i : ++j;
    most = std::max(most, std::abs(static_cast<double>(i) / static_cast<double>(a.size()) -
                                   static_cast<double>(j) / static_cast<double>(b.size())));
  }
  return most;
}

/// Levels of cells relative to their means: those of beams in the middle half within 40 dB of the strongest cell, of as
/// many seeds as some 20 000 take.
std::vector<double> relative_levels(const Rig& rig, bool phases, const Pose& pose, const Grid<double>& mean) {
  std::vector<double> relative;
  const Eigen::Index beams = mean.rows();
  for (std::uint64_t seed = 2000; seed < 2064 && relative.size() < 20000; ++seed) {
    const Grid<double> image = rig.ping(phases, seed, pose).intensity;
    for (Eigen::Index i = beams / 4; i < 3 * beams / 4; ++i)
      for (Eigen::Index j = 0; j < mean.cols(); ++j)
        if (mean(i, j) > 1e-4 * mean.maxCoeff()) relative.push_back(image(i, j) / mean(i, j));
  }
  return relative;
}

/// Prints a row of print_scenes.
void print_scene(const View& view, const char* sonar, int seeds) {
  Rig rig{PreparedScene(scene_of(view, view.points)), head_of(sonar, 3, 8), 100, true};
  if (view.scene == "reef in a tank") rig.environment = tank(), rig.effects.mirrors = Choice::always;
  const Moments a = moments_of(rig, false, view.pose(), seeds), b = moments_of(rig, true, view.pose(), seeds);
  const Difference d = difference(a, b, seeds);
  std::printf("| %s | %s%s | %+.3f (%.3f) | %+.3f | %.2f | %.1f | %.3f / %.3f | %.3f / %.3f |", view.scene.c_str(),
              sonar, a.drawn ? "" : " (samples)", d.total, total_noise(a, b, seeds), d.band, d.rms, d.off,
              d.contrast[0], d.contrast[1], d.middle[0], d.middle[1]);
  const Grid<double> drawn = rig.ping(false, 1000, view.pose()).intensity,
                     samples = rig.ping(true, 1000, view.pose()).intensity;
  for (const Eigen::Index apart : {1, 2, 4})
    std::printf("%s%.2f / %.2f", apart == 1 ? " " : ", ", correlation(drawn, drawn, a.mean, apart),
                correlation(samples, samples, b.mean, apart));
  std::printf(" | %.2f / %.2f | %.3f | %.3f / %.3f |\n", correlation(drawn, drawn, a.mean, 0, 1),
              correlation(samples, samples, b.mean, 0, 1),
              largest_distance(relative_levels(rig, false, view.pose(), a.mean),
                               relative_levels(rig, true, view.pose(), b.mean)),
              a.median_cpu(), b.median_cpu());
  std::fflush(stdout);
}

void print_scenes(int seeds, const std::string& only) {
  std::puts(
      "| scene | sonar | total [dB] | worst band [dB] | rms of cells [dB] | cells off by 1 dB [%] | contrast: drawn / "
      "samples | in the middle half of the beams | beams 1, 2, 4 apart | next cell | KS distance | CPU [s] |");
  std::puts("|---|---|---|---|---|---|---|---|---|---|---|---|");
  for (const View& view : views)
    for (const char* sonar :
         {"oculus-m750d", "p900-45", "gemini-720is", "gemini-1200ik-hf", "m900-130", "oculus-m1200d"})
      if (only.empty() || only == view.scene || only == sonar) print_scene(view, sonar, seeds);
}

void print_cells(int seeds) {
  std::puts(
      "| cells | samples a cell | rms of cells [dB] | worst band [dB] | contrast drawn / of samples | CPU drawn / of "
      "samples "
      "[s] |");
  std::puts("|---|---|---|---|---|---|");
  const View& view = view_of("harbour");
  for (const int cells : {100, 200, 400, 600, 1200, 2400, 4200}) {
    const Rig rig{PreparedScene(scene_of(view, view.points)), head_of("oculus-m750d", 0.1, 30), cells, false};
    const Moments a = moments_of(rig, false, view.pose(), seeds), b = moments_of(rig, true, view.pose(), seeds);
    const Difference d = difference(a, b, seeds);
    std::printf("| %d | %.1f | %.2f | %+.3f | %.3f / %.3f | %.3f / %.3f |\n", cells,
                static_cast<double>(rig.head.gate.bins()) / cells, d.rms, d.band, d.contrast[0], d.contrast[1],
                a.median_cpu(), b.median_cpu());
    std::fflush(stdout);
  }
}

void print_motion() {
  std::puts("| correlation after | drawn | samples |");
  std::puts("|---|---|---|");
  const View& view = view_of("harbour");
  const Rig rig{PreparedScene(scene_of(view, view.points)), head_of("oculus-m750d", 0.1, 30), 600, false};
  const Moments a = moments_of(rig, false, view.pose(), 12), b = moments_of(rig, true, view.pose(), 12);
  const struct {
    const char* name;
    Pose pose;
  } moves[] = {{"1 cm aside", view.pose(0, 0.01)}, {"3 cm aside", view.pose(0, 0.03)},
               {"10 cm aside", view.pose(0, 0.1)}, {"1 cm ahead", view.pose(0.01)},
               {"3 cm ahead", view.pose(0.03)},    {"0.1 deg of yaw", view.pose(0, 0, 0.1)}};
  for (const auto& [name, pose] : moves) {
    const auto alike = [&](bool phases, const Grid<double>& mean) {
      return correlation(rig.ping(phases, 100, view.pose()).intensity, rig.ping(phases, 100, pose).intensity, mean);
    };
    std::printf("| %s | %.2f | %.2f |\n", name, alike(false, a.mean), alike(true, b.mean));
  }
}

/// Prints a row of print_paths.
void print_paths_of(const char* name, const char* scene, const Environment& environment, const EffectSettings& effects,
                    int seeds) {
  const View& view = view_of(scene);
  const Rig rig{PreparedScene(scene_of(view, 100000)), head_of("oculus-m750d", 3, 8), 100, false, environment, effects};
  const Moments a = moments_of(rig, false, view.pose(), seeds), b = moments_of(rig, true, view.pose(), seeds);
  const Difference d = difference(a, b, seeds);
  std::printf("| %s%s | %+.3f | %+.3f | %.2f | %.1f | %.3f / %.3f | %.3f / %.3f |\n", name, a.drawn ? "" : " (samples)",
              d.total, d.band, d.rms, d.off, d.contrast[0], d.contrast[1], a.median_cpu(), b.median_cpu());
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
    print_cells(argc > 2 ? seeds : 12);
  else if (table == "motion")
    print_motion();
  else if (table == "paths")
    print_paths(argc > 2 ? seeds : 8);
  else
    print_scenes(seeds, argc > 3 ? argv[3] : "");
}
