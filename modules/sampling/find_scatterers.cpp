#include "sampling/find_scatterers.hpp"

#include <cmath>
#include <limits>
#include <memory>
#include <utility>

#include "core/error.hpp"
#include "sampling/cast_rays.hpp"
#include "sampling/direction_index.hpp"
#include "sampling/gate_surfels.hpp"
#include "sampling/split_surfels.hpp"
#include "sampling/surfel_visibility.hpp"
#include "sampling/tilt_by_relief.hpp"

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

// Surfels that give an echo, in scene order; counts the others.
std::vector<std::uint32_t> select_visible(const std::vector<GatedSurfel>& surfels, const DirectionIndex* index,
                                          int threads, SamplingReport& report) {
  std::vector<std::uint8_t> hidden(surfels.size(), 0);
  if (index) hidden = find_hidden(surfels, *index, threads);
  std::vector<std::uint32_t> visible;
  for (std::size_t s = 0; s < surfels.size(); ++s) {
    report.hidden += hidden[s];
    if (surfels[s].in_gate && surfels[s].facing && !hidden[s]) visible.push_back(surfels[s].surfel);
  }
  report.visible = visible.size();
  return visible;
}

}  // namespace

Sampling find_scatterers(const SceneCloud& scene, const Pose& world_from_head, const BeamFan& fan,
                         const RangeGate& gate, const SamplingOptions& options) {
  require_valid(scene, me);
  require_valid(world_from_head);
  require_valid(fan, me);
  require_valid(gate, me);
  require_valid(options, fan);

  // What lies in sector and gate, in head axes.
  const double half_extent = options.elevation_half_extent > 0 ? options.elevation_half_extent : fan.elevation_width;
  const Sector sector = insonified_sector(fan, half_extent);
  const HeadFrame head(scene, world_from_head);
  const auto surfels = gate_surfels(scene, head, sector, gate, options.footprint, options.threads);
  Sampling result;
  SamplingReport& report = result.report;
  report.surfels = scene.size();
  for (const GatedSurfel& s : surfels) {
    report.in_gate += s.in_gate;
    report.back_facing += s.in_gate && !s.facing;
  }

  if (options.kind == SamplingKind::rays) {
    const DirectionIndex index(surfels, options.projection, options.threads);
    CastResult cast = cast_rays(scene, surfels, index, beam_shares(fan, sector), gate, options);
    result.scatterers = std::move(cast.scatterers);
    report.rays_missed = cast.missed;
    report.visible = cast.met_surfels;
  } else {
    std::unique_ptr<DirectionIndex> index;
    if (options.occlusion) index = std::make_unique<DirectionIndex>(surfels, options.projection, options.threads);
    const auto visible = select_visible(surfels, index.get(), options.threads, report);
    const double cell = options.range_resolution > 0 ? options.range_resolution : 2 * gate.bin_size;
    result.scatterers = split_surfels(
        scene, head, visible,
        {options.scatterers_per_cell, cell, fan.beam_width, options.seed, options.threads, fan.row_width});
  }
  if (const auto relief = relief_of(scene, {options.seed, options.relief_outer_scale}))
    tilt_by_relief(scene, world_from_head, *relief, options.threads, result.scatterers);
  report.scatterers = result.scatterers.size();
  return result;
}

}  // namespace insonify
