#pragma once
#include <complex>
#include <cstdint>
#include <span>
#include <vector>

#include "acoustics/echoes.hpp"
#include "beamforming/fft_along_rows_internal.hpp"
#include "beamforming/gridding_plan_internal.hpp"

namespace insonify {

/// The room of one tile of bins: planes for gridding (a margin of rows to either side takes what belongs to
/// neighbours) and the grid that the transforms work on.
template <typename Real>
struct GridTile {
  AlignedArray<Real, Real> re, im;
  AlignedArray<std::complex<Real>, Real> grid;
  std::vector<Real> scratch, whole_re, whole_im;  ///< whole: what was gridded before
  std::vector<double> pulse_re, pulse_im;

  explicit GridTile(const GriddingPlan<Real>& plan);

  /// Puts aside what was gridded so far, so that no sum has too many terms of like sign for its precision.
  void put_aside();
  void take_back();

 private:
  std::size_t plane_;
};

/// Which echoes, and how their pulses look: the same for all tiles of one ping.
struct GriddingPing {
  const Echoes& echoes;
  PulseReach reach;
  bool planned;     ///< every echo has the planned pulse, times a factor
  double unit = 1;  ///< what is gridded is counted in this [Pa]
};

/// GridPlaces the listed echoes (E13), in their order, on the tile that begins with first_bin; returns their energy, counted in
/// units of ping.unit^2 [bins].
template <typename Real>
double grid_echoes(const GriddingPlan<Real>& plan, const GriddingPing& ping, std::span<const std::uint32_t> list,
                   std::size_t first_bin, GridTile<Real>& tile);

}  // namespace insonify
