// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include <vtkAxis.h>
#include <vtkChartXY.h>
#include <vtkContextActor.h>
#include <vtkContextScene.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPen.h>
#include <vtkPlot.h>
#include <vtkPlotPoints.h>
#include <vtkTable.h>

#include "core/error.hpp"
#include "view/drawing_internal.hpp"
#include "view/fan_layout_internal.hpp"
#include "view/line_chart_internal.hpp"
#include "view/off_screen_internal.hpp"

namespace insonify {
namespace {

// Returns positions along an axis from 0 at `low` to 1 at `high`. Single precision holds them for any axis.
vtkNew<vtkFloatArray> column(const char* name, const std::vector<double>& values, double low, double high) {
  vtkNew<vtkFloatArray> column;
  column->SetName(name);
  column->SetNumberOfTuples(static_cast<vtkIdType>(values.size()));
  for (std::size_t i = 0; i < values.size(); ++i)
    column->SetValue(static_cast<vtkIdType>(i), static_cast<float>((values[i] - low) / (high - low)));
  return column;
}

Colour line_colour(std::size_t number, bool dark) {
  static constexpr Colour on_white[] = {{0.08, 0.33, 0.62}, {0.85, 0.37, 0.05}, {0.15, 0.55, 0.30}, {0.55, 0.30, 0.65},
                                        {0.75, 0.12, 0.20}, {0.10, 0.60, 0.65}, {0.45, 0.33, 0.20}, {0.40, 0.40, 0.40}};
  static constexpr Colour on_black[] = {{0.98, 0.66, 0.25}, {0.40, 0.70, 0.95}, {0.50, 0.80, 0.45}, {0.85, 0.60, 0.90},
                                        {0.98, 0.45, 0.45}, {0.45, 0.90, 0.90}, {0.85, 0.75, 0.55}, {0.75, 0.75, 0.75}};
  return dark ? on_black[number % 8] : on_white[number % 8];
}

// Replaces logarithmic axes by linear axes of logarithms.
LineChart with_logarithms_taken(LineChart chart) {
  const auto take = [](double& value) { value = std::log10(value); };
  const auto take_all = [&](std::vector<double>& values) { std::for_each(values.begin(), values.end(), take); };
  if (chart.x_scale == AxisScale::logarithmic) {
    take(chart.low_x), take(chart.high_x);
    for (ChartLine& line : chart.lines) take_all(line.x);
  }
  if (chart.y_scale == AxisScale::logarithmic) {
    take(chart.low_y), take(chart.high_y);
    for (ChartLine& line : chart.lines) take_all(line.y);
  }
  return chart;
}

void add_plot(vtkChartXY& chart, const Axes& axes, const ChartLine& line, const Colour& colour, double width) {
  vtkNew<vtkTable> table;
  table->AddColumn(column("x", line.x, axes.low_x, axes.high_x));
  table->AddColumn(column("y", line.y, axes.low_y, axes.high_y));
  const bool points = line.style == LineStyle::points || line.x.size() < 2;
  vtkPlot* plot = chart.AddPlot(points ? vtkChart::POINTS : vtkChart::LINE);
  plot->SetInputData(table, 0, 1);
  plot->GetPen()->SetColorF(colour[0], colour[1], colour[2]);
  plot->GetPen()->SetWidth(static_cast<float>(width));
  if (line.style == LineStyle::dashed) plot->GetPen()->SetLineType(vtkPen::DASH_LINE);
  if (auto* marks = vtkPlotPoints::SafeDownCast(plot); marks && (points || line.style == LineStyle::marked)) {
    marks->SetMarkerStyle(vtkPlotPoints::CIRCLE);
    marks->SetMarkerSize(static_cast<float>(4 * width));
  }
}

// VTK's chart draws only the lines; frame, labels and titles are drawn as in the other pictures.
void add_chart(Canvas& canvas, const Axes& axes, const std::vector<ChartLine>& lines, bool dark, double width) {
  vtkNew<vtkChartXY> chart;
  const Box& frame = axes.frame;
  const Point2 origin = canvas.origin();
  chart->SetAutoSize(false);
  chart->SetLayoutStrategy(vtkChart::AXES_TO_RECT);
  chart->SetSize(vtkRectf(static_cast<float>(origin.x + frame.left), static_cast<float>(origin.y + frame.bottom),
                          static_cast<float>(frame.width()), static_cast<float>(frame.height())));
  for (const int which : {vtkAxis::BOTTOM, vtkAxis::LEFT}) {
    vtkAxis* axis = chart->GetAxis(which);
    axis->SetBehavior(vtkAxis::FIXED);
    axis->SetRange(0, 1);
    axis->SetTitle("");
    axis->SetLabelsVisible(false);
    axis->SetTicksVisible(false);
    axis->SetGridVisible(false);
    axis->SetAxisVisible(false);
  }
  for (std::size_t i = lines.size(); i-- > 0;) add_plot(*chart, axes, lines[i], line_colour(i, dark), width);

  vtkNew<vtkContextActor> actor;
  actor->GetScene()->AddItem(chart);
  actor->GetScene()->SetRenderer(canvas.renderer());
  canvas.renderer()->AddActor(actor);
}

// Lengths in font sizes: of a legend sample, to its name, and to the next sample.
constexpr double sample = 2.0, to_name = 0.5, to_next = 1.6;
constexpr double legend_row = 1.6;

// Distributes the lines over rows of the legend so that each row fits into `width`.
std::vector<std::vector<std::size_t>> legend_rows(const std::vector<ChartLine>& lines, int font, double width) {
  std::vector<std::vector<std::size_t>> rows;
  double used = 0;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (lines[i].name.empty()) continue;
    const double needed = (sample + to_name) * font + text_size(lines[i].name, font).width;
    if (rows.empty() || used + needed > width) rows.emplace_back(), used = 0;
    rows.back().push_back(i);
    used += needed + to_next * font;
  }
  return rows;
}

void add_legend_sample(Canvas& canvas, const ChartLine& line, const Colour& colour, double line_width, double left,
                       double right, double height) {
  const auto stroke = [&](double from, double to) {
    return Path{{left + from * (right - left), height}, {left + to * (right - left), height}};
  };
  const double middle = (left + right) / 2;
  const bool mark = line.style == LineStyle::points || line.style == LineStyle::marked;
  if (mark)
    canvas.add_lines({{{middle - 2 * line_width, height}, {middle + 2 * line_width, height}}}, 4 * line_width, colour,
                     1);
  if (line.style == LineStyle::dashed)
    canvas.add_lines({stroke(0, 0.25), stroke(0.375, 0.625), stroke(0.75, 1)}, line_width, colour, 1);
  else if (line.style != LineStyle::points)
    canvas.add_lines({stroke(0, 1)}, line_width, colour, 1);
}

// Adds samples and names in rows, the first centred half a row below `top`. Names too long for a row are fitted.
void add_legend(Canvas& canvas, const std::vector<ChartLine>& lines, bool dark, double line_width, int font,
                const Box& frame, double top) {
  double height = top + 0.5 * legend_row * font;
  for (const auto& row : legend_rows(lines, font, frame.width())) {
    height -= legend_row * font;
    double left = frame.left;
    for (const std::size_t i : row) {
      const double right = left + sample * font;
      add_legend_sample(canvas, lines[i], line_colour(i, dark), line_width, left, right, height);
      const double name = right + to_name * font;
      left = canvas.add_text_from({name, height}, lines[i].name, font, frame.right - name) + to_next * font;
    }
  }
}

// Adds labels beside their points: to the upper right, or where there is room.
void add_point_labels(Canvas& canvas, const Axes& axes, const std::vector<ChartLine>& lines, int font) {
  std::vector<Box> taken;
  const double away = 0.7 * font;
  for (const ChartLine& line : lines)
    for (std::size_t k = 0; k < std::min(line.x.size(), line.y.size()); ++k) {
      const Point2 p = axes.at(line.x[k], line.y[k]);
      taken.push_back({p.x - 0.3 * font, p.x + 0.3 * font, p.y - 0.3 * font, p.y + 0.3 * font});
    }
  for (const ChartLine& line : lines)
    for (std::size_t k = 0; k < line.labels.size(); ++k) {
      const Point2 p = axes.at(line.x[k], line.y[k]);
      const TextSize size = text_size(line.labels[k], font);
      const double x = away + size.width / 2, y = away + 0.3 * font;
      for (const Point2 step : {Point2{x, y}, {0, y + 0.2 * font}, {-x, y}, {0, -y - 0.2 * font}, {x, -y}, {-x, -y}}) {
        const PlacedText text(line.labels[k], {p.x + step.x, p.y + step.y}, font);
        const auto covers = [&](const Box& other) { return other.overlaps(text.box()); };
        if (!axes.frame.contains(text.box()) || std::any_of(taken.begin(), taken.end(), covers)) continue;
        taken.push_back(text.box());
        canvas.add_text(text);
        break;
      }
    }
}

// Lets the frame fill the space left by title and labels.
Axes lay_out_axes(const LineChart& chart, const PictureOptions& options, double title_bottom) {
  const int font = font_size_for(options);
  const double bottom = 0.8 * font + room_below(font), top = title_bottom - font;
  const double most_levels = std::min(10.0, (top - bottom) / (2.5 * font));
  const auto ticks = [](AxisScale scale) { return scale == AxisScale::linear ? round_ticks : decade_ticks; };
  const AxisTicks up = ticks(chart.y_scale)(chart.low_y, chart.high_y, most_levels);
  const Box frame{0.8 * font + room_left(up, font), options.width - 2.0 * font, bottom, top};
  const double most_across = std::min(12.0, frame.width() / (4.5 * font));
  const AxisTicks across =
      chart.x_ticks ? chart.x_ticks(most_across) : ticks(chart.x_scale)(chart.low_x, chart.high_x, most_across);
  Axes axes{frame, chart.low_x, chart.high_x, chart.low_y, chart.high_y, {}, {}, {}};
  add_axis_across(axes, across, chart.x_title, font);
  add_axis_upwards(axes, up, chart.y_title, font);
  return axes;
}

}  // namespace

