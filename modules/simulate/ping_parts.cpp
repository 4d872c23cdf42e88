// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <memory>

#include "acoustics/direct_stream.hpp"
#include "acoustics/glints.hpp"
#include "acoustics/refract_paths.hpp"
#include "beamforming/engine.hpp"
#include "simulate/cell_paths_internal.hpp"
#include "simulate/cell_sum_internal.hpp"
#include "simulate/layer_sum_internal.hpp"
#include "simulate/ping_stages_internal.hpp"
#include "simulate/surfel_energy_internal.hpp"

namespace insonify {
namespace {

/// The motion that echoes are computed with.
MovingScene motion_of(const SceneCloud& scene, const ResolvedPing& ping) {
  if (ping.options.effects.moving != Choice::always) return {};
  return {ping.event.motion, moves(scene)};
}

/// Bends the rays to the patches if the options say so.
RefractedPaths refract_patches(const SceneCloud& scene, const ResolvedPing& ping, Scatterers& patches) {
  if (!ping.environment.profile || ping.options.effects.refraction != Choice::always) return {};
  return refract_paths(*ping.environment.profile, ping.environment.water.depth, ping.view.world_from_head, patches,
                       {&scene, ping.sent.medium.absorption.a0, ping.options.threads});
}

/// The same, with a report.
RefractionReport refract(const SceneCloud& scene, const ResolvedPing& ping, Scatterers& patches) {
  if (!ping.environment.profile) return {};
  const Sector sector = insonified_sector(ping.head.fan, sampling_in_view(ping));
  const RefractionBound bound =
      refraction_in_view(*ping.environment.profile, ping.environment.water.depth, ping.view.world_from_head, patches,
                         sector, ping.head.gate, ping.options.threads);
  return {bound, ping.options.effects.refraction == Choice::always, refract_patches(scene, ping, patches)};
}

/// Returns the environment whose profile legs run through; nullptr: rays are straight.
const Environment* profile_of(const ResolvedPing& ping) {
  return ping.options.effects.refraction == Choice::always ? &ping.environment : nullptr;
}

/// Returns true if some stage asks for all patches, or for a synthesis that takes all echoes at once.
bool needs_all_patches(const ResolvedPing& ping) {
  const SimulationOptions& o = ping.options;
  return draws_cells(o) || o.outputs.scatterers || o.outputs.elements || o.outputs.contributors > 0 ||
         o.outputs.paths > 0 || o.sampling.kind == SamplingKind::rays || ping.environment.profile ||
         !streamed(ping.head, o.synthesis.method);
}

constexpr std::size_t most_stored = 1 << 20;  // patches of an image that are stored, some 100 bytes each

}  // namespace

VisibleSurfels visible_surfels(const PreparedScene& prepared, ResolvedPing& ping) {
  View& view = ping.view;
  view.sampling.energy = surfel_energy(ping, prepared.scene().materials);
  // Cells sort echoes themselves.
  return find_visible(prepared, view.world_from_head, view.fan, view.gate, view.sampling,
                      draws_cells(ping.options) ? SurfelOrder::range : SurfelOrder::range_and_u);
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
    // Samples of an image and its detections both ask for them.
    parts.stored |= ping.options.outputs.display_bins > 0 && parts.visible.first.back() <= most_stored;
    if (parts.stored) parts.sampling.scatterers = make_chunks(prepared.scene(), view.world_from_head, parts.visible);
  }
  if (parts.stored)
    report.refraction = refract(prepared.scene(), ping, parts.sampling.scatterers);
  else
    widen_bounds(prepared.scene(), motion_of(prepared.scene(), ping), prepared.whole().fastest,
                 ping.sent.medium.sound_speed, parts.visible);
  return parts;
}

std::unique_ptr<const EchoStream> direct_stream(const SceneCloud& scene, const ResolvedPing& ping, PingParts& parts) {
  const MovingScene moving = motion_of(scene, ping);
  const Pose& pose = ping.view.world_from_head;
  if (!parts.stored) return std::make_unique<DirectStream>(scene, parts.visible, pose, moving, ping.sent);
  parts.direct = echoes_in_motion(scene, parts.sampling.scatterers, pose, moving, ping.sent);
  return std::make_unique<StoredEchoes>(parts.sampling.scatterers, parts.direct, "PingSimulator");
}

