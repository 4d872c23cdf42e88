#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <utility>

#include "acoustics/bend_paths.hpp"
#include "acoustics/direct_echoes.hpp"
#include "acoustics/echo_source.hpp"
#include "simulate/converge_sampling_internal.hpp"
#include "simulate/heard_energy_internal.hpp"
#include "simulate/layer_sum_internal.hpp"
#include "simulate/ping_stages_internal.hpp"

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

/// Makes the places of surfels so wide that they hold what their echoes seem to be to a moving head.
void widen_places(const ResolvedPing& ping, std::vector<PatchPlace>& places) {
  if (ping.options.effects.moving != Choice::always) return;
  const Motion& motion = ping.event.motion;
  const double c = ping.sent.medium.sound_speed, part = most_displacement(motion, c);
  for (PatchPlace& p : places) {
    p.reach += part * (p.range + p.reach);
    p.reach_u += 3 * part + motion.turn_rate.norm() * 2 * (p.range + p.reach) / c;
  }
}

template <typename Use>
void for_each_array(Scatterers& s, Use&& use) {
  use(s.range), use(s.azimuth), use(s.elevation), use(s.cos_incidence), use(s.projected_area), use(s.material);
  use(s.id), use(s.surfel);
}

/// Chunks of neighbouring surfels, and the first surfel of each.
std::vector<std::uint32_t> divide(const VisibleSurfels& visible, std::vector<EchoSource::Chunk>& chunks) {
  std::vector<std::uint32_t> begin{0};
  for (std::uint32_t k = 0; k < visible.surfel.size(); ++k) {
    const PatchPlace& p = visible.place[k];
    if (begin.back() == k) chunks.push_back({0, p.range - p.reach, p.range + p.reach});
    EchoSource::Chunk& chunk = chunks.back();
    chunk.size += visible.first[k + 1] - visible.first[k];
    chunk.min_range = std::min(chunk.min_range, p.range - p.reach);
    chunk.max_range = std::max(chunk.max_range, p.range + p.reach);
    if (chunk.size >= chunk_parts || k + 1 == visible.surfel.size()) begin.push_back(k + 1);
  }
  return begin;
}

/// Removes the patches of the surfels `which` that are not wanted.
void keep_wanted(const EchoSource::Filter& wanted, const VisibleSurfels& visible, std::span<const std::uint32_t> which,
                 Scatterers& patches) {
  std::size_t at = 0, kept = 0;
  for (const std::uint32_t k : which)
    for (std::size_t end = at + visible.first[k + 1] - visible.first[k]; at < end; ++at)
      if (wanted.patch(visible.place[k], patches.range[at]))
        for_each_array(patches, [&](auto& a) { a[kept] = a[at]; }), ++kept;
  for_each_array(patches, [&](auto& array) { array.resize(kept); });
}

}  // namespace

bool needs_all_patches(const ResolvedPing& ping, const SimulationOptions& o) {
  return o.outputs.scatterers || o.outputs.elements || o.outputs.contributors > 0 || o.outputs.paths > 0 ||
         o.sampling.kind == SamplingKind::rays || o.sampling.level_error_db > 0 || ping.environment.profile ||
         !streamed(ping.head, o.synthesis.method);
}

PingParts sample_parts(const PreparedScene& prepared, ResolvedPing& ping, PingReport& report) {
  View& view = ping.view;
  PingParts parts;
  view.sampling.heard = heard_energy(ping, prepared.scene().materials);
  parts.stored = needs_all_patches(ping, ping.options);
  if (parts.stored) {
    parts.sampling = sample_view(prepared, ping, report.convergence);
    report.refraction = refract(ping, parts.sampling.scatterers);
  } else {
    parts.visible = find_visible(prepared, view.world_from_head, view.fan, view.gate, view.sampling);
    widen_places(ping, parts.visible.place);
    parts.sampling.report = parts.visible.report;
  }
  return parts;
}

EchoSource direct_source(const SceneCloud& scene, const ResolvedPing& ping, PingParts& parts) {
  const Transmission& sent = ping.sent;
  const bool moving = ping.options.effects.moving == Choice::always && !ping.event.motion.none();
  const auto echoes_of = [&scene, &ping, &sent, moving](const Scatterers& patches, const EchoOptions& options) {
    Echoes echoes = direct_echoes(patches, scene.materials, sent.pulse, sent.medium, options);
    if (moving)
      move_echoes(ping.event.motion, ping.view.world_from_head, patches, sent.pulse.centre_frequency,
                  sent.medium.sound_speed, echoes);
    return echoes;
  };
  if (parts.stored) {
    parts.direct = echoes_of(parts.sampling.scatterers, sent.echo_options);
    return stored_source(parts.sampling.scatterers, parts.direct, "PingSimulator");
  }
  EchoSource source;
  source.moving = moving;
  EchoOptions on_one_thread = sent.echo_options;
  on_one_thread.threads = 1;
  const std::vector<std::uint32_t> begin = divide(parts.visible, source.chunks);
  source.visit = [&scene, &ping, &visible = parts.visible, begin, on_one_thread, echoes_of](
                     std::size_t chunk, const EchoSource::Filter& wanted, const EchoSource::Visitor& visit) {
    std::vector<std::uint32_t> which;
    for (std::uint32_t k = begin[chunk]; k < begin[chunk + 1]; ++k)
      if (!wanted.surfel || wanted.surfel(visible.place[k])) which.push_back(k);
    if (which.empty()) return;
    Scatterers patches = make_parts(scene, ping.view.world_from_head, visible, which, 1);
    if (wanted.patch) keep_wanted(wanted, visible, which, patches);
    visit(patches, echoes_of(patches, on_one_thread));
  };
  return source;
}

void add_multipath(const PreparedScene& prepared, const ResolvedPing& ping, PingParts& parts, LayerSum& layers) {
  if (ping.options.effects.multipath != Choice::always) return;
  View view = ping.view;
  view.sampling.lobe_margin = lobes_everywhere;
  view.sampling.heard = nullptr;
  Scatterers seen;
  if (view.sampling.kind == SamplingKind::surfels) {
    std::vector<std::uint32_t> surfels = parts.stored ? parts.sampling.scatterers.surfel : parts.visible.surfel;
    std::sort(surfels.begin(), surfels.end());
    surfels.erase(std::unique(surfels.begin(), surfels.end()), surfels.end());
    seen = split_seen(prepared, view.world_from_head, view.fan, view.gate, surfels, view.sampling);
    refract(ping, seen);
  }
  parts.bounced = multipath_echoes(prepared.scene(), seen, ping.environment, view, ping.sent);
  layers.add("multipath", parts.bounced.echoes);
}

}  // namespace insonify
