// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>

#include "compare/image_similarity.hpp"
#include "compare/speckle_statistics.hpp"

namespace insonify {

/// Similarity of two draws of speckle about one expected level, which a perfect simulator reaches.
struct TwoSeedFloor {
  ImageSimilarity drawn;     ///< similarity of two draws about the image's own expected level
  ImageSimilarity analytic;  ///< the same for an even scene far within the window: pixels is 0 (E124)
};

/// Kinds of the compared images.
struct FloorOptions {
  double looks = 1, other_looks = 1;  ///< looks of the two images, >= 1
  bool expected = false;              ///< true: the first image is an expected level, without speckle
  CorrelationWidths width{1, 1};      ///< correlation widths of the speckle [pixels]
  std::uint64_t seed = 1;
};

/// Draws the floor about an image. Expected level: the image itself if it is one; else the mean of its levels [dB]
/// along range, over 9 bins or four correlation widths, less the bias of its looks, which keeps edges across the beams
/// and slopes along range. The errors of the mean, speckle that it leaves and detail that it removes, are measured on a
/// draw, whose expected level is known: floor = 2 x floor of the image - floor of its draw (E124). The floor is within
/// 0.5 dB and 0.05 of the similarity of two seeds. Each draw is the expected level times the intensity of complex
/// Gaussian noise of the given widths, averaged over looks. Throws as image_similarity.
///
/// level_db   NaN: not measured
/// clipped    true where a level is at an end of its scale or silent: it is the same in both draws; or empty
TwoSeedFloor two_seed_floor(const Grid<float>& level_db, const GreyWindow& window, const FloorOptions& options,
                            const Grid<bool>& clipped = {});

}  // namespace insonify
