#pragma once
#include <cstddef>

#include "beamforming/ping_synthesizer.hpp"

namespace insonify {

/// What the two ways to make an image cost beyond a silent one, in nanoseconds of one core; only their ratio decides.
/// Constants are fitted to 26 heads and tolerances timed on one machine, good to 30 % there;
/// `insonify_benchmarks --benchmark_filter=few_echoes` times both ways.
struct SynthesisCost {
  double tile;          ///< gridded: to turn one tile of bins into beams
  double gridded_echo;  ///< gridded: one echo
  double direct_fixed;  ///< direct: to steer all beams, and to see how far echoes cancel
  double direct_echo;   ///< direct: one echo in all beams
  double direct_block;  ///< direct: the pattern of all beams towards a block of echoes, full or not

  /// choice: of the gridding synthesis. one_shape: all pulses are alike, and gridded from polynomials.
  SynthesisCost(const SonarHead& head, const SynthesisChoice& choice, std::size_t tile_bins, bool one_shape);

  /// `tiles`: how many of them the echoes touch.
  bool direct_is_cheaper(std::size_t echoes, std::size_t tiles) const;
  /// From so many echoes on gridding is cheaper, if they touch so many tiles.
  double break_even(std::size_t tiles) const;
};

}  // namespace insonify
