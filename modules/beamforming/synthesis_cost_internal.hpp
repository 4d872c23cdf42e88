#pragma once
#include <cstddef>

#include "beamforming/ping_synthesizer.hpp"

namespace insonify {

/// Cost model of the two synthesis methods beyond that of a silent image, in nanoseconds of one core; only the ratio
/// matters. The constants are fitted to 26 heads and tolerances timed on one machine, accurate to 30 % there;
/// `insonify_benchmarks --benchmark_filter=few_echoes` measures both methods.
struct SynthesisCost {
  double tile;          ///< gridded: transform and interpolation of one tile of bins
  double gridded_echo;  ///< gridded: one echo
  double direct_fixed;  ///< direct: steering of all beams, and test for cancellation
  double direct_echo;   ///< direct: one echo in all beams
  double direct_block;  ///< direct: patterns of all beams for one block of echoes, full or not

  /// choice         parameters of the gridded synthesis
  /// common_shape   all pulses have the same shape and are gridded from polynomials
  SynthesisCost(const SonarHead& head, const SynthesisChoice& choice, std::size_t tile_bins, bool common_shape);

  /// tiles   number of tiles that the echoes overlap
  bool direct_is_cheaper(std::size_t echoes, std::size_t tiles) const;
  /// Returns the number of echoes above which gridding is cheaper, if they overlap `tiles` tiles.
  double break_even(std::size_t tiles) const;
};

}  // namespace insonify
