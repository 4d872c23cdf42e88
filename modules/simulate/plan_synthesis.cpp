// SPDX-License-Identifier: BSD-3-Clause
// Stages of the plan that are ways of forming beams.
#include <algorithm>

#include "beamforming/engine.hpp"
#include "beamforming/gridded/narrow_band_error.hpp"
#include "simulate/plan_stages_internal.hpp"
#include "sonar/receive_array.hpp"

namespace insonify {
namespace {

bool sums_pressures(const SimulationOptions& options) { return !gives_power(options.synthesis.method); }

bool is_direct_sum(const SimulationOptions& options) {
  return options.synthesis.method == referee_for(ImageModel::narrow_band).method;
}

/// Sets the direct sum, or leaves it for gridding if it is the one in force; another method stays as it is.
void force_direct_sum(bool included, Environment&, SimulationOptions& options) {
  auto& [method, tolerance, true_delays, phases] = options.synthesis;
  if (included && sums_pressures(options))
    method = referee_for(ImageModel::narrow_band).method;
  else if (is_direct_sum(options))
    method = engine_for(ImageModel::narrow_band, tolerance).method;
}

double tolerance_of(const PlanFacts& facts) { return facts.ping.options.synthesis.tolerance; }

/// Returns the bound of the error of the narrow-band image, of echoes in view and of those that side lobes hear unless
/// they are out by the options.
double narrow_band_bound(const PlanFacts& facts) {
  const ResolvedPing& ping = facts.ping;
  const NarrowBandError error(ping.head, ping.sent.medium.sound_speed);
  const SceneSample& sample = facts.sample;
  const bool moving = ping.options.effects.moving != Choice::never;
  const std::vector<double> doppler = moving ? moved_echoes(facts).doppler : sample.doppler;
  const NarrowBandError::Sums inside = error.of(sample.positions, sample.power, doppler, ping.options.threads),
                              beside =
                                  error.of(sample.positions, sample.power_off_azimuth, doppler, ping.options.threads);
  return bound_of_added_echoes(
      facts, inside.image > 0 ? (inside.error + beside.error) / inside.image * facts.sample.in_view : 0);
}

/// Sets a method with true delays where the narrow-band image is not good enough, else a narrow-band one.
void force_true_delays(bool included, Environment&, SimulationOptions& options) {
  if (!sums_pressures(options)) return;
  auto& [method, tolerance, true_delays, phases] = options.synthesis;
  true_delays = chosen(included);
  if (!included) {
    if (receives_whole_band(method)) method = engine_for(ImageModel::narrow_band, tolerance).method;
    return;
  }
  const Engine& engine = engine_for(ImageModel::true_delays, tolerance);
  method = engine.method;
  tolerance = std::min(tolerance, engine.most_tolerance);
}

/// A method given by name is what it is; a replaceable one leaves it to `true_delays`.
Choice requested_true_delays(const SimulationOptions& options) {
  const auto& [method, tolerance, true_delays, phases] = options.synthesis;
  return engine_of(method).replaceable ? true_delays : chosen(receives_whole_band(method));
}

constexpr double least_samples_per_cell = 4;
constexpr double drawn_cell_error = 0.035;  // of an expected cell, in amplitude: 0.3 dB (docs/results/display.md)

/// Returns true if surfels stand so near to a boundary that echoes by way of it arrive within a pulse of direct ones:
/// at height h over it, received at a height H and range R, a leg by way of it is longer by 2 h H / R.
bool fringes_at_boundaries(const PlanCause& of) {
  const auto near_plane = [&](double height) {
    const double of_head = std::abs(of.event.world_from_head.translation().z() - height);
    const double least = of.max_range * of.range_resolution / std::max(of_head, of.range_resolution);
    return std::any_of(of.scene.point.begin(), of.scene.point.end(), [&](const Eigen::Vector3f& point) {
      return std::abs(of.scene.origin.z() + static_cast<double>(point.z()) - height) < least;
    });
  };
  const Environment& e = of.environment;
  return (e.surface && near_plane(e.surface->height)) || (e.bottom && near_plane(e.bottom->height));
}

/// Why display cells must be means of samples (E180); nullptr: they need not.
const char* reason_for_phases(const PlanCause& of) {
  const SimulationOptions& o = of.options;
  const auto keeps_phase = [](const Material& m) { return m.coherent_fraction > 0; };
  if (o.outputs.display_bins == 0) return "the output is pressure";
  if (o.synthesis.phases) return "asked for";
  if (!of.has_line) return "display cells are drawn by patterns of lines, which the array is not";
  if (o.sampling.kind == SamplingKind::rays) return "rays meet points, which have no extent to spread energy over";
  if (of.samples_per_cell < least_samples_per_cell)
    return "a display cell has fewer than four samples, formed to 0.1 dB of its mean and 5 % of its contrast";
  if (sums_pressures(o) && o.amplitude != SurfaceAmplitude::complex_normal) return "amplitudes are not Gaussian";
  if (std::any_of(of.scene.materials.begin(), of.scene.materials.end(), keeps_phase))
    return "a material has a coherent fraction";
  if (o.effects.multipath == Choice::always && fringes_at_boundaries(of))
    return "echoes by a boundary arrive within a pulse of direct ones, to which they add with their phases";
  return nullptr;
}

/// Forms samples of coarse heads, of which a display cell holds a few, as well as a display shows them: means within
/// 0.1 dB of cells down to 40 dB below the loudest, contrast within 5 %. What is not the default stands.
void adapt_to_display(const PlanCause& of, SimulationOptions& o) {
  constexpr double display_tolerance = 1e-3, display_scatterers = 3;
  if (!(of.samples_per_cell < least_samples_per_cell) || o.outputs.layers || o.sampling.kind == SamplingKind::rays)
    return;
  if (o.synthesis.tolerance == SynthesisSettings{}.tolerance) o.synthesis.tolerance = display_tolerance;
  if (o.sampling.scatterers_per_cell == SamplingSettings{}.scatterers_per_cell)
    o.sampling.scatterers_per_cell = display_scatterers;
}

constexpr PlanStage stages[] = {
    {"direct-sum", DecidedBy::choice, [](const PlanCause& of) { return is_direct_sum(of.options); }, "asked for",
     "gridding keeps the tolerance; intensities of method incoherent are no sums of pressures", tolerance_of,
     force_direct_sum},
    {"phases", DecidedBy::choice, [](const PlanCause& of) { return reason_for_phases(of) != nullptr; }, "asked for",
     "display cells are drawn from expected energies, with speckle of the scene",
     [](const PlanFacts&) { return drawn_cell_error; },
     [](bool in, Environment&, SimulationOptions& o) { o.synthesis.phases = in; }, nullptr, nullptr, false, nullptr,
     reason_for_phases, adapt_to_display},
    {"true-delays", DecidedBy::budget,
     [](const PlanCause& of) { return sums_pressures(of.options) && !draws_cells(of.options); },
     "elements receive wide bands and near echoes at other times: one pattern does not hold",
     "intensities have no delays across the array", narrow_band_bound, force_true_delays, requested_true_delays,
     [](const PlanFacts& facts) { return facts.ping.head.column.has_value(); }, false,
     [](const PlanFacts& facts) { return !has_line(facts.ping.head); }},
    {"double-precision", DecidedBy::scene,
     [](const PlanCause& of) { return is_direct_sum(of.options) || !of.single_precision; }, "the tolerance needs it",
     "the tolerance leaves room for single precision", tolerance_of}};

}  // namespace

std::span<const PlanStage> synthesis_stages() { return stages; }

}  // namespace insonify
