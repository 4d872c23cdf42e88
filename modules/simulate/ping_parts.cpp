#include <algorithm>
#include <cmath>
#include <memory>
#include <span>
#include <utility>

#include "acoustics/bend_paths.hpp"
#include "acoustics/direct_echoes.hpp"
#include "acoustics/echo_stream.hpp"
#include "simulate/layer_sum_internal.hpp"
#include "simulate/ping_stages_internal.hpp"
#include "simulate/surfel_energy_internal.hpp"

namespace insonify {
namespace {

constexpr std::size_t chunk_parts = 2048;  // with their echoes they fit into the cache of a core
constexpr std::size_t most_probed_rays = 1024;

/// What bending does at most to those of the scatterers that are in view, of some 1000 of them.
RefractionBound change_in_view(const ResolvedPing& ping, const Scatterers& all) {
  const SectorBounds sector(insonified_sector(ping.head.fan, sampling_in_view(ping)));
  const RangeGate& gate = ping.head.gate;
  Scatterers straight;
  const std::size_t step = all.size() / most_probed_rays + 1;
  for (std::size_t i = 0; i < all.size(); i += step) {
    if (all.range[i] < gate.min_range || all.range[i] > gate.max_range) continue;
    if (!sector.holds(all.range[i] * unit_vector({all.azimuth[i], all.elevation[i]}))) continue;
    straight.range.push_back(all.range[i]), straight.azimuth.push_back(all.azimuth[i]);
    straight.elevation.push_back(all.elevation[i]), straight.projected_area.push_back(1);
  }
  Scatterers bent = straight;
  bend_paths(*ping.environment.profile, ping.environment.water.depth, ping.view.world_from_head, bent,
             ping.options.threads);
  RefractionBound most;
  for (std::size_t i = 0; i < bent.size(); ++i) {
    const Eigen::Vector3d from = unit_vector({straight.azimuth[i], straight.elevation[i]});
    const double turned = (unit_vector({bent.azimuth[i], bent.elevation[i]}) - from).norm();
    most.range = std::max(most.range, std::abs(bent.range[i] - straight.range[i]));
    most.elevation = std::max(most.elevation, 2 * std::asin(std::min(1.0, 0.5 * turned)));
  }
  return most;
}

/// Bends the rays to the patches if the options say so. Without a profile nothing is done.
RefractionReport refract(const ResolvedPing& ping, Scatterers& scatterers) {
  RefractionReport report;
  if (!ping.environment.profile) return report;
  const SoundSpeedProfile& profile = *ping.environment.profile;
  const double head_depth = ping.environment.water.depth;
  const Pose& pose = ping.view.world_from_head;
  report.bound = change_in_view(ping, scatterers);
  report.bent = ping.options.effects.refraction == Choice::always;
  if (report.bent) report.silenced = bend_paths(profile, head_depth, pose, scatterers, ping.options.threads);
  return report;
}

/// Widens the bounds of surfels so that they hold where their echoes appear to a moving head.
void widen_bounds(const ResolvedPing& ping, std::vector<SurfelBounds>& bounds) {
  if (ping.options.effects.moving != Choice::always) return;
  const Motion& motion = ping.event.motion;
  const double c = ping.sent.medium.sound_speed, part = most_displacement(motion, c);
  for (SurfelBounds& s : bounds) {
    s.reach += part * (s.range + s.reach);
    s.reach_u += 3 * part + motion.turn_rate.norm() * 2 * (s.range + s.reach) / c;
  }
}

Echoes echoes_of(const SceneCloud& scene, const ResolvedPing& ping, const Scatterers& patches, bool moving,
                 const EchoOptions& options) {
  const Transmission& sent = ping.sent;
  Echoes echoes = direct_echoes(patches, scene.materials, sent.pulse, sent.medium, options);
  if (moving)
    move_echoes(ping.event.motion, ping.view.world_from_head, patches, sent.pulse.centre_frequency,
                sent.medium.sound_speed, echoes);
  return echoes;
}

/// Removes the patches of the surfels `which` that are not wanted.
void keep_wanted(const EchoSink& sink, const VisibleSurfels& visible, std::span<const std::uint32_t> which,
                 Scatterers& patches) {
  const auto for_each_array = [&patches](const auto& use) {
    Scatterers& s = patches;
    use(s.range), use(s.azimuth), use(s.elevation), use(s.cos_incidence), use(s.projected_area), use(s.material);
    use(s.id), use(s.surfel);
  };
  std::size_t at = 0, kept = 0;
  for (const std::uint32_t k : which) {
    SurfelBounds bounds = visible.bounds[k];
    bounds.reach = 0;
    for (std::size_t end = at + visible.first[k + 1] - visible.first[k]; at < end; ++at) {
      bounds.range = patches.range[at];
      if (sink.wants(bounds)) for_each_array([&](auto& a) { a[kept] = a[at]; }), ++kept;
    }
  }
  for_each_array([&](auto& array) { array.resize(kept); });
}

/// Chunks of neighbouring visible surfels, whose patches and echoes are made when they are visited.
class DirectStream final : public EchoStream {
 public:
  DirectStream(const SceneCloud& scene, const ResolvedPing& ping, const VisibleSurfels& visible, bool moving)
      : scene_(scene), ping_(ping), visible_(visible), moving_(moving), on_one_thread_(ping.sent.echo_options) {
    on_one_thread_.threads = 1;
    for (std::uint32_t k = 0; k < visible.surfel.size(); ++k) {
      const SurfelBounds& s = visible.bounds[k];
      if (first_surfel_.back() == k) chunks_.push_back({0, s.range - s.reach, s.range + s.reach});
      ChunkBounds& chunk = chunks_.back();
      chunk.size += visible.first[k + 1] - visible.first[k];
      chunk.min_range = std::min(chunk.min_range, s.range - s.reach);
      chunk.max_range = std::max(chunk.max_range, s.range + s.reach);
      if (chunk.size >= chunk_parts || k + 1 == visible.surfel.size()) first_surfel_.push_back(k + 1);
    }
  }

