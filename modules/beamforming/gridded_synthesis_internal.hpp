#pragma once
#include "beamforming/fft_along_rows_internal.hpp"
#include "beamforming/grid_echoes_internal.hpp"
#include "beamforming/gridding_plan_internal.hpp"

namespace insonify {

/// An image, and how much of what was gridded is in it.
struct GriddedImage {
  ComplexGrid pressure;  ///< beams x bins [Pa]
  /// Root of the mean energy of a beam over that of all gridded pulses: 0.1 for a fan of 500 beams of which 5 hear an
  /// echo. The errors of the kernel go into all beams alike; the smaller this is, the more they weigh.
  double share = 0;
};

/// The gridding work of PingSynthesizer in one precision.
template <typename Real>
class GriddedSynthesis {
 public:
  /// kernel_tolerance: error of the kernel relative to what is gridded.
  GriddedSynthesis(const SonarHead& head, const Medium& medium, const SynthesisOptions& options,
                   double kernel_tolerance);
  GriddedImage image(const Echoes& echoes) const;
  const SynthesisChoice& choice() const { return plan_.choice; }
  /// Whether it grids these echoes dearer than they are summed directly.
  bool direct_is_cheaper(const Echoes& echoes) const;

 private:
  using Complex = std::complex<Real>;

  GriddingPing ping_of(const Echoes& echoes) const;
  /// Turns the gridded tile into beams: the bins [first, last) of `pressure`.
  void form_beams(GridTile<Real>& tile, std::size_t first, std::size_t last, ComplexGrid& pressure) const;
  void unfold(GridTile<Real>& tile) const;

  GriddingPlan<Real> plan_;
  int threads_;
  FftAlongRows<Real> to_elements_, to_beams_;
};

}  // namespace insonify
