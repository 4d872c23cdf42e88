// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/grid.hpp"
#include "sonar/beam_fan.hpp"
#include "sonar/range_gate.hpp"

namespace insonify {

/// Returns the beams from port to starboard: the columns of a picture. Beams of equal azimuth stay in order.
std::vector<Eigen::Index> columns_from_port(const BeamFan& fan);

/// Returns the samples (beams x bins) as a picture in the layout of show_grey: one column per beam from port to
/// starboard, the farthest bin in the first row.
template <typename Value>
Grid<Value> polar_picture(const Grid<Value>& samples, const BeamFan& fan) {
  const std::vector<Eigen::Index> columns = columns_from_port(fan);
  Grid<Value> picture(samples.cols(), samples.rows());
  for (Eigen::Index n = 0; n < samples.cols(); ++n)
    for (std::size_t k = 0; k < columns.size(); ++k)
      picture(samples.cols() - 1 - n, static_cast<Eigen::Index>(k)) = samples(columns[k], n);
  return picture;
}

/// The sample at the centre of each pixel of a picture in true geometry, forward up, starboard right. fan_pixels adds
/// the areas of all samples in a pixel.
struct FanRaster {
  Grid<std::int32_t> beam, bin;  ///< rows from the top; -1 outside the fan
  double metres_per_pixel = 0;
  double margin = 0;                     ///< extent of the outermost beams beyond their axes [rad]
  double head_column = 0, head_row = 0;  ///< position of the head [pixels], from the corner of the first pixel
};

/// Returns the sample nearest to the centre of each pixel, for a picture of `columns` columns that holds the fan; the
/// number of rows follows. Throws Error(argument) for a fan of several elevations, a fan that looks astern, or columns
/// outside 16 to 8192.
FanRaster fan_raster(const BeamFan& fan, const RangeGate& gate, int columns);

/// Returns the raster of a picture of `rows` rows that reaches from the head to the far end of the gate. The head is
/// below the middle of the last row. The outermost beams extend half a beam width beyond their axes. Throws
/// Error(argument) for a fan of several elevations, or without rows.
FanRaster fan_raster_from_head(const BeamFan& fan, const RangeGate& gate, int rows);

}  // namespace insonify
