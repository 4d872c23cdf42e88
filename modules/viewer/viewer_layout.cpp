// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/viewer_layout.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include <vtkCamera.h>
#include <vtkNew.h>

#include "core/error.hpp"
#include "viewer/viewer_panel_internal.hpp"

namespace insonify {
namespace {

constexpr int min_width = 800, min_height = 600, largest = 8192;
constexpr double facts_share = 0.19, lower_share = 0.36;
constexpr double key_letters = 12;  // width of the scene's key in letter sizes

}  // namespace

ViewerPanel add_panel(vtkRenderWindow* window) {
  ViewerPanel panel{vtkSmartPointer<vtkRenderer>::New(), vtkSmartPointer<vtkRenderer>::New()};
  panel.marks->SetLayer(1);
  panel.marks->InteractiveOff();
  window->AddRenderer(panel.content);
  window->AddRenderer(panel.marks);
  return panel;
}

void place_panel(ViewerPanel& panel, const Box& box, const int window_size[2]) {
  const bool shown = box.width() > 0 && box.height() > 0;
  panel.content->SetInteractive(shown && panel.content->GetLayer() == 0);  // a hidden panel still covers the window
  for (vtkRenderer* renderer : {panel.content.Get(), panel.marks.Get()}) {
    renderer->SetDraw(shown);
    if (shown)
      renderer->SetViewport(box.left / window_size[0], box.bottom / window_size[1], box.right / window_size[0],
                            box.top / window_size[1]);
  }
}

PictureOptions panel_options(const Box& box, int font_size) {
  PictureOptions options;
  options.width = static_cast<int>(box.width());
  options.height = static_cast<int>(box.height());
  options.font_size = font_size;
  options.dark = true;
  return options;
}

Canvas fresh_canvas(vtkRenderer* renderer, const PictureOptions& options, bool keep_camera) {
  renderer->RemoveAllViewProps();
  vtkNew<vtkCamera> before;
  before->DeepCopy(renderer->GetActiveCamera());
  Canvas canvas(renderer, options, "show_viewer");
  if (keep_camera) renderer->GetActiveCamera()->DeepCopy(before);
  return canvas;
}

void add_text_lines(Canvas& canvas, const std::string& text, const Box& box, int font_size) {
  const double line = 1.45 * font_size;
  double middle = box.top - line / 2;
  std::istringstream lines(text);
  for (std::string words; std::getline(lines, words) && middle - line / 2 >= box.bottom; middle -= line) {
    const std::size_t spaces = words.find_first_not_of(' ');
    if (spaces == words.npos) continue;
    const double indent = 0.5 * font_size * static_cast<double>(spaces);
    canvas.add_text_from({box.left + indent, middle}, words.substr(spaces), font_size, box.width() - indent);
  }
}

ViewerLayout lay_out_viewer(int width, int height, ViewerMode mode, const ViewerPanels& parts) {
  if (width < min_width || height < min_height || width > largest || height > largest)
    fail(ErrorKind::argument, "show_viewer: window of ", width, " x ", height, " pixels, must be ", min_width, " x ",
         min_height, " to ", largest, " either way");
  ViewerLayout layout;
  layout.font_size = std::clamp(static_cast<int>(std::lround(std::sqrt(1.0 * width * height) / 95.0)), 10, 24);
  const double right = width, top = height, status = std::round(2.0 * layout.font_size);
  const double facts = std::round(right - std::max(facts_share * width, 19.0 * layout.font_size));
  layout.status = {0, right, 0, status};
  layout.facts = {facts, right, status, top};
  const auto place_scene = [&](const Box& box) {
    layout.scene = layout.scene_view = box;
    if (parts.scene_key) layout.scene_view.right -= std::round(key_letters * layout.font_size);
  };
  if (mode == ViewerMode::inspect) {
    place_scene({0, facts, status, top});
    return layout;
  }
  const double bottom = parts.timeline ? std::round(status + 2.2 * layout.font_size) : status;
  layout.timeline = {0, facts, status, bottom};
  // Without a history the A-scan takes its space.
  const double half = std::round(facts / 2), lower = std::round(bottom + lower_share * (top - bottom));
  layout.ascan = {0, parts.history ? half : facts, bottom, lower};
  layout.history = {layout.ascan.right, facts, bottom, lower};
  layout.fan = {0, parts.scene ? half : facts, lower, top};
  if (parts.scene) place_scene({half, facts, lower, top});
  return layout;
}

std::optional<ViewerPanelName> panel_at(const ViewerLayout& layout, Point2 position) {
  for (const ViewerPanelBox& panel : viewer_panels)
    if ((layout.*panel.box).holds(position)) return panel.value;
  return {};
}

}  // namespace insonify
