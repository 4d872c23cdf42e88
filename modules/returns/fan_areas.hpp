// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>

#include "core/grid.hpp"
#include "returns/picture_grid.hpp"
#include "sonar/beam_fan.hpp"
#include "sonar/range_gate.hpp"

namespace insonify {

/// Samples of a ping, beams x bins each.
struct FanSamples {
  const Grid<float>& level_db;
  const Grid<std::uint8_t>& category;   ///< class; 0: nothing
  const Grid<std::uint16_t>& instance;  ///< number of the object; 0: none
};

/// Pixels of a picture in true geometry, rows from the top.
struct FanPixels {
  Grid<float> level_db;         ///< level of the mean intensity; silence_db beside the fan
  Grid<std::uint8_t> category;  ///< 0 beside the fan, like the instance
  Grid<std::uint16_t> instance;
};

/// Returns level, class and object of the area of each pixel of a raster (E168).
///
/// A sample is the area between two ranges and two bearings: its bin, and half the way to the bearings of the next
/// beams. Every sample counts by the area that it shares with the square of the pixel. The areas are slices of beams,
/// at most a quarter of a pixel wide at the far end; along each slice they are exact, so that the picture contains all
/// of each sample. The level is that of the mean intensity over the area. The class is the one with most of the energy,
/// the object the one with most of that class's energy; area decides where there is no energy. Throws Error(argument)
/// if the samples differ in size from fan and gate, Error(content) for a level that is not a number.
FanPixels fan_pixels(const FanSamples& samples, const BeamFan& fan, const RangeGate& gate, const FanRaster& raster,
                     int threads = 0);

/// Returns only the levels of fan_pixels [dB], minus infinity beside the fan. Throws as fan_pixels.
Grid<float> fan_levels(const Grid<float>& level_db, const BeamFan& fan, const RangeGate& gate, const FanRaster& raster,
                       int threads = 0);

}  // namespace insonify
