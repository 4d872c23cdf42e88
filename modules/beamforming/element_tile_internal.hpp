#pragma once
#include <cstddef>
#include <span>

#include "beamforming/sonar_head.hpp"
#include "core/grid.hpp"

namespace insonify {

constexpr std::size_t tile_bins = 64;

/// The time series of all elements over one tile of bins: tile_bins x elements, real and imaginary parts [Pa].
struct ElementTile {
  Grid<double> re, im;

  explicit ElementTile(std::size_t elements)
      : re(Grid<double>::Zero(tile_bins, elements)), im(Grid<double>::Zero(tile_bins, elements)) {}
};

/// Shading and steering phasors of all beams and elements, to form beams from tiles of element series.
class BeamSums {
 public:
  BeamSums(const SonarHead& head, double wavelength);

  /// Computes pressure(b, n) for the bins [first, last) of one tile: the sum over elements (E10).
  void form_beams(const ElementTile& series, std::size_t first, std::size_t last, ComplexGrid& pressure) const;
  /// Computes the same for a subset of the beams: each row of a planar array has its own element series.
  void form_beams(const ElementTile& series, std::size_t first, std::size_t last, std::span<const std::size_t> beams,
                  ComplexGrid& pressure) const;

 private:
  Grid<double> re_, im_;  // beams x elements
};

}  // namespace insonify
