// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include "simulate/simulate_ping.hpp"
#include "support/heads.hpp"
#include "support/scenes.hpp"
#include "support/simulate_event.hpp"
#include "support/test.hpp"

namespace insonify {

inline SimulatedPing ping_of(const SceneCloud& scene, const SimulationOptions& options = {},
                             const SonarSpec& spec = nine_beams(), const Water& water = {}) {
  return simulate_ping(scene, make_head(spec, sound_speed(water)), Pose::Identity(), {water}, options);
}
inline SimulatedPing ping_of(const SceneCloud& scene, const SimulationOptions& options, const Motion& motion) {
  return simulate_event(scene, make_head(nine_beams(), sound_speed(Water{})), {.motion = motion}, {}, options);
}

inline ComplexGrid image(const SimulatedPing& p) { return p.ping.pressure.cast<std::complex<double>>(); }

/// Returns true if all results of a ping are finite numbers.
inline bool all_finite(const SimulatedPing& p) {
  bool finite = p.ping.pressure.isFinite().all() && level_db(p.ping).isFinite().all();
  finite = finite && std::isfinite(p.report.noise_floor_db) && std::isfinite(p.report.medium.sound_speed);
  for (std::size_t i = 0; i < p.outputs.scatterers.size(); ++i)
    finite = finite && std::isfinite(p.outputs.scatterers.range[i]) && std::isfinite(p.outputs.scatterers.azimuth[i]) &&
             std::isfinite(p.outputs.scatterers.elevation[i]) && std::isfinite(p.outputs.scatterers.cos_incidence[i]) &&
             std::isfinite(p.outputs.scatterers.projected_area[i]);
  for (std::size_t i = 0; i < p.soundings.size(); ++i)
    finite = finite && p.soundings.position[i].allFinite() && std::isfinite(p.soundings.level_db[i]);
  return finite;
}

}  // namespace insonify
