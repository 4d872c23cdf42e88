#pragma once
#include <cstddef>
#include <span>

#include "beamforming/sonar_head.hpp"
#include "core/grid.hpp"

namespace insonify {

constexpr std::size_t tile_bins = 64;

/// The time series of every element over one tile of bins: tile_bins x elements, in two planes [Pa].
struct ElementTile {
  Grid<double> re, im;

  explicit ElementTile(std::size_t elements)
      : re(Grid<double>::Zero(tile_bins, elements)), im(Grid<double>::Zero(tile_bins, elements)) {}
};

/// Shading and steering phase of every beam and element, ready to turn tiles of element series into beams.
class BeamSums {
 public:
  BeamSums(const SonarHead& head, double wavelength);

  /// pressure(b, n) for the bins [first, last) of one tile: the sum over elements (E10).
  void form_beams(const ElementTile& series, std::size_t first, std::size_t last, ComplexGrid& pressure) const;
  /// The same for some of the beams: rows of a planar array hear other series than their neighbours.
  void form_beams(const ElementTile& series, std::size_t first, std::size_t last, std::span<const std::size_t> beams,
                  ComplexGrid& pressure) const;

 private:
  Grid<double> re_, im_;  // beams x elements
};

}  // namespace insonify
