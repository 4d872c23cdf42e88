#pragma once
#include "beamforming/fft_along_rows_internal.hpp"
#include "beamforming/spread_plan_internal.hpp"
#include "beamforming/spread_stamp_internal.hpp"

namespace insonify {

/// An image, and how much of what was stamped is in it.
struct SpreadImage {
  ComplexGrid pressure;  ///< beams x bins [Pa]
  /// Root of the mean energy of a beam over that of all stamped pulses: 0.1 for a fan of 500 beams of which 5 hear an
  /// echo. The errors of the kernel go into all beams alike; the smaller this is, the more they weigh.
  double share = 0;
};

/// The stamping work of PingSynthesizer in one precision.
template <typename Real>
class SpreadSynthesis {
 public:
  /// kernel_tolerance: error of the kernel relative to what is stamped.
  SpreadSynthesis(const SonarHead& head, const Medium& medium, const SynthesisOptions& options,
                  double kernel_tolerance);
  SpreadImage image(const Echoes& echoes) const;
  const SynthesisChoice& choice() const { return plan_.choice; }
  /// Whether it stamps these echoes dearer than they are summed directly.
  bool direct_is_cheaper(const Echoes& echoes) const;

 private:
  using Complex = std::complex<Real>;

  StampedPing ping_of(const Echoes& echoes) const;
  /// Turns the stamped tile into beams: the bins [first, last) of `pressure`.
  void form_beams(SpreadTile<Real>& tile, std::size_t first, std::size_t last, ComplexGrid& pressure) const;
  void unfold(SpreadTile<Real>& tile) const;

  SpreadPlan<Real> plan_;
  int threads_;
  FftAlongRows<Real> to_elements_, to_beams_;
};

}  // namespace insonify
