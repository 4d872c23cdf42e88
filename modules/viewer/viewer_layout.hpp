#pragma once
#include <optional>
#include <vector>

#include "view/placed_text.hpp"
#include "viewer/viewer_state.hpp"

namespace insonify {

/// Which part of the viewer's window shows what, in pixels from its lower left corner. Panels that are not there are
/// empty; the others tile the window.
struct ViewerLayout {
  int font_size = 0;
  Box fan;      ///< the ping in true geometry
  Box scene;    ///< 3-D
  Box ascan;    ///< levels of one beam
  Box history;  ///< waterfall of one beam, or levels across all beams
  Box facts;    ///< explanation, sliders
  Box status;   ///< one line
};

/// Names of the panels, as scripts call them.
enum class ViewerPanelName { fan, scene, ascan, history, facts, status };
const Box& box_of(const ViewerLayout& layout, ViewerPanelName name);

/// Lays out a window of so many pixels; `with_scene`: there is something to show in 3-D. Throws Error(argument) for a
/// window smaller than 800 x 600 or larger than 8192 either way.
ViewerLayout lay_out_viewer(int width, int height, ViewerMode mode, bool with_scene);

/// The panel at a place in the window.
std::optional<ViewerPanelName> panel_at(const ViewerLayout& layout, Point2 place);

}  // namespace insonify
