#include "view/line_chart.hpp"

#include <algorithm>

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

#include "view/canvas_internal.hpp"
#include "view/fan_layout.hpp"
#include "view/text.hpp"
#include "view/vtk_messages_internal.hpp"

namespace insonify {
namespace {

vtkNew<vtkFloatArray> column(const char* name, const std::vector<double>& values) {
  vtkNew<vtkFloatArray> column;
  column->SetName(name);
  column->SetNumberOfTuples(static_cast<vtkIdType>(values.size()));
  for (std::size_t i = 0; i < values.size(); ++i)
    column->SetValue(static_cast<vtkIdType>(i), static_cast<float>(values[i]));
  return column;
}

Colour line_colour(std::size_t number, bool dark) {
  static constexpr Colour on_white[] = {{0.08, 0.33, 0.62}, {0.85, 0.37, 0.05}, {0.15, 0.55, 0.30}, {0.55, 0.30, 0.65}};
  static constexpr Colour on_black[] = {{0.98, 0.66, 0.25}, {0.40, 0.70, 0.95}, {0.50, 0.80, 0.45}, {0.85, 0.60, 0.90}};
  return dark ? on_black[number % 4] : on_white[number % 4];
}

// The line itself is number 0.
std::vector<ChartLine> all_lines(const LineChart& chart) {
  std::vector<ChartLine> lines{{chart.x, chart.y, chart.name, chart.style}};
  lines.insert(lines.end(), chart.more.begin(), chart.more.end());
  return lines;
}

void add_plot(vtkChartXY& chart, const ChartLine& line, const Colour& colour, double width) {
  vtkNew<vtkTable> table;
  table->AddColumn(column("x", line.x));
  table->AddColumn(column("y", line.y));
  const bool points = line.style == LineStyle::points;
  vtkPlot* plot = chart.AddPlot(points ? vtkChart::POINTS : vtkChart::LINE);
  plot->SetInputData(table, 0, 1);
  plot->GetPen()->SetColorF(colour[0], colour[1], colour[2]);
  plot->GetPen()->SetWidth(static_cast<float>(width));
  if (line.style == LineStyle::dashed) plot->GetPen()->SetLineType(vtkPen::DASH_LINE);
  if (auto* marks = vtkPlotPoints::SafeDownCast(plot); marks && points) {
    marks->SetMarkerStyle(vtkPlotPoints::CIRCLE);
    marks->SetMarkerSize(static_cast<float>(4 * width));
  }
}

// The chart shows only the lines; frame, labels and titles are ours, as in the other pictures.
void add_chart(Canvas& canvas, const Axes& axes, const std::vector<ChartLine>& lines, bool dark, double width) {
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
  for (std::size_t i = lines.size(); i-- > 0;) add_plot(*chart, lines[i], line_colour(i, dark), width);

  vtkNew<vtkContextActor> actor;
  actor->GetScene()->AddItem(chart);
  actor->GetScene()->SetRenderer(canvas.renderer());
  canvas.renderer()->AddActor(actor);
}

bool has_legend(const std::vector<ChartLine>& lines) {
  return std::any_of(lines.begin(), lines.end(), [](const ChartLine& line) { return !line.name.empty(); });
}

// Samples and names in one row, its middle at `height`, from `left` on; the whole row is made to fit into `width`.
void add_legend(Canvas& canvas, const std::vector<ChartLine>& lines, bool dark, double line_width, int font,
                double left, double width, double height) {
  constexpr double sample = 2.0, to_name = 0.5, to_next = 1.6;  // in font sizes
  double names = 0, gaps = -to_next;
  for (const ChartLine& line : lines)
    if (!line.name.empty()) names += text_size(line.name, font).width, gaps += sample + to_name + to_next;
  const double fit = std::min(1.0, width / (names + gaps * font));
  const int size = std::max(8, static_cast<int>(font * fit));
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (lines[i].name.empty()) continue;
    const double right = left + sample * size;
    const auto stroke = [&](double from, double to) {
      return Path{{left + from * sample * size, height}, {left + to * sample * size, height}};
    };
    if (lines[i].style == LineStyle::points)
      canvas.add_lines({{{(left + right) / 2 - 2 * line_width, height}, {(left + right) / 2 + 2 * line_width, height}}},
                       4 * line_width, line_colour(i, dark), 1);
    else if (lines[i].style == LineStyle::dashed)
      canvas.add_lines({stroke(0, 0.25), stroke(0.375, 0.625), stroke(0.75, 1)}, line_width, line_colour(i, dark), 1);
    else
      canvas.add_lines({stroke(0, 1)}, line_width, line_colour(i, dark), 1);
    const double text_width = text_size(lines[i].name, size).width;
    canvas.add_text({lines[i].name, {right + to_name * size + text_width / 2, height}, size});
    left = right + (to_name + to_next) * size + text_width;
  }
}

// The frame is what title and labels leave.
Axes lay_out_axes(const LineChart& chart, const PictureOptions& options, double title_bottom) {
  const int font = font_size_for(options.width, options.height);
  const double bottom = 0.8 * font + room_below(font), top = title_bottom - font;
  const double most_levels = std::min(10.0, (top - bottom) / (2.5 * font));
  const AxisTicks up = round_ticks(chart.low_y, chart.high_y, most_levels);
  const Box frame{0.8 * font + room_left(up, font), options.width - 2.0 * font, bottom, top};
  const double most_across = std::min(12.0, frame.width() / (4.5 * font));
  const AxisTicks across =
      chart.x_ticks ? chart.x_ticks(most_across) : round_ticks(chart.low_x, chart.high_x, most_across);
  Axes axes{frame, chart.low_x, chart.high_x, chart.low_y, chart.high_y, {}, {}, {}};
  add_axis_across(axes, across, chart.x_title, font);
  add_axis_upwards(axes, up, chart.y_title, font);
  return axes;
}

}  // namespace

void draw_line_chart(const LineChart& chart, const PictureOptions& options, const char* who,
                     const std::string& png_path) {
  // Find a place for everything, then draw it.
  const VtkMessages messages;
  PictureOptions titled = options;
  titled.title = chart.title;
  const auto title = place_title(titled);
  const int font = font_size_for(options.width, options.height);
  const std::vector<ChartLine> lines = all_lines(chart);
  const double legend_height = has_legend(lines) ? 1.6 * font : 0;
  const double title_bottom = title ? title->box().bottom : options.height;
  Axes axes = lay_out_axes(chart, options, title_bottom - legend_height);
  Canvas canvas(options, who);
  const double thin = line_width_for(font);
  canvas.add_lines(axes.grid, thin, canvas.colours().line, 0.25);
  axes.ticks.push_back(axes.outline());
  canvas.add_lines(axes.ticks, thin, canvas.colours().line, 1);
  for (const PlacedText& text : axes.texts) canvas.add_text(text);
  if (title) canvas.add_text(*title);
  add_chart(canvas, axes, lines, options.dark, 1.3 * thin);
  if (has_legend(lines))
    add_legend(canvas, lines, options.dark, 1.6 * thin, font, axes.frame.left, axes.frame.width(),
               axes.frame.top + 0.5 * font + 0.5 * legend_height);
  canvas.save_png(png_path, messages);
}

}  // namespace insonify
