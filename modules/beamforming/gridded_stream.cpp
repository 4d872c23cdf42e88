#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>

#include "beamforming/flush_denormals_internal.hpp"
#include "beamforming/gridded_synthesis_internal.hpp"
#include "beamforming/require_synthesis_internal.hpp"
#include "core/parallel.hpp"

namespace insonify {
namespace {

constexpr std::size_t slab_tiles = 8;  // more of them: fewer parts made twice, and more memory for each thread

/// Tiles of neighbouring bins, to which echoes are added chunk by chunk.
template <typename Real>
class Slab {
 public:
  Slab(const GriddingPlan<Real>& plan, const PulseReach& reach, std::size_t first_bin)
      : plan_(plan),
        reach_(reach),
        first_(first_bin),
        last_(std::min(first_ + slab_tiles * plan.tile_bins, plan.axis.bins)) {
    for (std::size_t bin = first_; bin < last_; bin += plan.tile_bins) tiles_.push_back({bin});
    // Pulses lengthen with range: those from beyond the slab are as long as at its end, and half as much again.
    const double end = time_of(last_), half = 1.5 * reach.at(end) + 2 * plan.axis.step;
    min_range_ = 0.5 * plan.medium.sound_speed * (time_of(first_) - half);
    max_range_ = 0.5 * plan.medium.sound_speed * (end + half);
  }

  bool reaches(double min_range, double max_range) const { return max_range >= min_range_ && min_range <= max_range_; }

  void add(const Echoes& echoes) {
    require_finite(echoes, "PingSynthesizer");
    for (Tile& tile : tiles_) tile.list.clear();
    for (std::size_t i = 0; i < echoes.size(); ++i) {
      auto [begin, end] = plan_.axis.around(echoes.delay[i], reach_.at(echoes.delay[i]));
      begin = std::max(begin, first_), end = std::min(end, last_);
      for (std::size_t bin = begin; bin < end; bin = (bin / plan_.tile_bins + 1) * plan_.tile_bins)
        tiles_[(bin - first_) / plan_.tile_bins].list.push_back(static_cast<std::uint32_t>(i));
    }
    for (Tile& tile : tiles_) add(echoes, tile);
  }

  /// Calls form(first bin, tile, unit) for each tile that echoes were added to, and returns their energy [Pa^2 bins].
  template <typename Form>
  double finish(Form&& form) {
    double energy = 0;
    for (Tile& tile : tiles_) {
      if (!tile.grid) continue;
      tile.grid->restore_flushed_sums();
      energy += tile.energy * tile.unit * tile.unit;
      form(tile.first_bin, *tile.grid, tile.unit);
    }
    return energy;
  }

 private:
  struct Tile {
    std::size_t first_bin;
    std::unique_ptr<GridTile<Real>> grid{};
    double unit = 0, energy = 0;  // unit: a power of two, of its first echoes
    std::vector<std::uint32_t> list{};
  };
  double time_of(std::size_t bin) const { return plan_.axis.start + static_cast<double>(bin) * plan_.axis.step; }

  void add(const Echoes& echoes, Tile& tile) {
    if (tile.unit == 0) {
      double most = 0;
      for (const std::uint32_t i : tile.list) most = std::max(most, std::norm(echoes.amplitude[i]));
      if (most == 0) return;
      tile.unit = std::exp2(std::round(0.5 * std::log2(most)));
      tile.grid = std::make_unique<GridTile<Real>>(plan_);
    }
    tile.energy +=
        grid_echoes(plan_, {echoes, reach_, plan_.common_shape, tile.unit}, tile.list, tile.first_bin, *tile.grid);
  }

  const GriddingPlan<Real>& plan_;
  PulseReach reach_;
  std::size_t first_, last_;
  double min_range_ = 0, max_range_ = 0;
  std::vector<Tile> tiles_;
};

}  // namespace

template <typename Real>
GriddedImage GriddedSynthesis<Real>::image(const EchoSource& source) const {
  const PulseReach reach = input_for({}).reach;
  const std::size_t slab_bins = slab_tiles * plan_.tile_bins, slabs = (plan_.axis.bins + slab_bins - 1) / slab_bins;
  ComplexGrid pressure(plan_.head.fan.beams(), plan_.axis.bins);
  std::vector<double> gridded(slabs), received(slabs);
  parallel_for(slabs, threads_, [&](std::size_t s) {
    const FlushDenormals flush;
    const std::size_t first = s * slab_bins, last = std::min(first + slab_bins, plan_.axis.bins);
    pressure.middleCols(first, last - first).setZero();
    Slab<Real> slab(plan_, reach, first);
    for (std::size_t c = 0; c < source.chunks.size(); ++c)
      if (slab.reaches(source.chunks[c].min_range, source.chunks[c].max_range))
        source.visit(
            c, [&](const PatchPlace& p) { return slab.reaches(p.range - p.reach, p.range + p.reach); },
            [&](const Scatterers&, const Echoes& echoes) { slab.add(echoes); });
    gridded[s] = slab.finish([&](std::size_t bin, GridTile<Real>& tile, double unit) {
      const std::size_t end = std::min(bin + plan_.tile_bins, plan_.axis.bins);
      form_beams(tile, bin, end, pressure);
      auto bins = pressure.middleCols(bin, end - bin);
      bins *= unit;
      received[s] += bins.abs2().sum();
    });
  });
  const double all = std::accumulate(gridded.begin(), gridded.end(), 0.0) * static_cast<double>(plan_.head.fan.beams());
  const double share = all > 0 ? std::sqrt(std::accumulate(received.begin(), received.end(), 0.0) / all) : 1;
  return {std::move(pressure), share};
}

template GriddedImage GriddedSynthesis<float>::image(const EchoSource&) const;
template GriddedImage GriddedSynthesis<double>::image(const EchoSource&) const;

}  // namespace insonify
