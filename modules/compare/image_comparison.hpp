// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "compare/image_shift.hpp"
#include "compare/image_similarity.hpp"
#include "compare/level_statistics.hpp"
#include "compare/resample_image.hpp"
#include "compare/speckle_statistics.hpp"
#include "compare/two_seed_floor.hpp"

namespace insonify {

/// Options of compare_level_images.
struct ComparisonOptions {
  std::optional<GreyWindow>
      window{};            ///< declared span; nothing: 60 dB below the 99.9 % quantile of B, in multiples of 5
  std::uint64_t seed = 1;  ///< seed of the drawn floor
};

/// Similarity after a correction of image A.
struct FittedSimilarity {
  std::string fitted;  ///< nothing | gain | gain and TVG | gain, TVG and map
  ImageSimilarity similarity;
};

/// Statistics of one image.
struct ImageCharacter {
  SpeckleStatistics speckle;
  KolmogorovSmirnov exponential;  ///< test of intensities, one for each resolution cell, against speckle of one look
  double shadow_contrast_db = 0;
  double mean_level_db = 0;  ///< level of the mean intensity
  double clipped = 0;        ///< fraction of pixels at the ends of the scale, or silent
};

/// Differences of image A from image B. Pixels that are not measured or are clipped in one of them are left out. Only
/// the similarity keeps clipped ones, at the ends of the window.
struct ImageComparison {
  GreyWindow window;
  std::size_t pixels = 0;
  double bias_db = 0, deviation_db = 0;  ///< mean and deviation of A - B, pixel by pixel
  double power_bias_db = 0;              ///< difference of the mean intensities of these pixels
  double wasserstein_db = 0;             ///< Wasserstein distance of the levels
  double wasserstein_after_gain_db = 0;  ///< the same after their means are made equal
  double tvg_slope_db = 0;               ///< slope of A - B per decade of range; NaN without ranges
  KolmogorovSmirnov samples;             ///< test of intensities over their local means, one for each resolution cell
  LevelMap map;                          ///< map from A, after the line of gain and TVG, to B
  double map_slope = 0;                  ///< slope of the map between its quartiles: dB of B per dB of A
  std::vector<FittedSimilarity> similarity;
  TwoSeedFloor floor;
  ImageShift shift;
  ImageCharacter a, b;
};

/// Returns the levels of an image, NaN where the image is silent or at an end of its scale.
Grid<float> unclipped_levels(const ComparedImage& image);

/// Compares images of the same size, pixel by pixel (E120 to E124). Throws Error(argument) if sizes differ,
/// Error(content) if no pixel has a level in both.
ImageComparison compare_level_images(const ComparedImage& a, const ComparedImage& b,
                                     const ComparisonOptions& options = {});

}  // namespace insonify
