#pragma once
#include "view/axes_internal.hpp"
#include "view/fan_layout_internal.hpp"
#include "viewer/viewer_data.hpp"
#include "viewer/viewer_panel_internal.hpp"

namespace insonify {

/// Levels of one ping as the state wants them.
LevelImage levels_of(const ViewerData& data, std::size_t ping, bool tvg);

/// Highest level of the automatic colour scale over the pings of a run: one for all, so that playing does not flicker.
double common_max_db(const ViewerData& data, bool tvg);

/// Draw into emptied panels; fan and chart give back where they lie. `options` carry size, colours and limits.
FanLayout draw_fan_panel(ViewerPanel& panel, const LevelImage& image, const PictureOptions& options, bool keep_camera);
Axes draw_ascan_panel(ViewerPanel& panel, const LevelImage& image, std::size_t beam, const PictureOptions& options);
/// Several pings: waterfall of the beam. One: levels across the beams at the bin.
void draw_history_panel(ViewerPanel& panel, const ViewerData& data, const LevelImage& image, PixelPlace place, bool tvg,
                        const PictureOptions& options);

/// What is selected: a ring on the fan with its bearing and its arc of equal range; the measure with its length.
void mark_fan(ViewerPanel& panel, const LevelImage& image, const FanLayout& layout, const ViewerState& state,
              const PictureOptions& options);
/// An upright line at the range of the bin.
void mark_ascan(ViewerPanel& panel, const LevelImage& image, const Axes& axes, std::optional<PixelPlace> selected,
                const PictureOptions& options);

}  // namespace insonify
