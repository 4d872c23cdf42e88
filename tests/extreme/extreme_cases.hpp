#pragma once
#include "acoustics/direct_echoes.hpp"
#include "beamforming/synthesize.hpp"
#include "core/random.hpp"
#include "scene/scene_cloud.hpp"
#include "simulate/simulate_ping.hpp"
#include "sonar/shading.hpp"
#include "support/heads.hpp"
#include "support/scenes.hpp"
#include "support/simulate_event.hpp"
#include "support/test.hpp"

namespace insonify::extreme {

using Complex = std::complex<double>;
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

/// A small sonar: 9 beams over 40 degrees, ranges 1 to 12 m, some 700 bins.
inline SonarSpec small_sonar() {
  return insonify::small_sonar({.beams = 9,
                                .field_of_view_deg = 40,
                                .beam_width_deg = 4,
                                .elevation_width_deg = 40,
                                .min_range = 1,
                                .max_range = 12});
}

/// Water without absorption at 1500 m/s.
inline Medium clear_water() { return {1500, {}}; }

inline SonarHead small_head() { return make_head(small_sonar(), 1500); }

/// One head-on beam of one element over a gate whose bin centres fall on every multiple of 2 mm.
inline SonarHead single_beam(const Pulse& pulse, double min_range, double max_range) {
  SonarHead head;
  head.name = "single";
  head.pulse = pulse;
  head.fan = make_fan(1, 1, 1, 1);
  head.array = {0.5 * 1500 / pulse.centre_frequency, {1.0}};
  head.gate = {min_range - 0.001, max_range + 0.001, 0.002};
  return head;
}

inline Scatterers targets_at(const std::vector<double>& range, double azimuth = 0, double elevation = 0) {
  Scatterers s;
  s.range = range;
  s.azimuth.assign(range.size(), azimuth);
  s.elevation.assign(range.size(), elevation);
  return s;
}

/// Echoes of targets of cross-section sigma [m^2] and amplitude 1.
inline Echoes echoes_of(const Scatterers& targets, const Pulse& pulse, const Medium& medium, double sigma = 1) {
  const std::vector<double> sigmas(targets.size(), sigma);
  const std::vector<Complex> xi(targets.size(), 1);
  return target_echoes(targets, sigmas, xi, pulse, medium);
}

inline SimulatedPing ping_of(const SceneCloud& scene, const SimulationOptions& options = {},
                             const SonarSpec& spec = small_sonar(), const Water& water = {}) {
  return simulate_ping(scene, make_head(spec, sound_speed(water)), Pose::Identity(), {water}, options);
}
inline SimulatedPing ping_of(const SceneCloud& scene, const SimulationOptions& options, const Motion& motion) {
  return simulate_event(scene, make_head(small_sonar(), sound_speed(Water{})), {.motion = motion}, {}, options);
}

inline ComplexGrid image(const SimulatedPing& p) { return p.ping.pressure.cast<Complex>(); }

inline bool same(const ComplexGrid& a, const ComplexGrid& b) {
  return a.rows() == b.rows() && a.cols() == b.cols() && (a == b).all();
}

/// Everything a ping hands out is a number.
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

}  // namespace insonify::extreme
