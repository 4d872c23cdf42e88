// SPDX-License-Identifier: BSD-3-Clause
// A ping: the whole signal path. Start reading at PingSimulator::ping.
#include "simulate/ping_simulator.hpp"

#include <complex>
#include <limits>
#include <utility>

#include "acoustics/echo_stream.hpp"
#include "core/stop_watch.hpp"
#include "core/work_progress.hpp"
#include "returns/looks.hpp"
#include "sampling/scene_cut.hpp"
#include "simulate/last_made_internal.hpp"
#include "simulate/layer_sum_internal.hpp"
#include "simulate/ping_stages_internal.hpp"
#include "simulate/plan_stages_internal.hpp"
#include "simulate/resolve_ping.hpp"

namespace insonify {

namespace {

/// The inputs of a table of surface laws. Most pings share it; pings of a dive have a sound speed each.
struct SurfaceKey {
  std::vector<Material> materials;
  double frequency, sound_speed;
  bool operator==(const SurfaceKey&) const = default;
};

constexpr std::size_t kept_surfaces = 16;

}  // namespace

struct PingSimulator::Shared {
  SonarHead head;
  Environment environment;
  SimulationOptions options;
  std::shared_ptr<SynthesizerTable> synthesizers = std::make_shared<SynthesizerTable>();
  std::shared_ptr<LastMade<SurfaceKey, SurfaceTable>> surfaces =
      std::make_shared<LastMade<SurfaceKey, SurfaceTable>>(kept_surfaces);

