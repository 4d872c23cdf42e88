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
#include <vtkTable.h>

#include "view/canvas_internal.hpp"
#include "view/fan_layout.hpp"
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

// The chart shows only the line; frame, labels and titles are ours, as in the other pictures.
void add_line(Canvas& canvas, const Axes& axes, const LineChart& line, const Colour& colour, double width) {
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

  vtkNew<vtkTable> table;
  table->AddColumn(column("x", line.x));
  table->AddColumn(column("y", line.y));
  vtkPlot* plot = chart->AddPlot(vtkChart::LINE);
  plot->SetInputData(table, 0, 1);
  plot->GetPen()->SetColorF(colour[0], colour[1], colour[2]);
  plot->GetPen()->SetWidth(static_cast<float>(width));
  vtkNew<vtkContextActor> actor;
  actor->GetScene()->AddItem(chart);
  actor->GetScene()->SetRenderer(canvas.renderer());
  canvas.renderer()->AddActor(actor);
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
  const double title_bottom = title ? title->box().bottom : options.height;
  Axes axes = lay_out_axes(chart, options, title_bottom);
  Canvas canvas(options, who);
  const double thin = line_width_for(font_size_for(options.width, options.height));
  canvas.add_lines(axes.grid, thin, canvas.colours().line, 0.25);
  axes.ticks.push_back(axes.outline());
  canvas.add_lines(axes.ticks, thin, canvas.colours().line, 1);
  for (const PlacedText& text : axes.texts) canvas.add_text(text);
  if (title) canvas.add_text(*title);
  add_line(canvas, axes, chart, options.dark ? Colour{0.98, 0.66, 0.25} : Colour{0.08, 0.33, 0.62}, 1.3 * thin);
  canvas.save_png(png_path, messages);
}

}  // namespace insonify
