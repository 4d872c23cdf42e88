#include <algorithm>

#include "view/axes_internal.hpp"
#include "view/colour_bar_internal.hpp"

namespace insonify {
namespace {

// Values of the labels: round levels, at least `spacing` pixels apart.
struct LevelTicks {
  double step;
  std::vector<double> at_db;
};
LevelTicks level_ticks(const ColourScale& scale, double length, double spacing) {
  const double span = scale.max_db - scale.min_db;
  const double step = round_step(span * std::min(1.0, spacing / length));
  return {step, multiples(step, scale.min_db, scale.max_db)};
}

double along(const ColourScale& scale, double at_db, double from, double to) {
  return from + (to - from) * (at_db - scale.min_db) / (scale.max_db - scale.min_db);
}

}  // namespace

Box ColourBar::outer() const {
  Box all = bar;
  for (const PlacedText& text : texts) {
    const Box box = text.box();
    all = {std::min(all.left, box.left), std::max(all.right, box.right), std::min(all.bottom, box.bottom),
           std::max(all.top, box.top)};
  }
  return all;
}

ColourBar upright_colour_bar(const ColourScale& scale, const std::string& unit, int font_size, double right,
                             double bottom, double top) {
  const double tick = 0.4 * font_size;
  const LevelTicks ticks = level_ticks(scale, top - bottom, 2.6 * font_size);
  const FittedText title = fit_text(unit, font_size, top - bottom);
  double label_width = 0;
  for (const double db : ticks.at_db)
    label_width = std::max(label_width, text_size(number_text(db, ticks.step), font_size).width);

  // From the right: title, labels, ticks, bar.
  const double title_height = title.text.empty() ? 0 : text_size(title.text, title.font_size).height;
  const double labels_right = right - title_height - (title_height > 0 ? 0.4 * font_size : 0);
  const double bar_right = labels_right - label_width - 1.6 * tick;
  ColourBar placed;
  placed.bar = {bar_right - 1.5 * font_size, bar_right, bottom, top};
  for (const double db : ticks.at_db) {
    const double y = along(scale, db, bottom, top);
    const std::string label = number_text(db, ticks.step);
    placed.ticks.push_back({{bar_right, y}, {bar_right + tick, y}});
    placed.texts.push_back({label, {labels_right - text_size(label, font_size).width / 2, y}, font_size});
  }
  if (!title.text.empty())
    placed.texts.push_back({title.text, {right - title_height / 2, (bottom + top) / 2}, title.font_size, true});
  return placed;
}

ColourBar lying_colour_bar(const ColourScale& scale, const std::string& unit, int font_size, double left, double right,
                           double bottom) {
  const double tick = 0.4 * font_size, line = text_size("0", font_size).height;
  const LevelTicks ticks = level_ticks(scale, right - left, 4.5 * font_size);
  const FittedText title = fit_text(unit, font_size, right - left);

  // From below: title, labels, ticks, bar.
  const double labels_bottom = bottom + (title.text.empty() ? 0 : 1.15 * line);
  const double bar_bottom = labels_bottom + line + 1.4 * tick;
  ColourBar placed;
  placed.bar = {left, right, bar_bottom, bar_bottom + 1.3 * font_size};
  placed.lying = true;
  for (const double db : ticks.at_db) {
    const double x = along(scale, db, left, right);
    placed.ticks.push_back({{x, bar_bottom - tick}, {x, bar_bottom}});
    placed.texts.push_back({number_text(db, ticks.step), {x, labels_bottom + line / 2}, font_size});
  }
  if (!title.text.empty())
    placed.texts.push_back({title.text, {(left + right) / 2, bottom + line / 2}, title.font_size});
  return placed;
}

}  // namespace insonify
