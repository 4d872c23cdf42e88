// SPDX-License-Identifier: BSD-3-Clause
#include "sampling/seen_surfels.hpp"

#include "core/error.hpp"
#include "sampling/choose_projection_internal.hpp"
#include "sampling/count_pieces_internal.hpp"
#include "sampling/gate_surfels_internal.hpp"
#include "sampling/list_where_internal.hpp"
#include "sampling/split_surfels_internal.hpp"
#include "sampling/surfel_visibility_internal.hpp"

namespace insonify {

namespace {

void require_valid(const SceneCloud& scene, const BeamFan& fan, const RangeGate& gate,
                   const std::vector<std::uint8_t>& queried) {
  require_valid(fan, "find_visibility");
  require_valid(gate, "find_visibility");
  if (queried.size() != scene.size())
    fail(ErrorKind::argument, "find_visibility: asked has ", queried.size(), " entries, must have one per surfel (",
         scene.size(), ")");
}

// Visibility of the queried surfels; those that are not gated are outside.
std::vector<Visibility> visibility_of(GatedSurfels surfels, const std::vector<std::uint8_t>& queried,
                                      const SamplingOptions& options) {
  // find_hidden tests the surfels in the gate; the others only occlude.
  for (GatedSurfel& s : surfels) s.in_gate = s.in_gate && queried[s.surfel];
  std::vector<std::uint8_t> hidden(surfels.size(), 0);
  if (options.occlusion) {
    const std::size_t queries = count_where(surfels.size(), options.threads,
                                            [&](std::size_t s) { return surfels[s].in_gate && surfels[s].facing; });
    hidden =
        find_hidden(surfels, choose_projection(surfels, options.projection, queries, options.threads), options.threads);
  }

  std::vector<Visibility> visibility(queried.size());
  for (std::size_t i = 0; i < visibility.size(); ++i)
    visibility[i] = queried[i] ? Visibility::outside : Visibility::not_queried;
  for (std::size_t s = 0; s < surfels.size(); ++s)
    if (surfels[s].in_gate)
      visibility[surfels[s].surfel] = !surfels[s].facing ? Visibility::turned_away
                                      : hidden[s]        ? Visibility::hidden
                                                         : Visibility::seen;
  return visibility;
}

}  // namespace

std::vector<Visibility> find_visibility(const SceneCloud& scene, const Pose& world_from_head, const BeamFan& fan,
                                        const RangeGate& gate, const std::vector<std::uint8_t>& queried,
                                        const SamplingOptions& options) {
  require_valid(scene, fan, gate, queried);
  return visibility_of(gate_surfels(scene, HeadFrame(scene, world_from_head), insonified_sector(fan, options), gate,
                                    options.footprint, options.threads),
                       queried, options);
}

std::vector<Visibility> find_visibility(const PreparedScene& prepared, const Pose& world_from_head, const BeamFan& fan,
                                        const RangeGate& gate, const std::vector<std::uint8_t>& queried,
                                        const SamplingOptions& options) {
  const SceneCloud& scene = prepared.scene();
  require_valid(scene, fan, gate, queried);
  return visibility_of(gate_surfels(prepared, HeadFrame(scene, world_from_head), insonified_sector(fan, options), gate,
                                    options.footprint, options.threads),
                       queried, options);
}

Scatterers split_listed(const SceneCloud& scene, const Pose& world_from_head, const BeamFan& fan, const RangeGate& gate,
                        const std::vector<std::uint32_t>& surfels, const SamplingOptions& options) {
  const HeadFrame head(scene, world_from_head);
  const SampledCells cells(fan, gate, options);
  SamplingOptions alike = options;
  alike.energy = nullptr;
  const PieceCounts counts = count_pieces(scene, head, surfels, cells, gate, alike);
  return split_surfels(scene, head, surfels, first_pieces(counts.pieces, cells.scatterers_per_cell()),
                       cells.range_resolution(), options.seed, options.threads);
}

Scatterers split_listed(const PreparedScene& prepared, const Pose& world_from_head, const BeamFan& fan,
                        const RangeGate& gate, const std::vector<std::uint32_t>& surfels,
                        const SamplingOptions& options) {
  return split_listed(prepared.scene(), world_from_head, fan, gate, surfels, options);
}

}  // namespace insonify
