// SPDX-License-Identifier: BSD-3-Clause
// Expected levels by how surfels are split, for cells of main lobes and of side lobes (E17), by shares of what is
// received (E127) and of the surface of a range (E128): part_accuracy [SURFELS] [PRESET[@MIN:MAX] ...], a table in
// Markdown (docs/results/sampling.md).
//
// Harbour of 300 000 surfels, each preset at its range, at most 30 m, or from MIN to MAX [m]; three seeds, against 100
// parts per cell as wide as in a main lobe. Bins of side lobes: those of which the directions of main lobes give less
// than a tenth.
#include <cctype>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "acoustics/direct_echoes.hpp"
#include "beamforming/synthesize_intensity.hpp"
#include "core/units.hpp"
#include "scene/built_in_scenes.hpp"
#include "simulate/resolve_ping.hpp"
#include "simulate/surfel_energy_internal.hpp"
#include "store/sonar_file.hpp"

namespace {

using namespace insonify;

constexpr double everywhere = 2;  // lobe margin: cells as wide as in a main lobe

class Bench {
 public:
  /// Sets up the sonar of `preset`: NAME, or NAME@MIN:MAX with the ends of its gate [m].
  Bench(const PreparedScene& scene, const std::string& preset) : scene_(scene) {
    const SonarFile file = find_sonar(preset.substr(0, preset.find('@')));
    SonarSpec spec = file.spec;
    spec.max_range = std::min(spec.max_range, 30.0), spec.min_range = std::min(spec.min_range, 0.5 * spec.max_range);
    if (const std::size_t at = preset.find('@'); at != std::string::npos) {
      spec.min_range = std::stod(preset.substr(at + 1));
      spec.max_range = std::stod(preset.substr(preset.find(':', at) + 1));
    }
    const Environment water{};
    SimulationOptions options;
    options.synthesis.method = SynthesisMethod::incoherent;
    options.sampling.outer_azimuths = Choice::always;
    const Eigen::Vector3d tilt = file.mounting.isZero(0) ? Eigen::Vector3d(0, radians(10), 0) : file.mounting;
    ping_ = resolve_ping(scene.whole(), make_head(spec, sound_speed(water.water)),
                         {pose_from_yaw_pitch_roll({5, 0, -3}, tilt.x(), tilt.y(), tilt.z())}, water, options);
  }

  /// A rule for the splitting of surfels.
  struct Rule {
    const char* name;
    double per_cell, lobe_margin;
    bool by_shares = true, alike = false;  ///< E127; true: all parts of a surfel have the same surface, without E128
  };

  /// Returns expected intensities, beams x bins.
  Grid<double> levels(std::uint64_t seed, const Rule& rule, double azimuth_margin) {
    SamplingOptions o = ping_.view.sampling;
    o.seed = seed, o.scatterers_per_cell = rule.per_cell, o.lobe_margin = rule.lobe_margin;
    o.azimuth_margin = azimuth_margin;
    const View& view = ping_.view;
    if (rule.by_shares) o.energy = surfel_energy(ping_, scene_.scene().materials);
    Scatterers s = find_scatterers(scene_, view.world_from_head, view.fan, view.gate, o).scatterers;
    scatterers = s.size();
    if (rule.alike) share_alike(s);
    const Transmission& sent = ping_.sent;
    return synthesize_intensity(direct_echoes(s, scene_.scene().materials, sent.pulse, sent.medium, sent.echo_options),
                                ping_.head, sent.medium);
  }
  std::size_t scatterers = 0;  ///< number in the last call

 private:
  void share_alike(Scatterers& s) const {
    std::vector<std::uint32_t> parts(scene_.scene().size(), 0);
    for (const std::uint32_t surfel : s.surfel) ++parts[surfel];
    for (std::size_t i = 0; i < s.size(); ++i)
      s.projected_area[i] =
          scene_.scene().area[s.surfel[i]] * s.cos_incidence[i] / static_cast<float>(parts[s.surfel[i]]);
  }

  const PreparedScene& scene_;
  ResolvedPing ping_;
};

/// Errors [dB] over the bins of a mask.
struct Errors {
  double squares = 0, sum = 0, exact = 0, bins = 0;
  double rms() const { return std::sqrt(squares / bins); }
  void add(const Grid<double>& levels, const Grid<double>& reference, const Grid<bool>& mask) {
    for (Eigen::Index i = 0; i < mask.size(); ++i)
      if (mask.data()[i]) {
        const double ratio = levels.data()[i] / reference.data()[i];
        squares += std::pow(std::max(-40.0, db_from_power(ratio)), 2), ++bins;
        sum += levels.data()[i], exact += reference.data()[i];
      }
  }
};

void print_table(const PreparedScene& scene, const std::string& preset) {
  Bench bench(scene, preset);
  const Bench::Rule many{"", 100, everywhere, false};
  const Grid<double> exact = 0.5 * (bench.levels(101, many, pi) + bench.levels(102, many, pi));
  const Grid<double> of_main = bench.levels(101, many, 0);
  const Grid<bool> beam_azimuth = exact > 1e-12 * exact.maxCoeff(), side = beam_azimuth && of_main < 0.1 * exact,
                   main = beam_azimuth && !side;
  const double as_told = SamplingOptions{}.scatterers_per_cell;
  for (const Bench::Rule& rule : {Bench::Rule{"10 per cell, shared alike", 10, 0, true, true},
                                  {"10 per cell", 10, 0},
                                  {"as by default", as_told, 0},
                                  {"without shares of what is heard", as_told, 0, false},
                                  {"and cells of a main lobe", as_told, everywhere, false}}) {
    Errors in_main, in_side;
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      const Grid<double> levels = bench.levels(seed, rule, pi);
      in_main.add(levels, exact, main), in_side.add(levels, exact, side);
    }
    const std::string in_side_lobes = in_side.bins > 0 ? std::to_string(in_side.rms()).substr(0, 4) : "none";
    std::printf("| %s, %s | %zu | %.2f | %s | %+.3f |\n", preset.c_str(), rule.name, bench.scatterers, in_main.rms(),
                in_side_lobes.c_str(), db_from_power((in_main.sum + in_side.sum) / (in_main.exact + in_side.exact)));
    std::fflush(stdout);
  }
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<std::string> presets(argv + 1, argv + argc);
  std::size_t surfels = 300000;
  if (!presets.empty() && std::isdigit(static_cast<unsigned char>(presets[0][0])))
    surfels = std::stoul(presets[0]), presets.erase(presets.begin());
  if (presets.empty()) presets = {"ping360", "micron", "p900-45", "oculus-m750d@19:19.3"};
  const SceneCloud harbour = make_built_in_scene("harbour", {.points = surfels});
  const PreparedScene scene(harbour);
  std::printf(
      "| preset, how surfels are split | scatterers | bins of main lobes, dB | bins of side lobes, dB | their sum, dB "
      "|\n"
      "|---|---|---|---|---|\n");
  for (const std::string& preset : presets) print_table(scene, preset);
}
