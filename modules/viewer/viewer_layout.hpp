#pragma once
#include <optional>

#include "view/placed_text.hpp"
#include "viewer/viewer_state.hpp"

namespace insonify {

/// Boxes of the panels, in pixels from the lower left corner of the window. Absent panels are empty; the others tile
/// the window.
struct ViewerLayout {
  int font_size = 0;
  Box fan;      ///< the ping in true geometry
  Box scene;    ///< 3-D
  Box ascan;    ///< levels of one beam
  Box history;  ///< waterfall of one beam, or levels across all beams
  Box facts;    ///< explanation, sliders
  Box status;   ///< one line
};

/// Names of the panels in scripts.
enum class ViewerPanelName { fan, scene, ascan, history, facts, status };
/// Returns the box of a panel.
const Box& box_of(const ViewerLayout& layout, ViewerPanelName name);

/// Layout of a window of width x height pixels; `with_scene` adds the 3-D panel. Throws Error(argument) for a window
/// smaller than 800 x 600 or larger than 8192 pixels in either direction.
ViewerLayout lay_out_viewer(int width, int height, ViewerMode mode, bool with_scene);

/// The panel at a place in the window.
std::optional<ViewerPanelName> panel_at(const ViewerLayout& layout, Point2 place);

}  // namespace insonify
