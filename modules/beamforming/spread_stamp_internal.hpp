#pragma once
#include <complex>
#include <cstdint>
#include <span>
#include <vector>

#include "acoustics/echoes.hpp"
#include "beamforming/fft_along_rows_internal.hpp"
#include "beamforming/spread_plan_internal.hpp"

namespace insonify {

/// The room of one tile of bins: planes for stamping (a margin of rows to either side takes what belongs to
/// neighbours) and the grid that the transforms work on.
template <typename Real>
struct SpreadTile {
  AlignedArray<Real, Real> re, im;
  AlignedArray<std::complex<Real>, Real> grid;
  std::vector<Real> scratch, whole_re, whole_im;  ///< whole: what was stamped before
  std::vector<double> pulse_re, pulse_im;

  explicit SpreadTile(const SpreadPlan<Real>& plan);

  /// Puts aside what was stamped so far, so that no sum has too many terms of like sign for its precision.
  void put_aside();
  void take_back();

 private:
  std::size_t plane_;
};

/// Which echoes, and how their pulses look: the same for all tiles of one ping.
struct StampedPing {
  const Echoes& echoes;
  PulseReach reach;
  bool planned;     ///< every echo has the planned pulse, times a factor
  double unit = 1;  ///< what is stamped is counted in this [Pa]
};

/// Stamps the listed echoes (E13), in their order, on the tile that begins with first_bin; returns their energy, counted in
/// units of ping.unit^2 [bins].
template <typename Real>
double stamp_echoes(const SpreadPlan<Real>& plan, const StampedPing& ping, std::span<const std::uint32_t> list,
                    std::size_t first_bin, SpreadTile<Real>& tile);

}  // namespace insonify
