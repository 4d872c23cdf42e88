#pragma once
#include <optional>

#include <Eigen/Core>

#include "view/axes_internal.hpp"
#include "view/fan_layout_internal.hpp"
#include "view/picture.hpp"
#include "viewer/viewer_state.hpp"

namespace insonify {

/// Polar coordinates on a fan picture: bearing [rad], positive to starboard, and range [m].
struct FanPlace {
  double bearing = 0, range = 0;
};
/// Inverse of FanLayout::at; bearings in (-pi, pi].
FanPlace fan_place(const FanLayout& layout, Point2 place);
/// The same place in metres to starboard and forward of the head.
Eigen::Vector2d metres_on_fan(FanPlace place);

/// The sample drawn at a place: the nearest beam in azimuth and the bin; of beams that share a cell the strongest,
/// which is the one drawn. None outside the fan.
std::optional<PixelPlace> pixel_at(const LevelImage& image, FanPlace place);

/// The bin at a place on a chart of levels against range; none outside its frame.
std::optional<std::size_t> bin_at(const LevelImage& image, const Axes& axes, Point2 place);

}  // namespace insonify
