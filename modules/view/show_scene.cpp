// SPDX-License-Identifier: BSD-3-Clause
#include "view/show_scene.hpp"

#include <cmath>

#include <vtkNew.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>

#include "view/canvas_internal.hpp"
#include "view/fan_layout_internal.hpp"
#include "view/off_screen_internal.hpp"
#include "view/scene_actors_internal.hpp"

namespace insonify {
namespace {

// The box of the scene, and the colour bars and legend around it.
struct SceneFrame {
  Box scene;
  std::optional<PlacedText> title;
  std::vector<std::pair<ColourBar, ColourScale>> bars;
  std::vector<std::pair<PlacedText, Rgb>> legend;
};

// Adds a legend in centred rows at the bottom of the picture. Returns its top.
double lay_out_legend(SceneFrame& frame, const std::vector<LegendEntry>& entries, double width, int font) {
  const double patch = 1.5 * font, gap = 1.5 * font, room = width - 2.0 * font;
  std::vector<std::vector<std::pair<PlacedText, Rgb>>> rows(1);
  double used = 0;
  for (const LegendEntry& entry : entries) {
    const FittedText fitted = fit_text(entry.text, font, room - patch);
    PlacedText text(fitted.text, {0, 0}, fitted.font_size);
    if (used > 0 && used + gap + patch + text.extent.width > room) rows.emplace_back(), used = 0;
    used += (used > 0 ? gap : 0) + patch + text.extent.width;
    rows.back().emplace_back(text, entry.colour);
  }
  double y = font * (1.5 + 1.7 * static_cast<double>(rows.size() - 1));
  const double top = y + font;
  for (auto& row : rows) {
    double length = gap * static_cast<double>(row.size() - 1);
    for (const auto& [text, colour] : row) length += patch + text.extent.width;
    double x = (width - length) / 2;
    for (auto& [text, colour] : row) {
      text.centre = {x + patch + text.extent.width / 2, y};
      x += patch + text.extent.width + gap;
      frame.legend.emplace_back(text, colour);
    }
    y -= 1.7 * font;
  }
  return top;
}

// Returns a frame with a colour bar at the right, a second one for the soundings below it, and a legend below.
SceneFrame lay_out_frame(const SceneKey& key, const std::optional<SceneKey>& soundings, const PictureOptions& options) {
  const int font = font_size_for(options);
  const double margin = font;
  SceneFrame frame;
  frame.title = put_title(options);
  frame.scene = {0, static_cast<double>(options.width), 0,
                 frame.title ? frame.title->box().bottom - 0.5 * font : static_cast<double>(options.height)};
  const double inset = 0.1 * frame.scene.top;
  const auto add_upright = [&](const SceneKey& bar_key) {
    const ColourBar bar =
        upright_colour_bar(*bar_key.scale, bar_key.unit, font, options.width - margin, inset, frame.scene.top - inset);
    frame.bars.emplace_back(bar, *bar_key.scale);
    frame.scene.right = bar.outer().left - margin;
  };

  if (!key.legend.empty()) frame.scene.bottom = lay_out_legend(frame, key.legend, options.width, font) + 0.5 * font;
  if (key.scale) add_upright(key);
  if (soundings && !key.scale) add_upright(*soundings);
  if (soundings && key.scale) {
    const ColourBar bar =
        lying_colour_bar(*soundings->scale, soundings->unit, font, 0.2 * options.width, 0.7 * options.width, margin);
    frame.bars.emplace_back(bar, *soundings->scale);
    frame.scene.bottom = bar.outer().top + margin;
  }
  frame.scene = {0, std::floor(frame.scene.right), std::ceil(frame.scene.bottom), std::floor(frame.scene.top)};
  return frame;
}

void draw_frame(Canvas& canvas, const SceneFrame& frame, int font) {
  for (const auto& [bar, scale] : frame.bars) canvas.add_colour_bar(bar, scale, line_width_for(font));
  for (const auto& [text, rgb] : frame.legend) {
    const Point2 patch{text.box().left - 0.9 * font, text.centre.y};
    canvas.add_lines({{{patch.x - 0.5 * font, patch.y}, {patch.x + 0.5 * font, patch.y}}}, font, shares_of(rgb), 1);
    canvas.add_text(text);
  }
  if (frame.title) canvas.add_text(*frame.title);
}

constexpr const char* show_scene_name = "show_scene";

std::string scene_png(const SceneCloud& scene, const SceneLook& look, const PictureOptions& options,
                      const VtkMessages& messages) {
  SceneActors actors(scene, look, options, show_scene_name);
  const int font = font_size_for(options);
  const SceneFrame frame = lay_out_frame(actors.key(), actors.soundings_key(), options);

  // Stack the layers from the top: the canvas with its texts, the scene in its own box, an empty background.
  Canvas canvas(options, show_scene_name);
  vtkRenderWindow* window = canvas.renderer()->GetRenderWindow();
  window->SetNumberOfLayers(2);
  canvas.renderer()->SetLayer(1);
  vtkNew<vtkRenderer> background, renderer;
  const Box& part = frame.scene;
  renderer->SetViewport(part.left / options.width, part.bottom / options.height, part.right / options.width,
                        part.top / options.height);
  for (vtkRenderer* each : {background.Get(), renderer.Get()}) {
    each->SetBackground(canvas.colours().background.data());
    window->AddRenderer(each);
  }
  actors.add_to(renderer);
  actors.place_camera(renderer, look.camera);
  const std::vector<AxisLabel> labels = actors.turn_axes(renderer);
  renderer->ResetCameraClippingRange();

  for (const PlacedText& text : place_labels(labels, actors.view(renderer), part, font)) canvas.add_text(text);
  draw_frame(canvas, frame, font);
  return canvas.png(messages);
}

}  // namespace

void show_scene(const SceneCloud& scene, const SceneLook& look, const PictureOptions& options,
                const std::string& png_path) {
  require_picture_size(options, show_scene_name);
  save_drawing(png_path, [&](const VtkMessages& messages) { return scene_png(scene, look, options, messages); });
}

}  // namespace insonify
