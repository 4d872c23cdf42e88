// SPDX-License-Identifier: BSD-3-Clause
// Stages of the plan that are effects of water, boundaries, motion and materials.
#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <utility>

#include "acoustics/direct_stream.hpp"
#include "acoustics/glints.hpp"
#include "acoustics/multipath_echoes.hpp"
#include "acoustics/refract_paths.hpp"
#include "core/units.hpp"
#include "simulate/echo_overlap_internal.hpp"
#include "simulate/plan_stages_internal.hpp"
#include "simulate/received_energy.hpp"
#include "sonar/pulse_kind.hpp"

namespace insonify {
namespace {

using E = Environment;
using O = SimulationOptions;

/// Bound of what turns the echoes `before` of the sample into those `after`.
double difference_bound(const PlanFacts& facts, const Echoes& before, const Echoes& after) {
  const EchoOverlap overlap(facts.ping);
  return bound_of_changed_echoes(facts, [&](std::size_t i) {
    const std::complex<double> ratio = after.amplitude[i] / before.amplitude[i];
    return 1 + std::norm(ratio) -
           2 * ratio.real() *
               overlap.of(after.delay[i] - before.delay[i], after.doppler_of(i), after.u[i] - before.u[i]);
  });
}

Echoes echoes_of(const PlanFacts& facts, const Scatterers& positions) {
  Transmission mean_power = facts.ping.sent;
  mean_power.echo_options.amplitude = SurfaceAmplitude::mean_power;
  return direct_echoes(positions, facts.scene.materials, mean_power);
}

/// Error of an echo of the centre frequency's absorption, over the pulse's spectrum.
double absorption_slope_bound(const PlanFacts& facts) {
  const Environment& environment = facts.ping.environment;
  const Pulse& pulse = facts.ping.head.pulse;
  const Absorption full =
      absorption_about(environment.water, pulse.centre_frequency, 2, environment.absorption_formula);
  return bound_of_changed_echoes(facts, [&](std::size_t i) {
    const double path = 2 * facts.sample.positions.range[i];
    double error = 0;
    for (const SpectrumNode& node : spectrum_nodes(pulse))
      error += node.weight * std::pow(std::expm1(-path * node.frequency * (full.a1 + full.a2 * node.frequency)), 2);
    return error;
  });
}

double refraction_bound(const PlanFacts& facts) {
  const ResolvedPing& ping = facts.ping;
  Scatterers refracted = facts.sample.positions;
  refract_paths(*ping.environment.profile, ping.environment.water.depth, ping.view.world_from_head, refracted,
                {&facts.sample.scene, ping.sent.medium.absorption.a0, ping.options.threads});
  return std::hypot(difference_bound(facts, echoes_of(facts, facts.sample.positions), echoes_of(facts, refracted)),
                    straight_double_echoes(facts).bound);
}

/// Returns true if double echoes by straight legs would be off by more than a centimetre of range.
bool misplaces_double_echoes(const PlanFacts& facts) { return straight_double_echoes(facts).range > 0.01; }

double motion_bound(const PlanFacts& facts) {
  return difference_bound(facts, echoes_of(facts, facts.sample.positions), moved_echoes(facts));
}

/// Energy that beams receive of echoes within the gate.
double received_energy(const ResolvedPing& ping, const Echoes& echoes) {
  const Medium& medium = ping.sent.medium;
  ReceivedEnergy received(ping.head, medium.sound_speed / ping.sent.pulse.centre_frequency);
  double energy = 0;
  for (std::size_t i = 0; i < echoes.size(); ++i) {
    const double range = 0.5 * medium.sound_speed * echoes.delay[i];
    if (range < ping.head.gate.min_range || range > ping.head.gate.max_range) continue;
    energy += std::norm(echoes.amplitude[i]) * std::exp(-4 * medium.absorption.a0 * range) *
              received.at(echoes.u[i], echoes.v.empty() ? 0 : echoes.v[i]);
  }
  return energy;
}

/// The ping for a sample: echoes of mean power of surfels that are not split.
std::pair<Transmission, View> of_sample(const ResolvedPing& ping) {
  std::pair<Transmission, View> of{ping.sent, ping.view};
  of.first.echo_options.amplitude = SurfaceAmplitude::mean_power;
  of.second.sampling.scatterers_per_cell = 0;
  of.second.sampling.kind = SamplingKind::surfels;
  return of;
}

/// Energy of the echoes by the boundaries, of the sample.
double multipath_bound(const PlanFacts& facts) {
  const ResolvedPing& ping = facts.ping;
  const auto [sent, view] = of_sample(ping);
  const Echoes multipath =
      multipath_echoes(facts.sample.scene, facts.sample.positions, ping.environment, view, sent).echoes;
  return bound_of_added_echoes(facts, received_energy(ping, multipath));
}

/// Returns the bound of the echoes that mirrors add, by energy: ghosts of the sample, and all glints.
double mirrors_bound(const PlanFacts& facts) {
  const ResolvedPing& ping = facts.ping;
  const auto [sent, view] = of_sample(ping);
  const bool levels = has_boundary(ping.environment) && ping.options.effects.multipath != Choice::never;
  Echoes echoes = glint_echoes(facts.scene, ping.smooth, ping.environment, levels, view, sent, {.over_band = false});
  if (!ping.smooth.mirrors.empty())
    append(echoes, mirror_echoes(facts.sample.scene, facts.sample.positions, ping.environment, ping.smooth.mirrors,
                                 levels, view, sent)
                       .echoes);
  return bound_of_added_echoes(facts, received_energy(ping, echoes));
}

/// Energy of noise in all bins over that of the echoes.
double noise_bound(const PlanFacts& facts) {
  const SonarHead& head = facts.ping.head;
  const double noise = 2 * power_from_db(facts.ping.beam_noise_db) * micropascal * micropascal *
                       static_cast<double>(head.fan.beams() * head.gate.bins());
  const double sound_speed = facts.ping.sent.medium.sound_speed;
  Pulse gaussian = head.pulse;
  gaussian.shape = {};
  // The energy of a Gaussian pulse to six digits, times how much more another has.
  const double pulse_bins = 0.469719 / head.pulse.bandwidth * sound_speed / (2 * head.gate.bin_size) *
                            (energy_length(head.pulse, sound_speed) / energy_length(gaussian, sound_speed));
  return bound_of_added_echoes(facts, noise / pulse_bins);
}

template <double Material::*number>
bool any_material(const PlanCause& of) {
  return std::any_of(of.scene.materials.begin(), of.scene.materials.end(),
                     [](const Material& m) { return m.*number > 0; });
}

constexpr const char* strength_given = "the environment gives its scattering strength";

constexpr PlanStage effects[] = {
    {"absorption-slope", DecidedBy::budget, always, "each frequency of the pulse has its own absorption", "",
     absorption_slope_bound, [](bool in, E&, O& o) { o.effects.absorption_order = in ? 2 : 0; },
     [](const O& o) {
       return o.effects.absorption_order ? chosen(*o.effects.absorption_order > 0) : Choice::as_needed;
     }},
    {"refraction", DecidedBy::budget, [](const PlanCause& of) { return of.environment.profile.has_value(); },
     "rays are bent: echoes arrive at other times and angles", "there is no sound-speed profile", refraction_bound,
     [](bool in, E&, O& o) { o.effects.refraction = chosen(in); }, [](const O& o) { return o.effects.refraction; },
     nullptr, false, misplaces_double_echoes},
    {"motion", DecidedBy::budget, [](const PlanCause& of) { return !of.event.motion.none() || moves(of.scene); },
     "head or parts of the scene move while sound is under way", "the head is at rest", motion_bound,
     [](bool in, E&, O& o) { o.effects.moving = chosen(in); }, [](const O& o) { return o.effects.moving; }},
    {"multipath", DecidedBy::budget, [](const PlanCause& of) { return has_boundary(of.environment); },
     "sound also comes by way of surface or bottom", "there is neither surface nor bottom", multipath_bound,
     [](bool in, E&, O& o) { o.effects.multipath = chosen(in); }, [](const O& o) { return o.effects.multipath; }},
    {"mirrors", DecidedBy::budget,
     [](const PlanCause& of) {
       const std::vector<Material>& materials = of.scene.materials;
       return may_mirror(of.environment, std::any_of(materials.begin(), materials.end(), is_smooth));
     },
     "smooth planes and shapes show ghosts and glints", "neither environment nor materials have smooth planes",
     mirrors_bound, [](bool in, E&, O& o) { o.effects.mirrors = chosen(in); },
     [](const O& o) { return o.effects.mirrors; }, nullptr, true},
    {"double-echoes", DecidedBy::choice, [](const PlanCause& of) { return of.options.effects.double_echoes > 0; },
     "sound goes on from one surface to another", "not asked for", double_echo_bound,
     [](bool in, E&, O& o) {
       if (!in || o.effects.double_echoes == 0) o.effects.double_echoes = in ? usual_double_echoes : 0;
     }},
    {"volume", DecidedBy::choice, [](const PlanCause& of) { return of.environment.volume_scattering_db.has_value(); },
     strength_given, "volume.scattering_db is not given", nullptr,
     [](bool in, E& e, O&) {
       if (!in) e.volume_scattering_db.reset();
     }},
    {"surface", DecidedBy::choice,
     [](const PlanCause& of) { return of.environment.surface && of.environment.surface->scattering_strength_db; },
     strength_given, "surface.scattering_db is not given", nullptr,
     [](bool in, E& e, O&) {
       if (!in && e.surface) e.surface->scattering_strength_db.reset();
     }},
    {"bottom", DecidedBy::choice,
     [](const PlanCause& of) { return of.environment.bottom && of.environment.bottom->lambert_mu; }, strength_given,
     "bottom.lambert_mu_db is not given", nullptr,
     [](bool in, E& e, O&) {
       if (!in && e.bottom) e.bottom->lambert_mu.reset();
     }},
    {"noise", DecidedBy::choice, [](const PlanCause& of) { return of.options.effects.noise; }, "asked for",
     "not asked for", noise_bound, [](bool in, E&, O& o) { o.effects.noise = in; }},
    {"micro-relief", DecidedBy::scene, any_material<&Material::relief_slope>, "a material has a relief slope",
     "no material has a relief slope"},
    {"coherent-part", DecidedBy::scene, any_material<&Material::coherent_fraction>,
     "a material has a coherent fraction", "no material has a coherent fraction"}};

}  // namespace

Echoes moved_echoes(const PlanFacts& facts) {
  const ResolvedPing& ping = facts.ping;
  Scatterers met = facts.sample.positions;
  Transmission mean_power = ping.sent;
  mean_power.echo_options.amplitude = SurfaceAmplitude::mean_power;
  return echoes_in_motion(facts.sample.scene, met, ping.view.world_from_head, {ping.event.motion, moves(facts.scene)},
                          mean_power);
}

std::span<const PlanStage> effect_stages() { return effects; }

}  // namespace insonify
