// SPDX-License-Identifier: BSD-3-Clause
#include "returns/pixel_labels.hpp"

namespace insonify {

Grid<std::uint16_t> material_image(const PixelLabels& labels, double least_share) {
  Grid<std::uint16_t> image = labels.material;
  for (Eigen::Index i = 0; i < image.size(); ++i)
    if (image(i) != PixelLabels::shadow && static_cast<double>(labels.share(i)) < least_share)
      image(i) = PixelLabels::nothing;
  return image;
}

Grid<std::uint32_t> id_image(const PixelLabels& labels, double least_share) {
  Grid<std::uint32_t> image = labels.id;
  for (Eigen::Index i = 0; i < image.size(); ++i)
    if (static_cast<double>(labels.share(i)) < least_share) image(i) = PixelLabels::no_id;
  return image;
}

Grid<std::uint16_t> part_image(const PixelLabels& labels, double least_share) {
  Grid<std::uint16_t> image = labels.part;
  for (Eigen::Index i = 0; i < image.size(); ++i)
    if (static_cast<double>(labels.share(i)) < least_share) image(i) = PixelLabels::no_part;
  return image;
}

}  // namespace insonify
