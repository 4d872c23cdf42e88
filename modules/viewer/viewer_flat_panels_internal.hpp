#pragma once
#include <optional>

#include <Eigen/Core>

#include "view/axes_internal.hpp"
#include "view/fan_layout_internal.hpp"
#include "view/picture.hpp"
#include "viewer/viewer_data.hpp"
#include "viewer/viewer_panel_internal.hpp"
#include "viewer/viewer_state.hpp"

namespace insonify {

/// Levels of one ping, range compensated if `tvg`.
LevelImage levels_of(const ViewerData& data, std::size_t ping, bool tvg);

/// Highest level of the automatic colour scale, common to all pings of a run so that playing does not flicker.
double common_max_db(const ViewerData& data, bool tvg);

/// Draw into emptied panels; fan and chart return their layout. `options` gives size, colours and limits.
FanLayout draw_fan_panel(ViewerPanel& panel, const LevelImage& image, const PictureOptions& options, bool keep_camera);
Axes draw_ascan_panel(ViewerPanel& panel, const LevelImage& image, std::size_t beam, const PictureOptions& options);
/// Draws a waterfall of the beam, or, for a single ping, the levels across the beams at the bin.
void draw_history_panel(ViewerPanel& panel, const ViewerData& data, const LevelImage& image, PixelPlace place, bool tvg,
                        const PictureOptions& options);

/// Marks the selected sample by a ring, its bearing line and range arc, and the measured distance with its length.
void mark_fan(ViewerPanel& panel, const LevelImage& image, const FanLayout& layout, const ViewerState& state,
              const PictureOptions& options);
/// Draws a vertical line at the range of the selected bin.
void mark_ascan(ViewerPanel& panel, const LevelImage& image, const Axes& axes, std::optional<PixelPlace> selected,
                const PictureOptions& options);

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