void find_bounces(const PreparedScene& prepared, const ResolvedPing& ping, PingParts& parts) {
  const bool multipath = ping.options.effects.multipath == Choice::always;
  const bool mirrors = ping.options.effects.mirrors == Choice::always;
  if (!multipath && !mirrors) return;
  const SceneCloud& scene = prepared.scene();
  View view = ping.view;
  view.sampling.lobe_margin = lobes_everywhere;
  view.sampling.energy = nullptr;
  Scatterers seen;
  if (view.sampling.kind == SamplingKind::surfels) {
    std::vector<std::uint32_t> surfels = parts.visible.surfel;
    std::sort(surfels.begin(), surfels.end());
    seen = split_seen(prepared, view.world_from_head, view.fan, view.gate, surfels, view.sampling);
  }
  const bool refraction = ping.options.effects.refraction == Choice::always;
  const MultipathOptions legs{.refraction = refraction};
  if (multipath) {
    parts.multipath = multipath_echoes(scene, seen, ping.environment, view, ping.sent, legs);
    parts.unreached += parts.multipath.unreached;
  }
  if (!mirrors) return;
  if (!ping.smooth.mirrors.empty())
    parts.mirrors = mirror_echoes(scene, seen, ping.environment, ping.smooth.mirrors, multipath, view, ping.sent, legs);
  std::size_t unreached = 0;
  const bool of_power = gives_power(ping.options.synthesis.method) || draws_cells(ping.options);
  parts.glints = glint_echoes(scene, ping.smooth, ping.environment, multipath, view, ping.sent,
                              {.refraction = refraction, .over_band = !of_power, .unreached = &unreached});
  parts.unreached += parts.mirrors.unreached + unreached;
}

void find_double_echoes(const PreparedScene& prepared, const ResolvedPing& ping, PingParts& parts) {
  const double rays_per_cell = ping.options.effects.double_echoes;
  if (!(rays_per_cell > 0)) return;
  std::vector<std::uint32_t> seen =
      ping.view.sampling.kind == SamplingKind::rays ? parts.sampling.scatterers.surfel : parts.visible.surfel;
  std::sort(seen.begin(), seen.end());
  seen.erase(std::unique(seen.begin(), seen.end()), seen.end());
  parts.doubles = double_echoes(prepared, seen, ping.view, ping.sent, {rays_per_cell, profile_of(ping)});
  parts.unreached += parts.doubles.unreached;
}

void add_paths(const ResolvedPing& ping, const PingParts& parts, LayerSum& layers) {
  const EffectSettings& effects = ping.options.effects;
  if (effects.multipath == Choice::always) layers.add("multipath", parts.multipath.echoes);
  if (effects.mirrors == Choice::always) {
    Echoes all = parts.mirrors.echoes;
    append(all, parts.glints);
    layers.add("mirrors", all);
  }
  if (effects.double_echoes > 0) layers.add("double-echoes", parts.doubles.echoes);
}

void draw_cells(const SceneCloud& scene, const ResolvedPing& ping, const PingParts& parts,
                SynthesizerTable& synthesizers, SimulatedPing& result) {
  CellSum cells(ping, synthesizers);
  cells.add_direct(scene, parts.sampling.scatterers, parts.direct);
  const EffectSettings& effects = ping.options.effects;
  const CellPaths paths(scene, ping);
  if (effects.multipath == Choice::always) cells.add("multipath", paths.of(parts.multipath, 1));
  if (effects.mirrors == Choice::always) cells.add("mirrors", paths.of(parts.mirrors, 2), parts.glints);
  if (effects.double_echoes > 0) cells.add("double-echoes", paths.of(parts.doubles));
  std::size_t number = 0;
  for (Reverberation& part : reverberation_echoes(ping))
    cells.add_reverberation(part.name, std::move(part.echoes), number++);
  cells.finish(scene, result);
}

Soundings detect(const SceneCloud& scene, const ResolvedPing& ping, const EchoStream& direct, const PingParts& parts,
                 const Ping& image) {
  DetectionOptions detection = ping.detection;
  detection.scene = &scene;
  if (!(ping.options.effects.double_echoes > 0)) return detect_soundings(image, direct, detection);
  const Scatterers positions = apparent_positions(parts.doubles, scene, ping.view.world_from_head,
                                                  ping.sent.medium.sound_speed, profile_of(ping));
  return detect_soundings(image, direct, StoredEchoes(positions, parts.doubles.echoes, "PingSimulator"), detection);
}

}  // namespace insonify
