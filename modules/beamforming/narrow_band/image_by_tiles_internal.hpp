#pragma once
#include <algorithm>
#include <cmath>
#include <memory>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "acoustics/echo_stream.hpp"
#include "beamforming/narrow_band/beam_transform_internal.hpp"
#include "beamforming/narrow_band/grid_echoes_internal.hpp"
#include "beamforming/narrow_band/gridded_image_internal.hpp"
#include "beamforming/narrow_band/tile_lists_internal.hpp"
#include "beamforming/numerics/flush_denormals_internal.hpp"
#include "beamforming/numerics/require_synthesis_internal.hpp"
#include "beamforming/numerics/tile_pool_internal.hpp"
#include "beamforming/pulses/pulse_loops_internal.hpp"
#include "core/parallel.hpp"

namespace insonify {

/// Some neighbouring tiles of bins, to which echoes are added chunk by chunk. A Tile of the pool is empty; it has
///
///   double add(const GriddingInput&, std::span<const std::uint32_t> list, std::size_t first_bin)
///
/// which grids the listed echoes and returns their energy [input.unit^2 bins].
template <typename Tile, typename Real>
class Slab final : public EchoSink {
 public:
  Slab(const GriddingPlan<Real>& plan, TilePool<Tile>& pool, const PulseReach& reach, std::size_t first_bin,
       std::size_t tiles)
      : plan_(plan),
        pool_(pool),
        reach_(reach),
        first_(first_bin),
        last_(std::min(first_ + tiles * plan.tile_bins, plan.axis.bins)) {
    for (std::size_t bin = first_; bin < last_; bin += plan.tile_bins) places_.push_back({bin});
    // Pulses lengthen with range: those from beyond the slab are as long as at its end, and half as much again.
    const double end = time_of(last_), half = 1.5 * reach.at(end) + 2 * plan.axis.step;
    min_range_ = 0.5 * plan.medium.sound_speed * (time_of(first_) - half);
    max_range_ = 0.5 * plan.medium.sound_speed * (end + half);
  }

  bool reaches(double min_range, double max_range) const { return max_range >= min_range_ && min_range <= max_range_; }
  bool wants(const SurfelBounds& s) const override { return reaches(s.range - s.reach, s.range + s.reach); }

  void take(const Scatterers&, const Echoes& echoes) override {
    require_finite(echoes, "PingSynthesizer");
    for (Place& place : places_) place.list.clear();
    begin_.resize(echoes.size()), end_.resize(echoes.size());
    kernels::reached_bins(echoes.delay.data(), echoes.size(),
                          {plan_.axis.start, plan_.axis.step, reach_.half, reach_.growth, static_cast<double>(first_),
                           static_cast<double>(last_)},
                          begin_.data(), end_.data());
    for (std::size_t i = 0; i < echoes.size(); ++i)
      if (begin_[i] < end_[i])
        for (std::size_t t = (begin_[i] - first_) / plan_.tile_bins; t <= (end_[i] - 1 - first_) / plan_.tile_bins; ++t)
          places_[t].list.push_back(static_cast<std::uint32_t>(i));
    for (Place& place : places_) add(echoes, place);
  }

  /// Calls silent(first bin, last bin), or form(first bin, last bin, tile, unit) where echoes were added, which returns
  /// the energy of the beams [unit^2 bins]; returns the energies of echoes and beams [Pa^2 bins].
  template <typename Form, typename Silent>
  std::pair<double, double> finish(const Form& form, const Silent& silent) {
    double gridded = 0, received = 0;
    for (Place& place : places_) {
      const std::size_t end = std::min(place.first_bin + plan_.tile_bins, last_);
      if (place.tile) {
        const double square = place.unit * place.unit;
        gridded += place.energy * square;
        received += form(place.first_bin, end, *place.tile, place.unit) * square;
        place.tile.reset();
      } else {
        silent(place.first_bin, end);
      }
    }
    return {gridded, received};
  }

