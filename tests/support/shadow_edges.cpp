// SPDX-License-Identifier: BSD-3-Clause
#include "support/shadow_edges.hpp"

#include <algorithm>
#include <cmath>

#include "core/units.hpp"
#include "support/heads.hpp"
#include "support/scenes.hpp"
#include "support/simulate_event.hpp"

namespace insonify {

std::vector<double> shadow_edge_errors(const SamplingSettings& sampling, bool large) {
  const SonarHead head = small_head({.min_range = 1, .max_range = 25});
  const double height = 3, ahead = 5, cell = 750 / head.pulse.bandwidth;
  const Pose pose = pose_from_yaw_pitch_roll({0, 0, height}, 0, radians(20), 0);
  const auto energy = [&](const SceneCloud& scene, const SamplingSettings& by) {
    const SimulationOptions options{.sampling = by, .synthesis = {.method = SynthesisMethod::incoherent}};
    return simulate_event(scene, head, {pose}, {}, options).ping.pressure.abs2().eval();
  };
  SceneCloud ground;
  add_rectangle(ground, {3, -4, 0}, {9, 0, 0}, {0, 8, 0}, {0, 0, 1}, 0.02, 0.4);
  const auto bare = energy(ground, {});
  const RangeGate& gate = head.gate;
  std::vector<double> errors;
  for (const double plate : {0.8, 0.83, 0.86, 0.89, 0.92, 0.95, 0.98, 1.01}) {
    SceneCloud scene = ground;
    add_rectangle(scene, {ahead, -2, 0}, {0, 4, 0}, {0, 0, plate}, {-1, 0, 0}, 0.02, 0.4);
    scene.part_of = whole_of(scene);
    if (large) scene.part_of->surfels = 1 << 20;
    const auto lit = energy(scene, sampling);
    for (Eigen::Index row = 0; row < lit.rows(); ++row) {
      const double azimuth = head.fan.azimuth[static_cast<std::size_t>(row)];
      if (std::abs(azimuth) > radians(10)) continue;
      const double edge = std::hypot(ahead * height / (height - plate) / std::cos(azimuth), height);
      double missing = 0, all = 0, bins = 0;
      for (Eigen::Index bin = 0; bin < lit.cols(); ++bin) {
        const double range = gate.min_range + gate.bin_size * static_cast<double>(bin);
        if (std::abs(range - edge) > 0.6) continue;
        const double dark = std::clamp((edge - range) / gate.bin_size + 0.5, 0.0, 1.0);
        missing += bare(row, bin) * (1 - dark) - lit(row, bin), all += bare(row, bin), ++bins;
      }
      errors.push_back(missing / all * bins * gate.bin_size / cell);
    }
  }
  std::sort(errors.begin(), errors.end(), [](double a, double b) { return std::abs(a) < std::abs(b); });
  return errors;
}

}  // namespace insonify
