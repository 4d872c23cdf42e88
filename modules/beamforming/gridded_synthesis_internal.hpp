#pragma once
#include "acoustics/echo_source.hpp"
#include "beamforming/fft_along_rows_internal.hpp"
#include "beamforming/grid_echoes_internal.hpp"
#include "beamforming/gridding_plan_internal.hpp"

namespace insonify {

/// An image, and the fraction of the gridded energy that it contains.
struct GriddedImage {
  ComplexGrid pressure;  ///< beams x bins [Pa]
  /// Root of the mean energy per beam over that of all gridded pulses: 0.1 for a fan of 500 beams of which 5 receive an
  /// echo. Kernel errors are distributed evenly over all beams, so the smaller this fraction, the larger the relative
  /// error.
  double share = 0;
};

/// The gridded synthesis of PingSynthesizer in one precision.
template <typename Real>
class GriddedSynthesis {
 public:
  /// kernel_tolerance   error of the kernel relative to the gridded energy
  GriddedSynthesis(const SonarHead& head, const Medium& medium, const SynthesisOptions& options,
                   double kernel_tolerance);
  GriddedImage image(const Echoes& echoes) const;
  /// The same of echoes that are not stored: each thread forms the beams of one slab of bins after another, and visits
  /// the chunks that reach into it, in order.
  GriddedImage image(const EchoSource& source) const;
  const SynthesisChoice& choice() const { return plan_.choice; }
  /// Returns true if the cost model favours the direct sum over gridding for these echoes.
  bool direct_is_cheaper(const Echoes& echoes) const;
  /// The same for so many echoes of a head at rest in all of the gate.
  bool direct_is_cheaper(std::size_t echoes) const;

 private:
  using Complex = std::complex<Real>;

  GriddingInput input_for(const Echoes& echoes) const;
  /// Transforms the gridded tile into beams: bins [first, last) of `pressure`.
  void form_beams(GridTile<Real>& tile, std::size_t first, std::size_t last, ComplexGrid& pressure) const;
  void wrap_and_transpose(GridTile<Real>& tile) const;

  GriddingPlan<Real> plan_;
  int threads_;
  FftAlongRows<Real> to_elements_, to_beams_;
};

}  // namespace insonify
