// SPDX-License-Identifier: BSD-3-Clause
#include "sampling/find_scatterers.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "sampling/cast_rays_internal.hpp"
#include "sampling/choose_projection_internal.hpp"
#include "sampling/count_pieces_internal.hpp"
#include "sampling/gate_surfels_internal.hpp"
#include "sampling/list_where_internal.hpp"
#include "sampling/sort_by_place_internal.hpp"
#include "sampling/sparse_beams_internal.hpp"
#include "sampling/split_surfels_internal.hpp"
#include "sampling/surfel_visibility_internal.hpp"
#include "sampling/tilt_by_relief_internal.hpp"
#include "sampling/visible_surfels.hpp"

// Finds the visible patches of a scene (E16, E17):
//   1. gate: transform surfels to head axes, keep those whose disc overlaps the sector and is within the far range
//      (gate_surfels; a prepared scene visits only the blocks that overlap the region);
//   2. project: find the surfels that cover a direction, by KD-trees over unit vectors, one per octave of angular
//      footprint (direction_index), or by a raster with a depth buffer (direction_raster), with the same result;
//   3. decide: a surfel is hidden if those in front of it cover it on more than one side (surfel_visibility); a ray
//      hits the front cluster of the surfels that cover it (hit_rule, cast_rays);
//   4. split visible surfels into parts, several per resolution cell (split_surfels);
//   5. tilt the normals of rough materials by micro-relief (tilt_by_relief).
// Cost: O(n) for the gate, O(m log m) for the m surfels inside by KD-trees, about O(m) by the raster; parallel.
namespace insonify {
namespace {

constexpr const char* me = "find_scatterers";

void require_valid(const SamplingOptions& options, const BeamFan& fan) {
  const auto require = [](bool good, const char* name, double value, const char* rule) {
    if (!good) fail(ErrorKind::argument, me, ": options.", name, " = ", value, ", must be ", rule);
  };
  const auto at_least_0 = [](double value) { return value >= 0 && std::isfinite(value); };
  require(at_least_0(options.scatterers_per_cell), "scatterers_per_cell", options.scatterers_per_cell, ">= 0");
  require(at_least_0(options.range_resolution), "range_resolution", options.range_resolution, ">= 0 m");
  require(at_least_0(options.elevation_half_extent), "elevation_half_extent", options.elevation_half_extent,
          ">= 0 rad");
  require(at_least_0(options.relief_outer_scale), "relief_outer_scale", options.relief_outer_scale, ">= 0 m");
  require(at_least_0(options.azimuth_margin), "azimuth_margin", options.azimuth_margin, ">= 0 rad");
  require(at_least_0(options.lobe_margin), "lobe_margin", options.lobe_margin, ">= 0");
  require(options.footprint > 0 && std::isfinite(options.footprint), "footprint", options.footprint, "> 0");
  require(options.rays_per_beam >= 1, "rays_per_beam", options.rays_per_beam, "at least 1");
  const double rays = static_cast<double>(fan.beams()) * options.rays_per_beam;
  if (options.kind == SamplingKind::rays && rays > std::numeric_limits<std::uint32_t>::max())
    fail(ErrorKind::argument, me, ": options.rays_per_beam = ", options.rays_per_beam, " makes ", rays,
         " rays, must be below 2^32");
}

void require_valid(const Pose& pose) {
  if (!pose.matrix().allFinite()) fail(ErrorKind::argument, me, ": world_from_head must be finite");
  const Eigen::Matrix3d r = pose.linear();
  if (!(r.transpose() * r).isIdentity(1e-6) || r.determinant() < 0)
    fail(ErrorKind::argument, me, ": world_from_head must be a rotation and a translation");
}

// All parameters of a ping except the scene.
struct View {
  const Pose& world_from_head;
  const BeamFan& fan;
  const RangeGate& gate;
  const SamplingOptions& options;
  Sector sector;
  HeadFrame head;

