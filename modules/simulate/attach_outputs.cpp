#include <utility>

#include "returns/find_contributors.hpp"
#include "sampling/find_holes.hpp"
#include "sampling/range_gaps.hpp"
#include "simulate/attach_outputs_internal.hpp"
#include "simulate/converge_sampling.hpp"
#include "simulate/stop_watch_internal.hpp"

namespace insonify {
namespace {

void mark_holes(const PreparedScene& prepared, const View& view, const SimulationOptions& options,
                SimulatedPing& result) {
  SamplingOptions looks = view.sampling;
  looks.rays_per_beam = options.rays_per_beam;
  const Holes holes = find_holes(prepared, view.world_from_head, view.fan, view.gate, looks);
  result.holes = {holes.directions, holes.holes.size()};
  result.ping.unknown = mask_holes(holes, result.ping.fan, result.ping.gate);
}

void name_contributors(const SceneCloud& scene, const PingParts& parts, const SonarHead& head,
                       const SimulationOptions& options, SimulatedPing& result) {
  StopWatch watch;
  const Multipath& bounced = parts.bounced;
  const SurfelEchoes heard[] = {{parts.direct, result.scatterers.surfel},
                                {bounced.echoes, bounced.surfel, bounced.legs}};
  ContributorOptions wanted;
  wanted.per_pixel = options.keep_contributors;
  wanted.threads = options.threads;
  result.contributors = find_contributors(scene, heard, head, result.medium, wanted);
  result.seconds.contributors = watch.lap();
}

SoundPaths paths_of(const SceneCloud& scene, const PingParts& parts, const SimulationOptions& options,
                    const SimulatedPing& result) {
  const auto count = static_cast<std::size_t>(options.keep_paths);
  SoundPaths paths = direct_paths(result.scatterers, parts.direct, parts.view.world_from_head, result.medium, count);
  append(paths, bounced_paths(parts.bounced, scene, parts.environment, parts.view, result.medium, count));
  return paths;
}

std::vector<std::string> gap_notes(const SceneCloud& scene, const View& view, const Scatterers& scatterers) {
  const SamplingOptions& s = view.sampling;
  const RangeGaps gaps = count_range_gaps(scene, view.world_from_head, scatterers, s.rays_per_beam, s.range_resolution);
  return range_gap_notes(gaps, s.rays_per_beam, s.range_resolution);
}

}  // namespace

void attach_outputs(const PreparedScene& prepared, const SonarHead& head, const PingParts& parts,
                    const SimulationOptions& options, SimulatedPing& result) {
  const SceneCloud& scene = prepared.scene();
  const View& view = parts.view;
  result.ping.level_error_db = std::move(result.convergence.level_error_db);
  if (options.keep_mask) mark_holes(prepared, view, options, result);
  if (options.keep_contributors > 0) name_contributors(scene, parts, head, options, result);
  if (options.keep_paths > 0) result.paths = paths_of(scene, parts, options, result);

  if (view.sampling.kind == SamplingKind::rays) result.notes = gap_notes(scene, view, result.scatterers);
  for (std::string& note : convergence_notes(result.convergence)) result.notes.push_back(std::move(note));
}

}  // namespace insonify
