#include "viewer/viewer_layout.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"

namespace insonify {
namespace {

constexpr int min_width = 800, min_height = 600, largest = 8192;
constexpr double facts_share = 0.19, lower_share = 0.36;
constexpr ViewerPanelName all_panels[] = {ViewerPanelName::fan,     ViewerPanelName::scene, ViewerPanelName::ascan,
                                          ViewerPanelName::history, ViewerPanelName::facts, ViewerPanelName::status};

}  // namespace

const Box& box_of(const ViewerLayout& layout, ViewerPanelName name) {
  switch (name) {
    case ViewerPanelName::fan:
      return layout.fan;
    case ViewerPanelName::scene:
      return layout.scene;
    case ViewerPanelName::ascan:
      return layout.ascan;
    case ViewerPanelName::history:
      return layout.history;
    case ViewerPanelName::facts:
      return layout.facts;
    case ViewerPanelName::status:
      break;
  }
  return layout.status;
}

ViewerLayout lay_out_viewer(int width, int height, ViewerMode mode, bool with_scene) {
  if (width < min_width || height < min_height || width > largest || height > largest)
    fail(ErrorKind::argument, "show_viewer: window of ", width, " x ", height, " pixels, must be ", min_width, " x ",
         min_height, " to ", largest, " either way");
  ViewerLayout layout;
  layout.font_size = std::clamp(static_cast<int>(std::lround(std::sqrt(1.0 * width * height) / 95.0)), 10, 24);
  const double right = width, top = height, status = std::round(2.0 * layout.font_size);
  const double facts = std::round(right - std::max(facts_share * width, 19.0 * layout.font_size));
  layout.status = {0, right, 0, status};
  layout.facts = {facts, right, status, top};
  if (mode == ViewerMode::inspect) {
    layout.scene = {0, facts, status, top};
    return layout;
  }
  const double half = std::round(facts / 2), lower = std::round(status + lower_share * (top - status));
  layout.ascan = {0, half, status, lower};
  layout.history = {half, facts, status, lower};
  layout.fan = {0, with_scene ? half : facts, lower, top};
  if (with_scene) layout.scene = {half, facts, lower, top};
  return layout;
}

std::optional<ViewerPanelName> panel_at(const ViewerLayout& layout, Point2 place) {
  for (const ViewerPanelName name : all_panels) {
    const Box& box = box_of(layout, name);
    if (place.x >= box.left && place.x < box.right && place.y >= box.bottom && place.y < box.top) return name;
  }
  return {};
}

}  // namespace insonify
