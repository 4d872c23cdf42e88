#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "sampling/sampled_cells.hpp"
#include "sonar/range_gate.hpp"

namespace insonify {

/// What is heard of a surfel, and where: its range [m] and place u = cos(elevation) sin(azimuth), and how far it reaches
/// from there.
struct HeardSurfel {
  double energy, range, half_depth, u, half_u;
  std::uint8_t beyond;  ///< bits of SamplingOptions::inner_sector: 1 beyond its cones, 2 beyond its elevations
};

/// The energy that is received from each cell of range and of u (E127). A cell of u is a main lobe wide; for one beam,
/// which adds up what it hears from all directions, it is all of u.
class HeardShares {
 public:
  /// Adds up the energies of surfels, each in equal parts over the cells that it spans, or
  /// that of its middle if it is smaller than a cell: in their order and in a fixed
  /// number of sums, so that the result depends neither on threads nor on sorting.
  HeardShares(std::span<const HeardSurfel> surfels, const RangeGate& gate, const SampledCells& cells, int threads);

  /// Returns the sum of a surfel's shares of the cells that it spans, of what is heard there from surfels that are beyond
  /// the inner sector in no other way than it is, in cells one range resolution long and
  /// cells.width_of_shares() wide; without bound if it spans more than 256.
  double share(const HeardSurfel& surfel) const;

 private:
  using Span = std::pair<std::size_t, std::size_t>;  // first and last
  struct Cells {
    Span range, u;
    std::size_t number() const { return (range.second - range.first + 1) * (u.second - u.first + 1); }
  };
  Cells spanned(const HeardSurfel& surfel) const;
  void add(const HeardSurfel& surfel, std::vector<double>& energy) const;
  std::vector<double> sum_of(std::span<const HeardSurfel> surfels, std::uint8_t beyond, int threads) const;

  double start_, width_, length_;  // of the gate, of a cell
  double size_;                    // of a cell, in range resolutions and widths of shares
  std::size_t places_, ranges_;    // numbers of cells
  // By HeardSurfel::beyond, ranges of one u after those of the u before; empty if there is none.
  std::array<std::vector<double>, 4> energy_;
};

}  // namespace insonify
