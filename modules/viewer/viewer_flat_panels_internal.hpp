#pragma once
#include "view/axes_internal.hpp"
#include "view/fan_layout_internal.hpp"
#include "viewer/viewer_data.hpp"
#include "viewer/viewer_panel_internal.hpp"

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

}  // namespace insonify
