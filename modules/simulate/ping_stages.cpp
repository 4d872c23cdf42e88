// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <utility>

#include "acoustics/reverberation_echoes.hpp"
#include "acoustics/surface_laws.hpp"
#include "acoustics/trace_paths.hpp"
#include "beamforming/engine.hpp"
#include "core/stop_watch.hpp"
#include "core/text.hpp"
#include "core/units.hpp"
#include "returns/beam_bands.hpp"
#include "returns/cell_labels.hpp"
#include "returns/find_contributors.hpp"
#include "returns/label_pixels.hpp"
#include "sampling/find_holes.hpp"
#include "sampling/range_gaps.hpp"
#include "sampling/seen_surfels.hpp"
#include "simulate/part_views_internal.hpp"
#include "simulate/ping_stages_internal.hpp"
#include "sonar/pulse_kind.hpp"

namespace insonify {
namespace {

void mark_holes(const PreparedScene& prepared, const ResolvedPing& ping, SimulatedPing& result) {
  const View& view = ping.view;
  SamplingOptions looks = view.sampling;
  looks.rays_per_beam = ping.options.sampling.rays_per_beam;
  const Holes holes = find_holes(prepared, view.world_from_head, view.fan, view.gate, looks);
  result.report.holes = {holes.directions, holes.holes.size()};
  result.ping.unknown = mask_holes(holes, view.fan, ping.head.gate);
}

/// Finds whether surfels without a patch are hidden, face away or are missed by all rays.
std::vector<Visibility> others_than(const Scatterers& patches, const PreparedScene& prepared, const View& view) {
  std::vector<std::uint8_t> queried(prepared.scene().size(), 1);
  for (const std::uint32_t surfel : patches.surfel) queried[surfel] = 0;
  return find_visibility(prepared, view.world_from_head, view.fan, view.gate, queried, view.sampling);
}

/// Finds contributors and labels (E63, E125): of all beams at once, or band by band if the options take them so.
void add_contributors(const PreparedScene& prepared, const ResolvedPing& ping, const PingParts& parts,
                      SimulatedPing& result) {
  const SceneCloud& scene = prepared.scene();
  const OutputSettings& wanted = ping.options.outputs;
  const std::vector<std::uint32_t>& surfel = parts.sampling.scatterers.surfel;
  const auto of = [](const Multipath& m) { return SurfelEchoes{m.echoes, m.surfel, m.legs}; };
  const SurfelEchoes echoes[] = {{parts.direct, surfel},
                                 of(parts.multipath),
                                 of(parts.mirrors),
                                 {parts.doubles.echoes, parts.doubles.last, {}, parts.doubles.first}};
  const std::vector<Visibility> others = others_than(parts.sampling.scatterers, prepared, ping.view);
  ContributorOptions options;
  options.per_pixel = wanted.contributors;
  options.threads = ping.options.threads;
  const BeamBands bands = wanted.contributor_sink
                              ? beam_bands(ping.head, options.per_pixel, wanted.contributor_band_mib)
                              : BeamBands{{0, ping.head.fan.beams()}};
  for (const auto& [first, end] : bands) {
    const SonarHead head = with_beams(ping.head, first, end);
    Contributors found = find_contributors(scene, echoes, head, ping.sent.medium, options);
    put_labels(label_pixels(scene, {echoes[0], others, found}, head, ping.view.world_from_head, ping.sent.medium,
                            options.threads),
               first, ping.head.fan.beams(), result.ping.labels);
    if (!ping.stands_for.empty())
      for (std::vector<std::uint32_t>* surfels : {&found.surfel, &found.surfel_before})
        for (std::uint32_t& named : *surfels)
          if (named != Contributors::none) named = ping.stands_for[named];
    if (wanted.contributor_sink)
      wanted.contributor_sink->take(found, first);
    else
      result.outputs.contributors = std::move(found);
  }
  if (scene.parts.empty()) return;
  std::vector<std::uint8_t> seen(scene.size());
  for (std::size_t i = 0; i < seen.size(); ++i) seen[i] = others[i] == Visibility::seen;
  for (const std::uint32_t i : surfel) seen[i] = 1;
  result.ping.labels.views = part_views(scene, seen, ping);
}

/// Completes the labels of drawn cells: shadow, and how the head sees the parts of the scene.
void complete_labels(const PreparedScene& prepared, const ResolvedPing& ping, const Scatterers& patches,
                     PixelLabels& labels) {
  std::vector<std::uint8_t> seen(prepared.scene().size());
  for (const std::uint32_t i : patches.surfel) seen[i] = 1;
  const auto& [pose, fan, gate, sampling] = ping.view;
  mark_shadow(prepared, {pose, insonified_sector(fan, sampling), gate, sampling.footprint}, seen, ping.head,
              ping.options.threads, labels);
  if (!prepared.scene().parts.empty()) labels.views = part_views(prepared.scene(), seen, ping);
}

SoundPaths paths_of(const SceneCloud& scene, const ResolvedPing& ping, const PingParts& parts,
                    const Scatterers& patches) {
  const auto count = static_cast<std::size_t>(ping.options.outputs.paths);
  const Medium& medium = ping.sent.medium;
  SoundPaths paths = direct_paths(patches, parts.direct, ping.view.world_from_head, medium, count);
  for (const Multipath* bounced : {&parts.multipath, &parts.mirrors})
    append(paths, multipath_paths(*bounced, scene, ping.view, medium, count));
  return paths;
}

std::vector<std::string> gap_notes(const SceneCloud& scene, const View& view, const Scatterers& patches) {
  const SamplingOptions& s = view.sampling;
  const RangeGaps gaps = count_range_gaps(scene, view.world_from_head, patches, s.rays_per_beam, s.range_resolution);
  return range_gap_notes(gaps, s.rays_per_beam, s.range_resolution);
}

/// The materials that surfels have.
std::vector<Material> materials_in(const SceneCloud& scene) {
  std::vector<bool> used(scene.materials.size());
  for (const std::uint16_t m : scene.material) used[m] = true;
  std::vector<Material> materials;
  for (std::size_t m = 0; m < used.size(); ++m)
    if (used[m]) materials.push_back(scene.materials[m]);
  return materials;
}

/// Beams that meet too few surfels, if any, with a remedy.
std::string sparse_note(const SamplingReport& report, std::size_t beams) {
  if (report.sparse_beams == 0) return {};
  return "the scene is too coarse for " + std::to_string(report.sparse_beams) + " of " + std::to_string(beams) +
         " beams: their main lobes hold fewer than four surfels; levels of these beams are wrong by 2 dB or more, and "
         "some may be silent; give a denser cloud, or a mesh without --mesh-spacing";
}

/// Returns notes on what limits the accuracy of a ping by its scene: too few rays, laws out of their range, too few
/// surfels.
std::vector<PingNote> scene_notes(const SceneCloud& scene, const ResolvedPing& ping, const Scatterers& patches,
                                  const PingReport& report) {
  std::vector<PingNote> notes;
  const auto add = [&](std::string kind, std::string text) {
    if (!text.empty()) notes.push_back({std::move(kind), std::move(text), 1, ping.event.number});
  };
  if (ping.view.sampling.kind == SamplingKind::rays)
    add("few rays", joined(gap_notes(scene, ping.view, patches), "; "));
  for (const Material& m : materials_in(scene))
    add("law of " + m.name,
        joined(surface_notes({&m, 1}, ping.head.pulse.centre_frequency, ping.sent.medium.sound_speed), "; "));
  add("sparse beams", sparse_note(report.sampling, ping.view.fan.beams()));
  return notes;
}

/// Returns true if beams formed over the whole band hear beside their sector as in main lobes, at the upper end of the
/// band.
bool receives_all_ahead(const ResolvedPing& ping) {
  if (!receives_whole_band(ping.options.synthesis.method)) return false;
  const double highest = ping.head.pulse.centre_frequency + spectrum_nodes(ping.head.pulse).back().frequency;
  return has_further_lobes(ping.head, ping.sent.medium.sound_speed / highest);
}

}  // namespace

std::vector<Reverberation> reverberation_echoes(const ResolvedPing& ping) {
  const Environment& e = ping.environment;
  const auto& [pose, fan, gate, sampling] = ping.view;
  ReverberationOptions options;
  options.ping = ping.event.number;
  options.azimuth_margin = receives_all_ahead(ping) ? pi : 0;
  std::vector<Reverberation> parts;
  if (e.volume_scattering_db) parts.push_back({"volume", volume_echoes(e, fan, gate, ping.sent, options)});
  if (e.surface && e.surface->scattering_strength_db)
    parts.push_back({"surface", surface_echoes(e, pose, fan, gate, ping.sent, options)});
  if (e.bottom && e.bottom->lambert_mu)
    parts.push_back({"bottom", bottom_echoes(e, pose, fan, gate, ping.sent, options)});
  return parts;
}

void attach_outputs(const PreparedScene& prepared, const ResolvedPing& ping, PingParts parts, SimulatedPing& result) {
  const SceneCloud& scene = prepared.scene();
  const OutputSettings& wanted = ping.options.outputs;
  PingReport& report = result.report;
  report.options = ping.options;
  report.medium = ping.sent.medium;
  report.noise_floor_db = ping.detection.noise_floor_db;
  report.sampling = parts.sampling.report;
  report.refraction.unreached = parts.unreached;
  const Scatterers& patches = parts.sampling.scatterers;

  if (wanted.mask) mark_holes(prepared, ping, result);
  if (wanted.contributors > 0) {
    StopWatch watch;
    add_contributors(prepared, ping, parts, result);
    report.seconds.contributors = watch.lap();
  }
  if (!result.ping.labels.empty() && draws_cells(ping.options))
    complete_labels(prepared, ping, patches, result.ping.labels);
  if (wanted.paths > 0) result.outputs.paths = paths_of(scene, ping, parts, patches);

  report.notes = scene_notes(scene, ping, patches, report);
  if (wanted.scatterers) result.outputs.scatterers = std::move(parts.sampling.scatterers);
}

}  // namespace insonify
