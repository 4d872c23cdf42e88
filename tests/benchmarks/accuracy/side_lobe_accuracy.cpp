// Expected levels of heads whose side lobes hear much, by the width of the cells that their surfels are split for (E17):
// side_lobe_accuracy [PRESET ...], a table in Markdown (docs/sampling.md).
//
// Harbour of 300 000 surfels, each preset at its range, at most 30 m, 10 scatterers per cell, three seeds, against 100 per
// cell as wide as in a main lobe. Bins of side lobes: those of which the directions of main lobes give less than a tenth.
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "beamforming/synthesize_intensity.hpp"
#include "core/units.hpp"
#include "scene/built_in_scenes.hpp"
#include "simulate/heard_energy_internal.hpp"
#include "simulate/resolve_ping.hpp"
#include "store/sonar_file.hpp"

namespace {

using namespace insonify;

constexpr double everywhere = 2;  // lobe margin: cells as wide as in a main lobe

class Bench {
 public:
  Bench(const PreparedScene& scene, const SonarFile& file) : scene_(scene) {
    SonarSpec spec = file.spec;
    spec.max_range = std::min(spec.max_range, 30.0), spec.min_range = std::min(spec.min_range, 0.5 * spec.max_range);
    const Environment water{};
    SimulationOptions options;
    options.synthesis.method = SynthesisMethod::incoherent;
    options.sampling.outer_azimuths = Choice::always;
    const Eigen::Vector3d tilt = file.mounting.isZero(0) ? Eigen::Vector3d(0, radians(10), 0) : file.mounting;
    ping_ = resolve_ping(scene.whole(), make_head(spec, sound_speed(water.water)),
                         pose_from_yaw_pitch_roll({5, 0, -3}, tilt.x(), tilt.y(), tilt.z()), water, options);
  }

  /// Expected intensities, beams x bins.
  Grid<double> levels(std::uint64_t seed, double per_cell, double lobe_margin, double azimuth_margin,
                      bool by_shares = false) {
    SamplingOptions o = ping_.view.sampling;
    o.seed = seed, o.scatterers_per_cell = per_cell, o.lobe_margin = lobe_margin, o.azimuth_margin = azimuth_margin;
    const View& view = ping_.view;
    if (by_shares) o.heard = heard_energy(ping_, scene_.scene().materials);
    const Scatterers s = find_scatterers(scene_, view.world_from_head, view.fan, view.gate, o).scatterers;
    scatterers = s.size();
    const Transmission& sent = ping_.sent;
    return synthesize_intensity(direct_echoes(s, scene_.scene().materials, sent.pulse, sent.medium, sent.echo_options),
                                ping_.head, sent.medium);
  }
  std::size_t scatterers = 0;  ///< of the last call

 private:
  const PreparedScene& scene_;
  ResolvedPing ping_;
};

/// Errors [dB] over the bins of a mask.
struct Errors {
  double squares = 0, sum = 0, exact = 0, bins = 0;
  void add(const Grid<double>& levels, const Grid<double>& reference, const Grid<bool>& mask) {
    for (Eigen::Index i = 0; i < mask.size(); ++i)
      if (mask.data()[i]) {
        const double ratio = levels.data()[i] / reference.data()[i];
        squares += std::pow(std::max(-40.0, db_from_power(ratio)), 2), ++bins;
        sum += levels.data()[i], exact += reference.data()[i];
      }
  }
};

void print_table(const PreparedScene& scene, const std::string& name) {
  Bench bench(scene, find_sonar(name));
  const Grid<double> exact = 0.5 * (bench.levels(101, 100, everywhere, pi) + bench.levels(102, 100, everywhere, pi));
  const Grid<double> of_main = bench.levels(101, 100, everywhere, 0);
  const Grid<bool> heard = exact > 1e-12 * exact.maxCoeff(), side = heard && of_main < 0.1 * exact,
                   main = heard && !side;
  struct Rule {
    const char* name;
    double margin;
    bool by_shares;
  };
  for (const auto& [rule, margin, by_shares] : {Rule{"cells of a main lobe", everywhere, false},
                                                Rule{"cells d / 2 wide", 0, false}, Rule{"and by shares", 0, true}}) {
    Errors in_main, in_side;
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      const Grid<double> levels = bench.levels(seed, 10, margin, pi, by_shares);
      in_main.add(levels, exact, main), in_side.add(levels, exact, side);
    }
    std::printf("| %s, %s | %zu | %.2f | %.2f | %+.3f |\n", name.c_str(), rule, bench.scatterers,
                std::sqrt(in_main.squares / in_main.bins), std::sqrt(in_side.squares / in_side.bins),
                db_from_power(in_side.sum / in_side.exact));
    std::fflush(stdout);
  }
}

}  // namespace

int main(int argc, char** argv) {
  const SceneCloud harbour = make_built_in_scene("harbour", {.points = 300000});
  const PreparedScene scene(harbour);
  std::vector<std::string> presets(argv + 1, argv + argc);
  if (presets.empty()) presets = {"ping360", "micron", "p900-45"};
  std::printf(
      "| preset, width of cells in side lobes | scatterers | bins of main lobes, dB | bins of side lobes, dB | their "
      "sum, "
      "dB |\n|---|---|---|---|---|\n");
  for (const std::string& name : presets) print_table(scene, name);
}