  SurfaceTable surfaces_of(const std::vector<Material>& materials, const Transmission& sent) {
    const SurfaceKey key{materials, sent.pulse.centre_frequency, sent.medium.sound_speed};
    return *surfaces->of(key, [&] { return surface_table(materials, key.frequency, key.sound_speed); });
  }
};

namespace {

constexpr const char* me = "PingSimulator";

Grid<double> intensity_of(const Ping& ping) { return ping.pressure.cast<std::complex<double>>().abs2(); }

/// Gives a ping the intensity of its looks (E71), if its options ask for more than one: its own and that of further
/// pulses with seeds of their own, each made by simulate(ResolvedPing), averaged over pulses and bins.
template <typename Simulate>
void average_looks(const ResolvedPing& resolved, Ping& ping, const Simulate& simulate) {
  const OutputSettings& wanted = resolved.options.outputs;
  if (wanted.looks_range == 1 && wanted.looks_pings == 1) return;
  Grid<double> sum = intensity_of(ping);
  // Only the pressure counts.
  ResolvedPing look = resolved;
  look.options.outputs = {};
  look.detection.threshold_db = std::numeric_limits<double>::infinity();
  for (int k = 1; k < wanted.looks_pings; ++k) {
    look.options.seed += 0x9e3779b97f4a7c15;  // the golden ratio: far from the seeds of other pings
    look.sent.echo_options.seed = look.view.sampling.seed = look.options.seed;
    sum += intensity_of(simulate(look));
  }
  ping.intensity = mean_over_bins(sum / wanted.looks_pings, wanted.looks_range);
}

/// Returns the ping whose display cells are drawn for their labels alone.
ResolvedPing drawn_for_labels(const WholeScene& scene, const ResolvedPing& ping) {
  ResolvedPing drawn = ping;
  SimulationOptions& o = drawn.options;
  o.outputs = {};
  o.outputs.display_bins = ping.options.outputs.display_bins, o.outputs.labels = true;
  o.synthesis.method = SynthesisMethod::incoherent, o.synthesis.phases = false;
  o.sampling.kind = SamplingKind::surfels;
  o.effects.noise = false;
  derive(scene, drawn);
  drawn.detection.threshold_db = std::numeric_limits<double>::infinity();
  return drawn;
}

/// Returns true if a ping merges surfels of a scene. A scene whose surfels have depths of their own is a cut of levels
/// already.
bool to_merge(const SceneCloud& scene, const SimulationOptions& options) {
  return scene.unevenness.empty() && merges_surfels(scene, options);
}

/// Returns use(scene), or where the options ask for it use() of the scene as fine as the head resolves it (E137).
template <typename Use>
auto with_detail(const PreparedScene& scene, ResolvedPing& ping, const Use& use) {
  const SimulationOptions& o = ping.options;
  const auto of = [&](const PreparedScene& pinged) {
    find_smooth(pinged.scene(), ping);
    return use(pinged);
  };
  if (!to_merge(scene.scene(), o)) return of(scene);
  const SceneCut cut =
      cut_scene(scene, ping.region, ping.view.fan, ping.view.gate,
                {o.sampling.detail_width, o.sampling.detail_spacing, ping.view.sampling.range_resolution, o.threads});
  ping.stands_for = cut.stands_for;
  auto result = of(cut.scene);
  ping.stands_for = {};
  return result;
}

/// Says of how many surfels a scene is, where a part of them or nodes were pinged.
void count_merged(const PreparedScene& scene, const ResolvedPing& ping, SamplingReport& report) {
  if (to_merge(scene.scene(), ping.options)) report.merged_to = std::exchange(report.surfels, scene.scene().size());
}

}  // namespace

PingSimulator::PingSimulator(SonarHead head, Environment environment, SimulationOptions options)
    : PingSimulator(std::make_shared<Shared>(std::move(head), std::move(environment), std::move(options))) {}

PingSimulator::PingSimulator(const SonarSpec& sonar, Environment environment, SimulationOptions options)
    : PingSimulator(make_head(sonar, slowest_sound(environment)), environment, std::move(options)) {}

PingSimulator::PingSimulator(std::shared_ptr<Shared> shared) : shared_(std::move(shared)) {
  require_valid(shared_->head, shared_->environment, shared_->options, me);
}

PingSimulator PingSimulator::with(SimulationOptions options) const {
  return PingSimulator(
      std::make_shared<Shared>(head(), environment(), std::move(options), shared_->synthesizers, shared_->surfaces));
}

PingSimulator PingSimulator::in(Environment environment) const {
  return PingSimulator(
      std::make_shared<Shared>(head(), std::move(environment), options(), shared_->synthesizers, shared_->surfaces));
}

const SonarHead& PingSimulator::head() const { return shared_->head; }
const Environment& PingSimulator::environment() const { return shared_->environment; }
const SimulationOptions& PingSimulator::options() const { return shared_->options; }

ResolvedPing PingSimulator::resolve(const WholeScene& scene, const PingEvent& event) const {
  return resolve_ping(scene, shared_->head, event, shared_->environment, shared_->options, me);
}

PingPlan PingSimulator::plan(const PreparedScene& scene, const PingEvent& event) const {
  ResolvedPing ping = resolve(scene.whole(), event);
  ping.sent.surfaces = shared_->surfaces_of(scene.scene().materials, ping.sent);
  return with_detail(scene, ping, [&](const PreparedScene& pinged) { return plan_of(pinged, ping); });
}

SamplingReport PingSimulator::count(const PreparedScene& scene, const PingEvent& event) const {
  ResolvedPing ping = resolve(scene.whole(), event);
  ping.sent.surfaces = shared_->surfaces_of(scene.scene().materials, ping.sent);
  SamplingReport report = with_detail(scene, ping, [&](const PreparedScene& pinged) {
    decide_effects(pinged, ping);
    return visible_surfels(pinged, ping).report;
  });
  count_merged(scene, ping, report);
  const SamplingOptions& sampling = ping.view.sampling;
  if (sampling.kind == SamplingKind::rays)
    report.scatterers = ping.head.fan.beams() * static_cast<std::size_t>(sampling.rays_per_beam);
  return report;
}

InsonifiedRegion PingSimulator::reach(const WholeScene& scene, const PingEvent& event) const {
  return resolve(scene, event).region;
}

SimulatedPing PingSimulator::ping(const PreparedScene& scene, const PingEvent& event) const {
  return ping(scene, event, nullptr);
}

SimulatedPing PingSimulator::ping(const PreparedScene& scene, const PingEvent& event, PingPlan& plan) const {
  return ping(scene, event, &plan);
}

SimulatedPing PingSimulator::ping(const PreparedScene& scene, const PingEvent& event, PingPlan* plan) const {
  ResolvedPing ping = resolve(scene.whole(), event);
  ping.sent.surfaces = shared_->surfaces_of(scene.scene().materials, ping.sent);
  StopWatch watch;
  SimulatedPing result = with_detail(scene, ping, [&](const PreparedScene& pinged) {
    if (plan) {
      *plan = plan_of(pinged, ping);
      ping.options = plan->options;
      derive(pinged.whole(), ping);
    } else {
      decide_effects(pinged, ping);
    }
    const double seconds = watch.lap();
    SimulatedPing made = this->ping(pinged, ping);
    made.report.seconds.sampling += seconds;
    return made;
  });
  count_merged(scene, ping, result.report.sampling);
  return result;
}

SimulatedPing PingSimulator::ping(const PreparedScene& scene, const ResolvedPing& decided) const {
  ResolvedPing ping = decided;
  SimulatedPing result;
  StageSeconds& seconds = result.report.seconds;
  StopWatch watch;

  // Finds what the head sees: visible surface patches inside fan and range gate, where refraction makes them seem to
  // be.
  begin_stage("sampling");
  PingParts parts = sample_parts(scene, ping, result.report);
  seconds.sampling = watch.lap();

  // Makes what comes back: one echo per patch, with spreading, scattering, speckle and carrier phase; stored or made
  // when used.
  begin_stage("echoes");
  const auto direct = direct_stream(scene.scene(), ping, parts);
  seconds.acoustics = watch.lap();

  // Forms what the array receives: a complex time series per beam, of these echoes and of all others, and noise.
  begin_stage("synthesis");
  find_bounces(scene, ping, parts);
  find_double_echoes(scene, ping, parts);
  if (draws_cells(ping.options)) {
    draw_cells(scene.scene(), ping, parts, *shared_->synthesizers, result);
  } else {
    LayerSum layers(ping, *shared_->synthesizers);
    layers.add("direct", *direct);
    add_paths(ping, parts, layers);
    for (const Reverberation& part : reverberation_echoes(ping)) layers.add(part.name, part.echoes);
    if (ping.options.effects.noise) layers.add_noise();
    layers.finish(result);
  }
  average_looks(decided, result.ping, [&](const ResolvedPing& look) { return this->ping(scene, look).ping; });
  if (ping.options.outputs.labels && !draws_cells(ping.options))
    result.ping.labels = this->ping(scene, drawn_for_labels(scene.whole(), decided)).ping.labels;
  seconds.synthesis = watch.lap();

  // Finds what an operator would mark: detections, as points in the world.
  begin_stage("detection");
  result.soundings = detect(scene.scene(), ping, *direct, parts, result.ping);
  seconds.detection = watch.lap();

  // Adds what the options ask for besides, and how the ping came about.
  begin_stage("outputs");
  attach_outputs(scene, ping, std::move(parts), result);
  return result;
}

}  // namespace insonify
