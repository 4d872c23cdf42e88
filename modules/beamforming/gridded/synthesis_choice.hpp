// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>

namespace insonify {

/// Parameters that a GriddedEngine chose for its tolerance.
struct SynthesisChoice {
  bool single_precision = false;  ///< precision of tiles and transforms; delays and phases are always double
  std::size_t kernel_width = 0;   ///< width of the gridding kernel [grid steps]
  std::size_t grid = 0;           ///< length of the grid over direction
  std::size_t pulse_samples = 0;  ///< bins per gridded pulse
  double bytes_per_thread = 0;    ///< working memory beside the image
};

}  // namespace insonify
