#pragma once
#include <optional>

#include "view/placed_text.hpp"
#include "viewer/viewer_state.hpp"

namespace insonify {

/// Boxes of the panels, in pixels from the lower left corner of the window. Absent panels are empty; the others tile
/// the window.
struct ViewerLayout {
  int font_size = 0;
  Box fan;       ///< the ping in true geometry, the sweep, or the waterfall of a head of one beam
  Box scene;     ///< 3-D, with its key
  Box ascan;     ///< levels of one beam
  Box history;   ///< waterfall of one beam, or levels across all beams
  Box facts;     ///< explanation, keys, sliders
  Box timeline;  ///< slider of the pings
  Box status;    ///< one line

  Box scene_view;  ///< the part of `scene` that the scene itself fills
};

/// Names of the panels in scripts.
enum class ViewerPanelName { fan, scene, ascan, history, facts, timeline, status };
/// Returns the box of a panel.
const Box& box_of(const ViewerLayout& layout, ViewerPanelName name);

/// Which panels a window has, besides those that every one of its mode has.
struct ViewerParts {
  bool scene = true, history = true, timeline = false;
  bool scene_key = true;  ///< colour bars and legend beside the scene
};

/// Layout of a window of width x height pixels. Throws Error(argument) for a window
/// smaller than 800 x 600 or larger than 8192 pixels in either direction.
ViewerLayout lay_out_viewer(int width, int height, ViewerMode mode, const ViewerParts& parts);

/// The panel at a place in the window.
std::optional<ViewerPanelName> panel_at(const ViewerLayout& layout, Point2 place);

}  // namespace insonify
