// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/grid.hpp"
#include "formats/label_map.hpp"
#include "returns/fan_areas.hpp"
#include "returns/label_objects.hpp"
#include "returns/picture_grid.hpp"
#include "returns/ping.hpp"

/// Classes of pixels, and their colours in pictures.
namespace insonify::tool {

/// The least share of a pixel's energy that gives its class: the default of data sets, and the share of pictures.
constexpr double least_label_share = 0.5;
/// Values of a class: nothing, shadow, then materials.
constexpr std::uint8_t shadow_class = 1;

/// The names of the classes of labels: nothing, shadow, then the materials.
std::vector<std::string> class_names(const PixelLabels& labels);

/// The class of every sample, beams x bins, numbered as `classes`; nothing where a label has less than `share` (E125).
Grid<std::uint8_t> classes_of(const PixelLabels& labels, double share, const std::vector<std::string>& classes);

/// --min-level: a level [dB], "black" for `black_db`, or nothing of "". Throws Error(argument).
std::optional<double> parse_min_level(const std::string& text, double black_db);
/// The text of --help on --min-level.
inline constexpr const char* min_level_help =
    "[dB] surfaces have no class in pixels below; black: below the darkest grey; default: they have one at any level";

/// The classes with nothing in place of surfaces where the level is below `min_level`, if that is given; shadow stays.
Grid<std::uint8_t> classes_above(const Grid<std::uint8_t>& classes, const Grid<float>& level_db,
                                 std::optional<double> min_level);

/// One row of beams of a ping, from the lowest; all of it if it has one. Layers and other maps than levels and labels
/// are left out.
Ping row_of(const Ping& ping, std::size_t row);
/// How many rows of beams it has.
std::size_t rows_of(const Ping& ping);

/// Value, name and colour of every class, as JSON.
nlohmann::ordered_json palette_json(const std::vector<std::string>& classes);

// Parts of a scene as objects of a data set.

/// A picture of a ping: polar, or by a raster of the fan.
struct PictureOf {
  const Ping& ping;
  const FanRaster* fan = nullptr;  ///< null: polar
};

/// Left, top, width and height [pixels].
using PixelBox = std::array<int, 4>;

/// Three numbers as a JSON array; NaN as null.
nlohmann::ordered_json numbers_json(const Eigen::Vector3d& v);
/// The rows of a pose as JSON arrays.
nlohmann::ordered_json pose_json(const Pose& pose);

/// The box about all that the head would see of a part alone: in a polar picture by its ranges and the beams that hear
/// it, in a fan by the positions where it is drawn. Empty if the head would see nothing; for a fan also if the cube lacks
/// these positions, as those of earlier versions do.
std::optional<PixelBox> whole_box(const PartView& view, const PictureOf& picture);

/// The part of each object of a picture, by the numbers of the objects; objects that are not of a labelled part are not
/// in it.
///
/// instance   numbers of objects, beams x bins
std::map<std::uint16_t, std::size_t> parts_of_objects(const PixelLabels& labels, double least_share,
                                                      const Grid<std::uint16_t>& instance);

/// All labelled parts that the head would see if they were alone, or that have pixels at the edge of the fan: name,
/// class, pose, share that is seen, boxes in both forms, and the number of the object, null where it has no pixels.
nlohmann::ordered_json part_objects_json(const PixelLabels& labels, const std::map<std::uint16_t, std::size_t>& parts,
                                         const PictureOf& polar, const PictureOf& fan);

// Which objects of an image can be seen in it.

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

// Images of pings with labels, as data sets and Python's views have them.

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
