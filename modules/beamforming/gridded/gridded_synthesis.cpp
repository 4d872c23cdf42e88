// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <numeric>
#include <utility>

#include "beamforming/gridded/gridded_synthesis_internal.hpp"
#include "beamforming/gridded/tile_lists_internal.hpp"
#include "beamforming/numerics/flush_denormals_internal.hpp"
#include "beamforming/numerics/require_synthesis_internal.hpp"
#include "beamforming/row_echoes_internal.hpp"
#include "core/parallel.hpp"

// Gridded synthesis (E13): non-uniform FFTs over the array, bin by bin, after Barnett, Magland, af Klinteberg (2019).
//   1. gridding: each echo adds its pulse, cut at the tolerance, times the kernel (E60) to a grid over direction with
//      an oversampling factor of 2; in tiles of bins, each tile by one thread (grid_tile, grid_sweeps);
//   2. of a planar array, each row of beams weighs the lines of the grid by the response of the column (column_plan);
//   3. transform: per bin an FFT turns the grid into element series (type 1);
//   4. deconvolution and shading: one real factor per element, with 1 / (kernel transform)^2 for both transforms;
//   5. transform back, and interpolation with the same kernel to the beam directions (type 2).
// Cost: echoes x pulse samples x kernel widths + rows x bins x (grid log grid + beams x kernel width). No transform
// runs along range: nothing wraps around, and errors are local in range. Kernel width and precision follow from the
// tolerance and the fraction of the gridded energy that the beams receive (gridded_engine).
namespace insonify {
namespace {

/// Energies of echoes and beams of each part of an image [Pa^2 bins].
struct Energies {
  std::vector<double> gridded, received;

  explicit Energies(std::size_t parts) : gridded(parts, 0), received(parts, 0) {}
  double share(std::size_t beams) const {
    const double all = std::accumulate(gridded.begin(), gridded.end(), 0.0) * static_cast<double>(beams);
    return all > 0 ? std::sqrt(std::accumulate(received.begin(), received.end(), 0.0) / all) : 1;
  }
};

/// Some neighbouring tiles of bins, to which echoes are added chunk by chunk.
template <typename Real>
class Slab final : public EchoSink {
 public:
  Slab(const GriddingPlan<Real>& plan, TilePool<GridTile<Real>>& pool, const PulseReach& reach, std::size_t first_bin,
       std::size_t tiles)
      : plan_(plan),
        pool_(pool),
        reach_(reach),
        first_(first_bin),
        last_(std::min(first_ + tiles * plan.tile_bins, plan.axis.bins)) {
    for (std::size_t bin = first_; bin < last_; bin += plan.tile_bins) positions_.push_back({bin});
    // Pulses lengthen with range: those from beyond the slab are as long as at its end, and half as much again.
    const double end = plan.axis.time_of(static_cast<double>(last_)), half = 1.5 * reach.at(end) + 2 * plan.axis.step;
    min_range_ = 0.5 * plan.medium.sound_speed * (plan.axis.time_of(static_cast<double>(first_)) - half);
    max_range_ = 0.5 * plan.medium.sound_speed * (end + half);
  }

  bool reaches(double min_range, double max_range) const { return max_range >= min_range_ && min_range <= max_range_; }
  bool wants(const SurfelBounds& s) const override { return reaches(s.range - s.reach, s.range + s.reach); }

  void take(const Scatterers&, const Echoes& echoes) override {
    require_finite(echoes, "GriddedEngine");
    for (Position& position : positions_) position.list.clear();
    each_tile(echoes, 0, echoes.size(), plan_.axis, reach_, {plan_.tile_bins, first_, last_},
              [&](std::size_t t, std::size_t i) { positions_[t].list.push_back(static_cast<std::uint32_t>(i)); });
    for (Position& position : positions_) {
      if (position.list.empty()) continue;
      if (!position.tile) position.tile = pool_.take();
      position.tile->add(echoes, reach_, position.list, position.first_bin);
    }
  }

  void form_beams(const BeamTransform<Real>& to_beams, ComplexGrid& pressure, double& gridded, double& received) {
    for (Position& position : positions_) {
      if (!position.tile) position.tile = pool_.take();
      position.tile->form_beams(to_beams, position.first_bin, std::min(position.first_bin + plan_.tile_bins, last_),
                                pressure, gridded, received);
      pool_.give(std::move(position.tile));
    }
  }

 private:
  struct Position {
    std::size_t first_bin;
    std::unique_ptr<GridTile<Real>> tile{};
    std::vector<std::uint32_t> list{};
  };

  const GriddingPlan<Real>& plan_;
  TilePool<GridTile<Real>>& pool_;
  PulseReach reach_;
  std::size_t first_, last_;
  double min_range_ = 0, max_range_ = 0;
  std::vector<Position> positions_;
};

}  // namespace

template <typename Real>
GriddedSynthesis<Real>::GriddedSynthesis(const SonarHead& head, const Medium& medium, const SynthesisOptions& options,
                                         KernelTolerance kernels)
    : plan_(head, medium, options.tolerance, kernels),
      threads_(options.threads),
      to_beams_(plan_),
      tiles_([this] { return std::make_unique<GridTile<Real>>(plan_); }) {}

template <typename Real>
GriddedImage GriddedSynthesis<Real>::image(const Echoes& echoes) const {
  const PulseReach reach = plan_.reach(!echoes.doppler.empty());
  const TileLists lists(echoes, plan_.axis, reach, plan_.tile_bins, threads_);
  const std::size_t beams = plan_.head.fan.beams();
  ComplexGrid pressure(beams, plan_.axis.bins);
  Energies energies(lists.tiles());
  parallel_for(lists.tiles(), threads_, [&](std::size_t t) {
    const std::size_t first = t * plan_.tile_bins, last = std::min(first + plan_.tile_bins, plan_.axis.bins);
    const FlushDenormals flush;
    auto tile = tiles_.take();
    tile->add(echoes, reach, lists.of(t), first);
    tile->form_beams(to_beams_, first, last, pressure, energies.gridded[t], energies.received[t]);
    tiles_.give(std::move(tile));
  });
  return {std::move(pressure), energies.share(beams)};
}

template <typename Real>
GriddedImage GriddedSynthesis<Real>::image(const EchoStream& stream) const {
  // More tiles in a slab: fewer parts made twice, and more memory for each thread.
  const std::size_t slab_tiles = plan_.column ? 1 : 8, slab_bins = slab_tiles * plan_.tile_bins,
                    slabs = (plan_.axis.bins + slab_bins - 1) / slab_bins, beams = plan_.head.fan.beams();
  const PulseReach reach = plan_.reach(stream.moving());
  const std::span<const ChunkBounds> chunks = stream.chunks();
  ComplexGrid pressure(beams, plan_.axis.bins);
  Energies energies(slabs);
  parallel_for(slabs, threads_, [&](std::size_t s) {
    const FlushDenormals flush;
    Slab<Real> slab(plan_, tiles_, reach, s * slab_bins, slab_tiles);
    for (std::size_t c = 0; c < chunks.size(); ++c)
      if (slab.reaches(chunks[c].min_range, chunks[c].max_range)) stream.visit(c, slab);
    slab.form_beams(to_beams_, pressure, energies.gridded[s], energies.received[s]);
  });
  return {std::move(pressure), energies.share(beams)};
}

template class GriddedSynthesis<float>;
template class GriddedSynthesis<double>;

}  // namespace insonify
