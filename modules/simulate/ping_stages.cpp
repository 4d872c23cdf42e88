#include <utility>

#include "acoustics/reverberation_echoes.hpp"
#include "core/stop_watch.hpp"
#include "returns/find_contributors.hpp"
#include "returns/label_pixels.hpp"
#include "sampling/find_holes.hpp"
#include "sampling/range_gaps.hpp"
#include "sampling/seen_surfels.hpp"
#include "simulate/converge_sampling_internal.hpp"
#include "simulate/ping_stages_internal.hpp"

namespace insonify {
namespace {

void mark_holes(const PreparedScene& prepared, const ResolvedPing& ping, SimulatedPing& result) {
  const View& view = ping.view;
  SamplingOptions looks = view.sampling;
  looks.rays_per_beam = ping.options.sampling.rays_per_beam;
  const Holes holes = find_holes(prepared, view.world_from_head, view.fan, view.gate, looks);
  result.holes = {holes.directions, holes.holes.size()};
  result.ping.unknown = mask_holes(holes, view.fan, ping.head.gate);
}

Contributors contributors_of(const SceneCloud& scene, const ResolvedPing& ping, const PingParts& parts,
                             const Scatterers& patches) {
  const Multipath& bounced = parts.bounced;
  const SurfelEchoes echoes[] = {{parts.direct, patches.surfel}, {bounced.echoes, bounced.surfel, bounced.legs}};
  ContributorOptions options;
  options.per_pixel = ping.options.outputs.contributors;
  options.threads = ping.options.threads;
  return find_contributors(scene, echoes, ping.head, ping.sent.medium, options);
}

/// Whether surfels without a patch are hidden, face away or are missed by all rays.
std::vector<Visibility> others_than(const Scatterers& patches, const PreparedScene& prepared, const View& view) {
  std::vector<std::uint8_t> asked(prepared.scene().size(), 1);
  for (const std::uint32_t surfel : patches.surfel) asked[surfel] = 0;
  return find_visibility(prepared, view.world_from_head, view.fan, view.gate, asked, view.sampling);
}

SoundPaths paths_of(const SceneCloud& scene, const ResolvedPing& ping, const PingParts& parts,
                    const Scatterers& patches) {
  const auto count = static_cast<std::size_t>(ping.options.outputs.paths);
  const Medium& medium = ping.sent.medium;
  SoundPaths paths = direct_paths(patches, parts.direct, ping.view.world_from_head, medium, count);
  append(paths, bounced_paths(parts.bounced, scene, ping.environment, ping.view, medium, count));
  return paths;
}

std::vector<std::string> gap_notes(const SceneCloud& scene, const View& view, const Scatterers& patches) {
  const SamplingOptions& s = view.sampling;
  const RangeGaps gaps = count_range_gaps(scene, view.world_from_head, patches, s.rays_per_beam, s.range_resolution);
  return range_gap_notes(gaps, s.rays_per_beam, s.range_resolution);
}

/// Beams that meet too few surfels, if any, with a remedy.
std::vector<std::string> sparse_notes(const SamplingReport& report, std::size_t beams) {
  if (report.sparse_beams == 0) return {};
  return {
      std::to_string(report.sparse_beams) + " of " + std::to_string(beams) +
      " beams see mainly surfels of which a main lobe holds fewer than four: their levels are off by 2 dB and more, "
      "and some may be silent; give a denser cloud, or a mesh without a spacing"};
}

}  // namespace

std::vector<Reverberation> reverberation_echoes(const ResolvedPing& ping) {
  const Environment& e = ping.environment;
  const auto& [pose, fan, gate, sampling] = ping.view;
  ReverberationOptions options;
  options.ping = ping.options.ping;
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
  result.medium = ping.sent.medium;
  result.noise_floor_db = ping.detection.noise_floor_db;
  result.sampling = parts.sampling.report;
  const Scatterers& patches = parts.sampling.scatterers;

  result.ping.level_error_db = std::move(result.convergence.level_error_db);
  if (wanted.mask) mark_holes(prepared, ping, result);
  if (wanted.contributors > 0) {
    StopWatch watch;
    result.contributors = contributors_of(scene, ping, parts, patches);
    const SurfelEchoes direct{parts.direct, patches.surfel};
    const std::vector<Visibility> others = others_than(patches, prepared, ping.view);
    result.ping.labels = label_pixels(scene, {direct, others, result.contributors}, ping.head,
                                      ping.view.world_from_head, ping.sent.medium, ping.options.threads);
    result.seconds.contributors = watch.lap();
  }
  if (wanted.paths > 0) result.paths = paths_of(scene, ping, parts, patches);

  if (ping.view.sampling.kind == SamplingKind::rays) result.notes = gap_notes(scene, ping.view, patches);
  for (std::string& note : sparse_notes(result.sampling, ping.view.fan.beams()))
    result.notes.push_back(std::move(note));
  for (std::string& note : convergence_notes(result.convergence)) result.notes.push_back(std::move(note));
  if (wanted.scatterers) result.scatterers = std::move(parts.sampling.scatterers);
}

}  // namespace insonify
