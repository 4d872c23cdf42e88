#pragma once
#include <cstdint>

#include "compare/image_similarity.hpp"
#include "compare/speckle_statistics.hpp"

namespace insonify {

/// What a perfect simulator reaches: the similarity of two draws of speckle about the same expected level.
struct TwoSeedFloor {
  ImageSimilarity drawn;     ///< of two draws about the image's own expected level
  ImageSimilarity analytic;  ///< of speckle on an even scene far within the window: pixels is 0 (E124)
};

/// What kinds of images are compared.
struct FloorOptions {
  double looks = 1, other_looks = 1;  ///< of the two images, >= 1
  bool expected = false;              ///< the first one is an expected level, without speckle
  CorrelationWidths width{1, 1};      ///< of the speckle [pixels]
  std::uint64_t seed = 1;
};

/// Draws the floor about an image: its intensity averaged over 5 beams x 7 bins, or the image itself if that is an
/// expected level, times the intensity of complex Gaussian noise of the given correlation widths, averaged over looks. Throws as
/// image_similarity.
TwoSeedFloor two_seed_floor(const Grid<float>& level_db, const GreyWindow& window, const FloorOptions& options);

}  // namespace insonify
