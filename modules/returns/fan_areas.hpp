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
  Grid<float> level_db;         ///< of the mean intensity; silence_db beside the fan
  Grid<std::uint8_t> category;  ///< 0 beside the fan, as the instance
  Grid<std::uint16_t> instance;
};

/// Returns what the area of each pixel of a raster holds of the samples (E168).
///
/// A sample is the area between two ranges and two bearings: its bin, and half the way to the bearings of the next
/// beams. Every sample counts by the area that it shares with the square of the pixel: along rays a quarter of a pixel
/// apart at the far end, or less, which each stand for a slice of a beam. Along a ray shares are exact, so that all of
/// each sample is in the picture. The level is that of the mean intensity over
/// the area. The class is the one that most of the energy comes from, the object the one that most of the energy of
/// this class comes from; area decides where no energy is. Throws Error(argument) if the samples differ in size from
/// fan and gate, Error(content) for a level that is not a number.
FanPixels fan_pixels(const FanSamples& samples, const BeamFan& fan, const RangeGate& gate, const FanRaster& raster,
                     int threads = 0);

/// Returns the levels of that alone [dB], and minus infinity beside the fan. Throws as fan_pixels.
Grid<float> fan_levels(const Grid<float>& level_db, const BeamFan& fan, const RangeGate& gate, const FanRaster& raster,
                       int threads = 0);

}  // namespace insonify
