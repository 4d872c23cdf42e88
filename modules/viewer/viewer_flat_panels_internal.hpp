// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <optional>
#include <string>

#include <Eigen/Core>

#include "view/axes_internal.hpp"
#include "view/fan_layout_internal.hpp"
#include "view/line_chart_internal.hpp"
#include "view/picture.hpp"
#include "view/show_image.hpp"
#include "viewer/viewer_data.hpp"
#include "viewer/viewer_panel_internal.hpp"
#include "viewer/viewer_state.hpp"

namespace insonify {

/// Returns the levels of one ping, range compensated if `tvg`. Bearings of a scanning head include its turn.
LevelImage levels_of(const ViewerData& data, std::size_t ping, bool tvg);

/// Returns the highest level of the automatic colour scale, raw and range compensated. It is common to all pings of a
/// run so that playing does not flicker, and estimated from at most 16 of them.
std::array<double, 2> common_max_db(const ViewerData& data);

/// Returns a chart of the levels at the range of a sample, by bearing; for a head with rows of beams, those of its row.
LineChart bearing_chart(const LevelImage& image, PixelPosition position, const PictureOptions& options);

/// Marks on a fan.
struct FanMarks {
  std::optional<double> bearing, range;  ///< [rad] to starboard, [m]: marked by a line; both: also an arc, and a ring
  Measure measure;                       ///< measured distance with its length
};
void mark_fan(ViewerPanel& panel, const FanLayout& layout, const FanMarks& marks, const PictureOptions& options);
/// Marks the row of a ping, and on it the sample at a range [m].
void mark_waterfall(ViewerPanel& panel, const Axes& axes, double row, std::optional<double> range,
                    const PictureOptions& options, bool keep_camera);
/// Draws a vertical line at the range of the selected bin.
void mark_ascan(ViewerPanel& panel, const LevelImage& image, const Axes& axes, std::optional<PixelPosition> selected,
                const PictureOptions& options);

/// Polar coordinates on a fan picture: bearing [rad], positive to starboard, and range [m].
struct FanPosition {
  double bearing = 0, range = 0;
};
/// Inverts FanLayout::at; bearings in (-pi, pi].
FanPosition fan_position(const FanLayout& layout, Point2 position);
/// Returns the position in metres to starboard and forward of the head.
Eigen::Vector2d metres_on_fan(FanPosition position);

/// Returns the sample drawn at a position: the nearest beam in azimuth and the bin; of beams that share a cell the
/// strongest, which is the one drawn. Returns nothing outside the fan.
std::optional<PixelPosition> pixel_at(const LevelImage& image, FanPosition position);

/// Returns the row at a position on a waterfall; nothing outside its frame.
std::optional<std::size_t> row_at(const Axes& axes, Point2 position);

/// Returns the bin at a position on a chart of levels against range; nothing outside its frame.
std::optional<std::size_t> bin_at(const LevelImage& image, const Axes& axes, Point2 position);

}  // namespace insonify
