#include "view/show_ascan.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <vtkAxis.h>
#include <vtkChartXY.h>
#include <vtkContextActor.h>
#include <vtkContextScene.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPen.h>
#include <vtkPlot.h>
#include <vtkTable.h>

#include "core/error.hpp"
#include "core/units.hpp"
#include "view/axes.hpp"
#include "view/canvas_internal.hpp"
#include "view/fan_layout.hpp"
#include "view/ticks.hpp"
#include "view/vtk_messages_internal.hpp"

namespace insonify {
namespace {

// Limits of the level axis; automatic ones end above the highest level of the beam.
ColourScale level_limits(const Grid<float>& level_db, PictureOptions options, const char* who) {
  double highest = -std::numeric_limits<double>::infinity();
  for (const float level : level_db.reshaped())
    if (std::isfinite(level)) highest = std::max(highest, static_cast<double>(level));
  if (std::isnan(options.max_db) && std::isfinite(highest)) {
    options.max_db = 5.0 * std::floor(highest / 5.0) + 5.0;
    if (options.max_db <= options.min_db) options.max_db = options.min_db + 5.0;
  }
  return colour_scale(level_db, options, who);
}

vtkNew<vtkTable> level_table(const Grid<float>& level_db, const RangeGate& gate, double below_all_db) {
  vtkNew<vtkFloatArray> range, level;
  range->SetName("range");
  level->SetName("level");
  range->SetNumberOfTuples(level_db.cols());
  level->SetNumberOfTuples(level_db.cols());
  for (Eigen::Index bin = 0; bin < level_db.cols(); ++bin) {
    const float db = level_db(0, bin);
    range->SetValue(bin, static_cast<float>(gate.centre(static_cast<std::size_t>(bin))));
    level->SetValue(bin, std::isfinite(db) ? db : static_cast<float>(below_all_db));
  }
  vtkNew<vtkTable> table;
  table->AddColumn(range);
  table->AddColumn(level);
  return table;
}

// The chart shows only the line; frame, labels and titles are ours, as in the other pictures.
void add_line(Canvas& canvas, const Axes& axes, vtkTable* table, const Colour& colour, double width) {
  vtkNew<vtkChartXY> chart;
  const Box& frame = axes.frame;
  chart->SetAutoSize(false);
  chart->SetLayoutStrategy(vtkChart::AXES_TO_RECT);
  chart->SetSize(vtkRectf(static_cast<float>(frame.left), static_cast<float>(frame.bottom),
                          static_cast<float>(frame.width()), static_cast<float>(frame.height())));
  const auto hide = [&](int which, double low, double high) {
    vtkAxis* axis = chart->GetAxis(which);
    axis->SetBehavior(vtkAxis::FIXED);
    axis->SetRange(low, high);
    axis->SetTitle("");
    axis->SetLabelsVisible(false);
    axis->SetTicksVisible(false);
    axis->SetGridVisible(false);
    axis->SetAxisVisible(false);
  };
  hide(vtkAxis::BOTTOM, axes.low_x, axes.high_x);
  hide(vtkAxis::LEFT, axes.low_y, axes.high_y);

  vtkPlot* line = chart->AddPlot(vtkChart::LINE);
  line->SetInputData(table, 0, 1);
  line->GetPen()->SetColorF(colour[0], colour[1], colour[2]);
  line->GetPen()->SetWidth(static_cast<float>(width));
  vtkNew<vtkContextActor> actor;
  actor->GetScene()->AddItem(chart);
  actor->GetScene()->SetRenderer(canvas.renderer());
  canvas.renderer()->AddActor(actor);
}

// Beam and bearing come first: of a long title, the end is cut.
std::string chart_title(const LevelImage& image, std::size_t beam, const std::string& title) {
  std::string text = "Beam ";
  text += std::to_string(beam);
  text += ", bearing ";
  text += bearing_text(-degrees(image.fan.azimuth[beam]), 0.1);
  if (!title.empty()) text.append(": ").append(title);
  return text;
}

// The frame is what title and labels leave.
Axes lay_out_axes(const RangeGate& gate, Eigen::Index bins, const ColourScale& limits, const std::string& unit,
                  const PictureOptions& options, double title_bottom) {
  const int font = font_size_for(options.width, options.height);
  const double max_range = gate.min_range + static_cast<double>(bins) * gate.bin_size;
  const double bottom = 0.8 * font + room_below(font), top = title_bottom - font;
  const double most_levels = std::min(10.0, (top - bottom) / (2.5 * font));
  const AxisTicks levels = round_ticks(limits.min_db, limits.max_db, most_levels);
  const Box frame{0.8 * font + room_left(levels, font), options.width - 2.0 * font, bottom, top};
  const AxisTicks ranges = round_ticks(gate.min_range, max_range, std::min(12.0, frame.width() / (4.5 * font)));
  Axes axes{frame, gate.min_range, max_range, limits.min_db, limits.max_db, {}, {}, {}};
  add_axis_across(axes, ranges, "Range [m]", font);
  add_axis_upwards(axes, levels, unit.empty() ? "Level [dB]" : "Level, " + unit, font);
  return axes;
}

}  // namespace

void show_ascan(const LevelImage& image, std::size_t beam, const PictureOptions& options, const std::string& png_path) {
  constexpr const char* who = "show_ascan";
  require_drawable(image, options, who);
  if (beam >= image.fan.beams())
    fail(ErrorKind::argument, who, ": beam = ", beam, ", must be below the number of beams, ", image.fan.beams());
  const Grid<float> level_db = image.level_db.row(static_cast<Eigen::Index>(beam));
  const ColourScale limits = level_limits(level_db, options, who);

  // Find a place for everything, then draw it.
  const VtkMessages messages;
  PictureOptions titled = options;
  titled.title = chart_title(image, beam, options.title);
  const auto title = place_title(titled);
  Axes axes = lay_out_axes(image.gate, level_db.cols(), limits, image.unit, options, title->box().bottom);
  Canvas canvas(options, who);
  const double thin = line_width_for(font_size_for(options.width, options.height));
  canvas.add_lines(axes.grid, thin, canvas.colours().line, 0.25);
  axes.ticks.push_back(axes.outline());
  canvas.add_lines(axes.ticks, thin, canvas.colours().line, 1);
  for (const PlacedText& text : axes.texts) canvas.add_text(text);
  canvas.add_text(*title);
  const vtkNew<vtkTable> table = level_table(level_db, image.gate, limits.min_db - options.window_db);
  add_line(canvas, axes, table, options.dark ? Colour{0.98, 0.66, 0.25} : Colour{0.08, 0.33, 0.62}, 1.3 * thin);
  canvas.save_png(png_path, messages);
}

}  // namespace insonify
