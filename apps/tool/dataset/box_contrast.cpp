// SPDX-License-Identifier: BSD-3-Clause
#include "tool/dataset/box_contrast.hpp"

#include <algorithm>
#include <cmath>

#include "tool/dataset/label_pictures.hpp"

namespace insonify::tool {

std::optional<double> contrast_db(const Grid<float>& level_db, const Grid<std::uint16_t>& instance,
                                  const Annotation& object, const FanRaster* fan) {
  constexpr int least_ring = 2;  // pixels
  const int across = std::max(least_ring, object.width), along = std::max(least_ring, object.height);
  const Eigen::Index top = std::max(0, object.top - along), left = std::max(0, object.left - across);
  const Eigen::Index bottom = std::min<Eigen::Index>(level_db.rows(), object.top + object.height + along);
  const Eigen::Index right = std::min<Eigen::Index>(level_db.cols(), object.left + object.width + across);
  double own = 0, ring = 0;
  std::size_t own_pixels = 0, ring_pixels = 0;
  for (Eigen::Index row = top; row < bottom; ++row)
    for (Eigen::Index column = left; column < right; ++column) {
      const std::uint16_t number = instance(row, column);
      const double intensity = std::pow(10, static_cast<double>(level_db(row, column)) / 10);
      if (number == object.instance)
        own += intensity, ++own_pixels;
      else if (number == 0 && (!fan || fan->beam(row, column) >= 0))
        ring += intensity, ++ring_pixels;
    }
  if (own_pixels == 0 || ring_pixels == 0 || !(ring > 0)) return {};
  return 10 * std::log10(own / static_cast<double>(own_pixels) * static_cast<double>(ring_pixels) / ring);  // (E169)
}

FanPixels pixels_above(FanPixels pixels, std::optional<double> min_level) {
  pixels.category = classes_above(pixels.category, pixels.level_db, min_level);
  pixels.instance = (pixels.category == 0).select(std::uint16_t{0}, pixels.instance);
  return pixels;
}

}  // namespace insonify::tool