Axes draw_line_chart(Canvas& canvas, const LineChart& requested, const PictureOptions& options) {
  // Lay out everything, then draw it.
  const LineChart chart = with_logarithms_taken(requested);
  PictureOptions titled = options;
  titled.title = chart.title;
  const auto title = put_title(titled);
  const int font = font_size_for(options);
  const std::vector<ChartLine>& lines = chart.lines;
  const double title_bottom = title ? title->box().bottom : options.height;
  const double across = lay_out_axes(chart, options, title_bottom).frame.width();
  const double legend_height = legend_row * font * static_cast<double>(legend_rows(lines, font, across).size());
  const Axes axes = lay_out_axes(chart, options, title_bottom - legend_height);
  const double thin = line_width_for(font);
  canvas.add_lines(axes.grid, thin, canvas.colours().line, 0.25);
  std::vector<Path> ticks = axes.ticks;
  ticks.push_back(outline(axes.frame));
  canvas.add_lines(ticks, thin, canvas.colours().line, 1);
  for (const PlacedText& text : axes.texts) canvas.add_text(text);
  if (title) canvas.add_text(*title);
  add_chart(canvas, axes, lines, options.dark, 1.3 * thin);
  add_legend(canvas, lines, options.dark, 1.6 * thin, font, axes.frame, axes.frame.top + 0.5 * font + legend_height);
  add_point_labels(canvas, axes, lines, std::max(8, font * 3 / 4));
  return axes;
}

void limit_levels(LineChart& chart, const PictureOptions& options, const char* who) {
  if (!std::isnan(options.max_db)) chart.high_y = options.max_db;
  if (!std::isnan(options.min_db)) chart.low_y = options.min_db;
  if (!(chart.high_y > chart.low_y))
    fail(ErrorKind::argument, who, ": max_db = ", chart.high_y, " dB, must exceed min_db = ", chart.low_y, " dB");
}

void draw_line_chart(const LineChart& chart, const PictureOptions& options, const char* who,
                     const std::string& png_path) {
  save_picture(options, who, png_path, [&](Canvas& canvas) { draw_line_chart(canvas, chart, options); });
}

}  // namespace insonify
