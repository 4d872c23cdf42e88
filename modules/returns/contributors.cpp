// SPDX-License-Identifier: BSD-3-Clause
#include "returns/contributors.hpp"

#include "core/error.hpp"

namespace insonify {
namespace {

template <typename T>
Grid<T> image_of(const Contributors& c, const std::vector<T>& values) {
  Grid<T> image(static_cast<Eigen::Index>(c.beams), static_cast<Eigen::Index>(c.bins));
  for (std::size_t pixel = 0; pixel < c.beams * c.bins; ++pixel) image.data()[pixel] = values[pixel * c.per_pixel];
  return image;
}

}  // namespace

void require_valid(const Contributors& c, const char* who) {
  if (c.per_pixel < 1 || c.per_pixel > 255)
    fail(ErrorKind::argument, who, ": per_pixel = ", c.per_pixel, ", must be within 1 and 255");
  const std::size_t entries = c.beams * c.bins * c.per_pixel;
  if (!c.surfel_before.empty() && c.surfel_before.size() != entries)
    fail(ErrorKind::argument, who, ": surfel_before has ", c.surfel_before.size(), " entries, must have none or ",
         entries);
  for (const std::size_t size :
       {c.surfel.size(), c.id.size(), c.share.size(), c.elevation.size(), c.material.size(), c.path.size()})
    if (size != entries)
      fail(ErrorKind::argument, who, ": an array of the contributors has ", size, " entries, must have ", c.beams,
           " beams x ", c.bins, " bins x ", c.per_pixel);
}

Grid<std::uint16_t> material_image(const Contributors& contributors) {
  require_valid(contributors, "material_image");
  return image_of(contributors, contributors.material);
}

Grid<std::uint32_t> id_image(const Contributors& contributors) {
  require_valid(contributors, "id_image");
  return image_of(contributors, contributors.id);
}

}  // namespace insonify