  View(const SceneCloud& scene, const Pose& pose, const BeamFan& of_fan, const RangeGate& of_gate,
       const SamplingOptions& o)
      : world_from_head(pose),
        fan(of_fan),
        gate(of_gate),
        options(o),
        sector(insonified_sector(fan, o)),
        head(scene, pose) {}
};

// Returns the surfels that contribute echoes, in scene order; counts the others in the report.
std::vector<std::uint32_t> select_visible(const GatedSurfels& surfels, const SamplingOptions& options,
                                          SamplingReport& report) {
  std::vector<std::uint8_t> hidden(surfels.size(), 0);
  if (options.occlusion) {
    report.projection =
        choose_projection(surfels, options.projection, report.in_gate - report.back_facing, options.threads);
    hidden = find_hidden(surfels, report.projection, options.threads);
  }
  auto visible = list_where(surfels.size(), options.threads,
                            [&](std::size_t s) { return surfels[s].in_gate && surfels[s].facing && !hidden[s]; });
  for (std::uint32_t& v : visible) v = surfels[v].surfel;
  report.visible = visible.size();
  report.hidden = report.in_gate - report.back_facing - report.visible;
  return visible;
}

SamplingReport report_of(const SceneCloud& scene, const GatedSurfels& surfels, const View& view) {
  const SamplingOptions& options = view.options;
  SamplingReport report;
  report.surfels = scene.size();
  report.in_gate = count_where(surfels.size(), options.threads, [&](std::size_t s) { return surfels[s].in_gate; });
  report.back_facing = count_where(surfels.size(), options.threads,
                                   [&](std::size_t s) { return surfels[s].in_gate && !surfels[s].facing; });
  report.sparse_beams = count_sparse_beams(surfels, view.fan, view.gate, options.threads);
  return report;
}

Sampling split(const SceneCloud& scene, std::span<const std::uint32_t> surfels, const View& view) {
  const SamplingOptions& options = view.options;
  const SampledCells cells(view.fan, view.gate, options);
  const PieceCounts counts = count_pieces(scene, view.head, surfels, cells, view.gate, options);
  Sampling result;
  result.scatterers = split_surfels(scene, view.head, surfels, first_pieces(counts.pieces, options.scatterers_per_cell),
                                    cells.range_resolution(), options.seed, options.threads);
  result.report.capped = counts.capped;
  return result;
}

// Samples the visible part of the gated surfels.
Sampling sample(const SceneCloud& scene, const GatedSurfels& surfels, const View& view) {
  const SamplingOptions& options = view.options;
  Sampling result{{}, report_of(scene, surfels, view)};
  SamplingReport& report = result.report;
  if (options.kind == SamplingKind::rays) {
    const auto shares = beam_cells(view.fan, view.sector);
    report.projection =
        choose_projection(surfels, options.projection, shares.size() * options.rays_per_beam, options.threads);
    CastResult cast = cast_rays(scene, surfels, report.projection, shares, view.gate, options);
    result.scatterers = std::move(cast.scatterers);
    report.rays_missed = cast.missed;
    report.rays_unknown = cast.unknown;
    report.visible = cast.hit_surfels;
  } else {
    const auto visible = select_visible(surfels, options, report);
    Sampling pieces = split(scene, visible, view);
    result.scatterers = std::move(pieces.scatterers);
    report.capped = pieces.report.capped;
  }
  report.scatterers = result.scatterers.size();
  return result;
}

void require_valid(const Pose& world_from_head, const BeamFan& fan, const RangeGate& gate,
                   const SamplingOptions& options) {
  require_valid(world_from_head);
  require_valid(fan, me);
  require_valid(gate, me);
  require_valid(options, fan);
}

void tilt(const SceneCloud& scene, const View& view, double outer_scale, Sampling& sampling) {
  if (const auto relief = relief_of(scene, {view.options.seed, outer_scale}))
    tilt_by_relief(scene, view.world_from_head, *relief, view.options.threads, sampling.scatterers);
}

double outer_scale(const PreparedScene& prepared, const SamplingOptions& options) {
  return options.relief_outer_scale > 0 ? options.relief_outer_scale : prepared.whole().mean_spacing;
}

}  // namespace

Sector insonified_sector(const BeamFan& fan, const SamplingOptions& options) {
  const double half_extent = options.elevation_half_extent > 0 ? options.elevation_half_extent : fan.elevation_width;
  return insonified_sector(fan, half_extent, options.azimuth_margin);
}

Sampling find_scatterers(const SceneCloud& scene, const Pose& world_from_head, const BeamFan& fan,
                         const RangeGate& gate, const SamplingOptions& options) {
  require_valid(scene, me);
  require_valid(world_from_head, fan, gate, options);
  const View view(scene, world_from_head, fan, gate, options);
  Sampling sampling =
      sample(scene, gate_surfels(scene, view.head, view.sector, gate, options.footprint, options.threads), view);
  tilt(scene, view, options.relief_outer_scale, sampling);
  return sampling;
}

Sampling find_scatterers(const PreparedScene& prepared, const Pose& world_from_head, const BeamFan& fan,
                         const RangeGate& gate, const SamplingOptions& options) {
  const SceneCloud& scene = prepared.scene();
  require_valid(world_from_head, fan, gate, options);
  const View view(scene, world_from_head, fan, gate, options);
  Sampling sampling =
      sample(scene, gate_surfels(prepared, view.head, view.sector, gate, options.footprint, options.threads), view);
  tilt(scene, view, outer_scale(prepared, options), sampling);
  return sampling;
}

VisibleSurfels find_visible(const PreparedScene& prepared, const Pose& world_from_head, const BeamFan& fan,
                            const RangeGate& gate, const SamplingOptions& options, SurfelOrder order) {
  const SceneCloud& scene = prepared.scene();
  require_valid(world_from_head, fan, gate, options);
  const View view(scene, world_from_head, fan, gate, options);
  const auto gated = gate_surfels(prepared, view.head, view.sector, gate, options.footprint, options.threads);
  VisibleSurfels result;
  result.report = report_of(scene, gated, view);
  const SampledCells cells(fan, gate, options);
  const auto visible = select_visible(gated, options, result.report);
  const PieceCounts counts = count_pieces(scene, view.head, visible, cells, gate, options);
  PlacedSurfels placed = sort_by_place(scene, view.head, gate, order, visible, counts.pieces, options.threads);
  result.surfel = std::move(placed.surfel), result.bounds = std::move(placed.bounds);
  result.first = first_pieces(placed.pieces, options.scatterers_per_cell);
  result.report.capped = counts.capped;
  result.report.scatterers = result.first.back();
  result.options = options;
  result.options.range_resolution = cells.range_resolution();
  result.options.relief_outer_scale = outer_scale(prepared, options);
  result.relief = relief_of(scene, {options.seed, result.options.relief_outer_scale});
  return result;
}

Scatterers split_seen(const PreparedScene& prepared, const Pose& world_from_head, const BeamFan& fan,
                      const RangeGate& gate, std::span<const std::uint32_t> surfels, const SamplingOptions& options) {
  const SceneCloud& scene = prepared.scene();
  require_valid(world_from_head, fan, gate, options);
  const View view(scene, world_from_head, fan, gate, options);
  Sampling sampling = split(scene, surfels, view);
  tilt(scene, view, outer_scale(prepared, options), sampling);
  return std::move(sampling.scatterers);
}

Scatterers make_chunks(const SceneCloud& scene, const Pose& world_from_head, const VisibleSurfels& visible,
                       std::span<const std::uint32_t> which, int threads) {
  std::vector<std::uint32_t> surfels;
  std::vector<std::size_t> first{0};
  for (const std::uint32_t k : which) {
    surfels.push_back(visible.surfel[k]);
    first.push_back(first.back() + visible.first[k + 1] - visible.first[k]);
  }
  Scatterers pieces = split_surfels(scene, HeadFrame(scene, world_from_head), surfels, first,
                                    visible.options.range_resolution, visible.options.seed, threads);
  if (visible.relief) tilt_by_relief(scene, world_from_head, *visible.relief, threads, pieces);
  return pieces;
}

Scatterers make_chunks(const SceneCloud& scene, const Pose& world_from_head, const VisibleSurfels& visible) {
  std::vector<std::uint32_t> all(visible.surfel.size());
  std::iota(all.begin(), all.end(), 0);
  return make_chunks(scene, world_from_head, visible, all, visible.options.threads);
}

}  // namespace insonify
