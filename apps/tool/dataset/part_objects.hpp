// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <cstdint>
#include <map>
#include <optional>

#include <nlohmann/json.hpp>

#include "core/grid.hpp"
#include "returns/picture_grid.hpp"
#include "returns/ping.hpp"

/// Parts of a scene as objects of a data set.
namespace insonify::tool {

/// A picture of a ping: polar, or by a raster of the fan.
struct PictureOf {
  const Ping& ping;
  const FanRaster* fan = nullptr;  ///< null: polar
};

/// Left, top, width and height [pixels].
using PixelBox = std::array<int, 4>;

/// Three numbers as a JSON array; NaN as null.
nlohmann::ordered_json numbers_json(const Eigen::Vector3d& v);

/// The box about all that the head would see of a part alone: in a polar picture by its ranges and the beams that hear
/// it, in a fan by the positions where it is drawn. Empty if the head would see nothing; for a fan also if the cube is of
/// an earlier version, which lacks these positions.
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

}  // namespace insonify::tool
