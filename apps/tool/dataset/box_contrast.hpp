// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <optional>

#include "core/grid.hpp"
#include "formats/label_map.hpp"
#include "returns/fan_areas.hpp"

/// Which objects of an image can be seen in it.
namespace insonify::tool {

/// Returns the contrast of an object of a picture [dB] (E169): level of the mean intensity of its pixels over that of
/// the ring around it, noise included. The ring reaches the width of the object's box to either side, its height above
/// and below, at least two pixels. Pixels of other objects and beside the fan are no part of it. None if no pixel is
/// left.
///
/// instance   number of the object of each pixel
/// fan        of a fan picture its raster, else null
std::optional<double> contrast_db(const Grid<float>& level_db, const Grid<std::uint16_t>& instance,
                                  const Annotation& object, const FanRaster* fan);

/// Returns the pixels with nothing in place of surfaces whose pixel is below `min_level` [dB], if that is given; shadow
/// stays.
FanPixels pixels_above(FanPixels pixels, std::optional<double> min_level);

}  // namespace insonify::tool