  std::span<const ChunkBounds> chunks() const override { return chunks_; }
  bool moving() const override { return moving_; }
  void visit(std::size_t chunk, EchoSink& sink) const override {
    std::vector<std::uint32_t> which;
    for (std::uint32_t k = first_surfel_[chunk]; k < first_surfel_[chunk + 1]; ++k)
      if (sink.wants(visible_.bounds[k])) which.push_back(k);
    if (which.empty()) return;
    Scatterers patches = make_parts(scene_, ping_.view.world_from_head, visible_, which, 1);
    if (sink.chooses_patches()) keep_wanted(sink, visible_, which, patches);
    sink.take(patches, echoes_of(scene_, ping_, patches, moving_, on_one_thread_));
  }

 private:
  const SceneCloud& scene_;
  const ResolvedPing& ping_;
  const VisibleSurfels& visible_;
  bool moving_;
  EchoOptions on_one_thread_;
  std::vector<ChunkBounds> chunks_;
  std::vector<std::uint32_t> first_surfel_{0};  // of each chunk
};

/// Whether some stage asks for all patches, or for a synthesis that takes all echoes at once.
bool needs_all_patches(const ResolvedPing& ping) {
  const SimulationOptions& o = ping.options;
  return o.outputs.scatterers || o.outputs.elements || o.outputs.contributors > 0 || o.outputs.paths > 0 ||
         o.sampling.kind == SamplingKind::rays || ping.environment.profile || !streamed(ping.head, o.synthesis.method);
}

}  // namespace

VisibleSurfels visible_surfels(const PreparedScene& prepared, ResolvedPing& ping) {
  View& view = ping.view;
  view.sampling.energy = surfel_energy(ping, prepared.scene().materials);
  return find_visible(prepared, view.world_from_head, view.fan, view.gate, view.sampling);
}

PingParts sample_parts(const PreparedScene& prepared, ResolvedPing& ping, PingReport& report) {
  const View& view = ping.view;
  PingParts parts;
  parts.stored = needs_all_patches(ping);
  if (view.sampling.kind == SamplingKind::rays) {
    parts.sampling = find_scatterers(prepared, view.world_from_head, view.fan, view.gate, view.sampling);
  } else {
    parts.visible = visible_surfels(prepared, ping);
    parts.sampling.report = parts.visible.report;
    if (parts.stored) parts.sampling.scatterers = make_parts(prepared.scene(), view.world_from_head, parts.visible);
  }
  if (parts.stored)
    report.refraction = refract(ping, parts.sampling.scatterers);
  else
    widen_bounds(ping, parts.visible.bounds);
  return parts;
}

std::unique_ptr<const EchoStream> direct_stream(const SceneCloud& scene, const ResolvedPing& ping, PingParts& parts) {
  const bool moving = ping.options.effects.moving == Choice::always && !ping.event.motion.none();
  if (!parts.stored) return std::make_unique<DirectStream>(scene, ping, parts.visible, moving);
  parts.direct = echoes_of(scene, ping, parts.sampling.scatterers, moving, ping.sent.echo_options);
  return std::make_unique<StoredEchoes>(parts.sampling.scatterers, parts.direct, "PingSimulator");
}

void add_multipath(const PreparedScene& prepared, const ResolvedPing& ping, PingParts& parts, LayerSum& layers) {
  if (ping.options.effects.multipath != Choice::always) return;
  View view = ping.view;
  view.sampling.lobe_margin = lobes_everywhere;
  view.sampling.energy = nullptr;
  Scatterers seen;
  if (view.sampling.kind == SamplingKind::surfels) {
    std::vector<std::uint32_t> surfels = parts.visible.surfel;
    std::sort(surfels.begin(), surfels.end());
    seen = split_seen(prepared, view.world_from_head, view.fan, view.gate, surfels, view.sampling);
    refract(ping, seen);
  }
  parts.bounced = multipath_echoes(prepared.scene(), seen, ping.environment, view, ping.sent);
  layers.add("multipath", parts.bounced.echoes);
}

}  // namespace insonify
