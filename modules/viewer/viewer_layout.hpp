// SPDX-License-Identifier: BSD-3-Clause
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

  Box scene_view;  ///< box within `scene` that the scene itself fills
};

/// The panels of a window.
enum class ViewerPanelName { fan, scene, ascan, history, facts, timeline, status };
/// A row of the table of panels.
struct ViewerPanelBox {
  const char* name;  ///< name in scripts
  ViewerPanelName value;
  Box ViewerLayout::*box;
};
inline constexpr ViewerPanelBox viewer_panels[] = {{"fan", ViewerPanelName::fan, &ViewerLayout::fan},
                                                   {"scene", ViewerPanelName::scene, &ViewerLayout::scene},
                                                   {"ascan", ViewerPanelName::ascan, &ViewerLayout::ascan},
                                                   {"history", ViewerPanelName::history, &ViewerLayout::history},
                                                   {"facts", ViewerPanelName::facts, &ViewerLayout::facts},
                                                   {"timeline", ViewerPanelName::timeline, &ViewerLayout::timeline},
                                                   {"status", ViewerPanelName::status, &ViewerLayout::status}};
/// Returns the box of a panel.
inline const Box& box_of(const ViewerLayout& layout, ViewerPanelName name) {
  return layout.*viewer_panels[static_cast<std::size_t>(name)].box;
}

/// Optional panels of a window, in addition to the panels that its mode always has.
struct ViewerPanels {
  bool scene = true, history = true, timeline = false;
  bool scene_key = true;  ///< true: colour bars and legend beside the scene
};

/// Returns the layout of a window of width x height pixels. Throws Error(argument) for a window
/// smaller than 800 x 600 or larger than 8192 pixels in either direction.
ViewerLayout lay_out_viewer(int width, int height, ViewerMode mode, const ViewerPanels& parts);

/// Returns the panel at a position in the window.
std::optional<ViewerPanelName> panel_at(const ViewerLayout& layout, Point2 position);

}  // namespace insonify
