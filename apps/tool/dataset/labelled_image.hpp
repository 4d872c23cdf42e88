// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "formats/label_map.hpp"
#include "returns/label_objects.hpp"
#include "returns/picture_grid.hpp"
#include "returns/ping.hpp"

/// Images of pings with labels, as data sets and Python's views have them.
namespace insonify::tool {

/// Rules by which surfaces become classes and objects of an image.
struct ImageRules {
  double share;                     ///< least share of a pixel's energy that gives its class
  std::set<std::uint8_t> stuff;     ///< classes that have no objects
  std::size_t least_pixels;         ///< least number of pixels of an object
  std::optional<double> min_level;  ///< [dB] surfaces have no class in pixels below; empty: at any level
};

/// Objects of a ping, in all its images.
struct ObjectsOf {
  std::map<std::uint16_t, std::size_t> parts;       ///< parts by object, of a scene of parts
  std::uint32_t most_given = 0;                     ///< objects of larger numbers are connected pixels
  std::map<std::uint16_t, std::uint8_t> classes{};  ///< classes by object, that of most pixels of the polar image
};

/// Samples of a ping, beams x bins each, and its objects.
struct LabelledSamples {
  Grid<float> level_db;
  Grid<std::uint8_t> category;
  Grid<std::uint16_t> instance;
  ObjectsOf objects;
};

/// An image with the class and object of every pixel.
struct LabelledImage {
  Grid<float> level_db;
  LabelMap map;
};

/// Returns the classes and objects of the samples of a ping of one row of beams, whose levels are `level_db`. Throws
/// Error(content) for an object with a number above 65535.
LabelledSamples labelled_samples(const Ping& ping, Grid<float> level_db, const SceneInstances& instances,
                                 const std::vector<std::string>& classes, const ImageRules& rules);

/// Returns the image with a column for each beam, the farthest samples in the first row.
LabelledImage polar_image(const LabelledSamples& samples, const BeamFan& fan);

/// Returns the image in true geometry (E168), in which the rule of min_level holds for the pixels, too.
LabelledImage fan_image(const LabelledSamples& samples, const Ping& ping, const FanRaster& raster,
                        const ImageRules& rules);

}  // namespace insonify::tool
