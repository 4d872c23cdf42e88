// Stages of the plan that are effects of water, boundaries, motion and materials.
#include <algorithm>
#include <cmath>

#include "acoustics/multipath_echoes.hpp"
#include "core/units.hpp"
#include "simulate/ping_stages_internal.hpp"
#include "simulate/plan_stages_internal.hpp"

namespace insonify {
namespace {

using E = Environment;
using O = SimulationOptions;

StageVerdict judge_absorption_slope(const PlanFacts& facts) {
  const Environment& environment = facts.ping.environment;
  const Pulse& pulse = facts.ping.head.pulse;
  const Absorption full =
      absorption_about(environment.water, pulse.centre_frequency, 2, environment.absorption_formula);
  const bool asked = facts.ping.options.effects.absorption_order > 0;
  const double half_band = 0.5 * pulse.bandwidth, path = 2 * facts.sample.in_view_farthest;
  return {asked,
          asked ? "asked for: each frequency of the pulse has its own absorption"
                : "a peak stays SL - 2 TL + TS: one absorption for the whole pulse",
          path * half_band * (std::abs(full.a1) + std::abs(full.a2) * half_band)};
}

StageVerdict judge_refraction(const PlanFacts& facts) {
  const ResolvedPing& ping = facts.ping;
  if (!ping.environment.profile) return {false, "one sound speed everywhere", 0};
  Scatterers places = facts.sample.places;
  const RefractionReport report = refract(ping, places);
  const double turn = 4 * pi * ping.head.pulse.centre_frequency / ping.sent.medium.sound_speed * report.bound.range;
  return {report.bent,
          report.bent ? "straight rays would be off by a bin, or by what the elevation pattern feels"
                      : "straight rays stay within a bin; speckle changes, levels do not",
          std::min(plan_margin, turn)};
}

StageVerdict judge_motion(const PlanFacts& facts) {
  const bool still = facts.ping.options.effects.motion.none();
  return {!still, still ? "the head is at rest" : "the head moves", 0};
}

bool has_boundary(const Environment& e) { return e.surface || e.bottom; }

StageVerdict judge_multipath(const PlanFacts& facts) {
  const ResolvedPing& ping = facts.ping;
  if (!has_boundary(ping.environment)) return {false, "no surface and no bottom", 0};
  const bool asked = ping.options.effects.multipath;
  const double bounce = strongest_bounce(ping.environment, ping.view, ping.sent);
  return {asked, asked ? "asked for" : "not asked for",
          bounce == 0 ? 0 : (2 * bounce + bounce * bounce) * relative_amplitude(facts, facts.sample.anywhere)};
}

StageVerdict by_strength(bool given) {
  return {given, given ? "the environment gives its scattering strength" : "no scattering strength given", 0};
}

bool volume_scatters(const Environment& e) { return e.volume_scattering_db.has_value(); }
bool surface_scatters(const Environment& e) { return e.surface && e.surface->scattering_strength_db; }
bool bottom_scatters(const Environment& e) { return e.bottom && e.bottom->lambert_mu; }

StageVerdict judge_volume(const PlanFacts& facts) { return by_strength(volume_scatters(facts.ping.environment)); }
StageVerdict judge_surface(const PlanFacts& facts) { return by_strength(surface_scatters(facts.ping.environment)); }
StageVerdict judge_bottom(const PlanFacts& facts) { return by_strength(bottom_scatters(facts.ping.environment)); }

/// Noise power in the image over that of its echoes, as amplitudes.
StageVerdict judge_noise(const PlanFacts& facts) {
  const SonarHead& head = facts.ping.head;
  const double noise =
      2 * power_from_db(facts.ping.beam_noise_db) * micropascal * micropascal * static_cast<double>(head.gate.bins());
  const double pulse_bins =
      0.469719 / head.pulse.bandwidth * facts.ping.sent.medium.sound_speed / (2 * head.gate.bin_size);
  const double share = facts.synthesis.share;
  const bool asked = facts.ping.options.effects.noise;
  return {asked, asked ? "asked for" : "not asked for",
          relative_amplitude(facts, noise / (share * share * pulse_bins))};
}

bool any_material(const PlanFacts& facts, double Material::*number) {
  return std::any_of(facts.scene.materials.begin(), facts.scene.materials.end(),
                     [number](const Material& m) { return m.*number > 0; });
}

StageVerdict judge_micro_relief(const PlanFacts& facts) {
  const bool relief = any_material(facts, &Material::relief_slope);
  return {relief, relief ? "a material has a relief slope" : "no material has a relief slope", 0};
}

StageVerdict judge_coherent_part(const PlanFacts& facts) {
  const bool coherent = any_material(facts, &Material::coherent_fraction);
  return {coherent, coherent ? "a material has a coherent fraction" : "no material has a coherent fraction", 0};
}

constexpr PlanStage stages[] = {
    {"absorption-slope", judge_absorption_slope, [](bool in, E&, O& o) { o.effects.absorption_order = in ? 2 : 0; }},
    {"refraction", judge_refraction,
     [](bool in, E&, O& o) { o.effects.refraction = in ? Choice::always : Choice::never; },
     [](const E& e, const O&) { return e.profile ? nullptr : "there is no sound-speed profile"; }},
    {"motion", judge_motion, [](bool in, E&, O& o) { o.effects.motion = in ? o.effects.motion : Motion{}; },
     [](const E&, const O& o) { return o.effects.motion.none() ? "the head is at rest" : nullptr; }},
    {"multipath", judge_multipath, [](bool in, E&, O& o) { o.effects.multipath = in; },
     [](const E& e, const O&) { return has_boundary(e) ? nullptr : "there is neither surface nor bottom"; }},
    {"volume", judge_volume,
     [](bool in, E& e, O&) {
       if (!in) e.volume_scattering_db.reset();
     },
     [](const E& e, const O&) { return volume_scatters(e) ? nullptr : "volume.scattering_db is not given"; }},
    {"surface", judge_surface,
     [](bool in, E& e, O&) {
       if (!in && e.surface) e.surface->scattering_strength_db.reset();
     },
     [](const E& e, const O&) { return surface_scatters(e) ? nullptr : "surface.scattering_db is not given"; }},
    {"bottom", judge_bottom,
     [](bool in, E& e, O&) {
       if (!in && e.bottom) e.bottom->lambert_mu.reset();
     },
     [](const E& e, const O&) { return bottom_scatters(e) ? nullptr : "bottom.lambert_mu_db is not given"; }},
    {"noise", judge_noise, [](bool in, E&, O& o) { o.effects.noise = in; }},
    {"micro-relief", judge_micro_relief},
    {"coherent-part", judge_coherent_part}};

}  // namespace

std::span<const PlanStage> effect_stages() { return stages; }

}  // namespace insonify