 private:
  struct Place {
    std::size_t first_bin;
    typename TilePool<Tile>::Handle tile{};
    double unit = 0, energy = 0;  // unit: a power of two, of its first echoes
    std::vector<std::uint32_t> list{};
  };
  double time_of(std::size_t bin) const { return plan_.axis.start + static_cast<double>(bin) * plan_.axis.step; }

  void add(const Echoes& echoes, Place& place) {
    if (place.unit == 0) {
      double most = 0;
      for (const std::uint32_t i : place.list) most = std::max(most, std::norm(echoes.amplitude[i]));
      if (most == 0) return;
      place.unit = std::exp2(std::round(0.5 * std::log2(most)));
      place.tile = pool_.take();
    }
    place.energy += place.tile->add({echoes, reach_, plan_.common_shape && echoes.doppler.empty(), place.unit},
                                    place.list, place.first_bin);
  }

  const GriddingPlan<Real>& plan_;
  TilePool<Tile>& pool_;
  PulseReach reach_;
  std::size_t first_, last_;
  double min_range_ = 0, max_range_ = 0;
  std::vector<Place> places_;
  std::vector<std::uint32_t> begin_, end_;  // samples that the echoes of a chunk reach
};

/// The image of echoes that are not stored: each thread forms the beams of one slab of `slab_tiles` tiles after another,
/// and visits the chunks that reach into it, in order. form(tile, unit, first bin, last bin, image) forms beams, returns
/// their energy [unit^2 bins] and leaves the tile empty.
template <typename Tile, typename Real, typename Form>
GriddedImage streamed_image(const EchoStream& stream, const GriddingPlan<Real>& plan, TilePool<Tile>& pool,
                            const PulseReach& reach, std::size_t slab_tiles, int threads, const Form& form) {
  const std::size_t slab_bins = slab_tiles * plan.tile_bins, slabs = (plan.axis.bins + slab_bins - 1) / slab_bins;
  const std::span<const ChunkBounds> chunks = stream.chunks();
  ComplexGrid pressure(plan.head.fan.beams(), plan.axis.bins);
  std::vector<double> gridded(slabs), received(slabs);
  parallel_for(slabs, threads, [&](std::size_t s) {
    const FlushDenormals flush;
    Slab<Tile, Real> slab(plan, pool, reach, s * slab_bins, slab_tiles);
    for (std::size_t c = 0; c < chunks.size(); ++c)
      if (slab.reaches(chunks[c].min_range, chunks[c].max_range)) stream.visit(c, slab);
    std::tie(gridded[s], received[s]) =
        slab.finish([&](std::size_t first, std::size_t last, Tile& tile,
                        double unit) { return form(tile, unit, first, last, pressure); },
                    [&](std::size_t first, std::size_t last) { pressure.middleCols(first, last - first).setZero(); });
  });
  return {std::move(pressure), share_of(gridded, received, plan.head.fan.beams())};
}

/// The image of stored echoes: each tile of bins is computed by one thread, which grids its echoes in their order and
/// forms its beams. `form` as above.
template <typename Tile, typename Real, typename Form>
GriddedImage stored_image(const GriddingInput& input, const GriddingPlan<Real>& plan, TilePool<Tile>& pool, int threads,
                          const Form& form) {
  const TileLists lists(input.echoes, plan.axis, input.reach, plan.tile_bins, threads);
  ComplexGrid pressure(plan.head.fan.beams(), plan.axis.bins);
  std::vector<double> gridded(lists.tiles()), received(lists.tiles());
  parallel_for(lists.tiles(), threads, [&](std::size_t t) {
    const std::size_t first = t * plan.tile_bins, last = std::min(first + plan.tile_bins, plan.axis.bins);
    if (lists.of(t).empty()) {
      pressure.middleCols(first, last - first).setZero();
      return;
    }
    const FlushDenormals flush;
    const auto tile = pool.take();
    gridded[t] = tile->add(input, lists.of(t), first);
    received[t] = form(*tile, input.unit, first, last, pressure);
  });
  return {std::move(pressure), share_of(gridded, received, plan.head.fan.beams())};
}

}  // namespace insonify
