// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "core/error.hpp"
#include "view/drawing_internal.hpp"
#include "view/fan_layout_internal.hpp"
#include "view/show_image.hpp"

namespace insonify {
namespace {

void require_history(const PingHistory& history, const PictureOptions& options) {
  RangeGate far_side = history.gate;  // for two sides, and on the ground, the near end is no range
  far_side.min_range = far_side.max_range / 2;
  require_valid(far_side, "show_waterfall");
  const auto pings = static_cast<std::size_t>(history.level_db.rows());
  const auto bins = static_cast<std::size_t>(history.level_db.cols());
  if (pings < 2) fail(ErrorKind::argument, "show_waterfall", ": ", pings, " pings, must be at least 2");
  if (history.number.size() != pings || history.time.size() != pings || bins != history.gate.bins())
    fail(ErrorKind::argument, "show_waterfall", ": history.level_db is ", pings, " x ", bins,
         ", must be pings x bins = ", history.number.size(), " x ", history.gate.bins(), ", with ", history.time.size(),
         " times as many");
  require_picture_size(options, "show_waterfall");
}

// Returns ping numbers at the centres of their rows: round ones if consecutive, otherwise at regular intervals.
AxisTicks ping_ticks(const PingHistory& history, double most) {
  const auto& number = history.number;
  const auto rows = static_cast<double>(number.size());
  const auto step = static_cast<std::int64_t>(round_step(std::max(1.0, rows / std::max(most, 2.0))));
  const bool consecutive = number.back() - number.front() + 1 == static_cast<std::int64_t>(number.size());
  AxisTicks ticks;
  for (std::size_t row = 0; row < number.size(); ++row) {
    if ((consecutive ? number[row] : static_cast<std::int64_t>(row)) % step != 0) continue;
    ticks.at.push_back(static_cast<double>(row) + 0.5);
    ticks.labels.push_back(std::to_string(number[row]));
  }
  return ticks;
}

// Returns round ranges; those to port count from the middle, too.
AxisTicks range_ticks(double low, double high, double most) {
  AxisTicks ticks = round_ticks(low, high, most);
  for (std::size_t t = 0; t < ticks.at.size(); ++t)
    if (ticks.at[t] < 0) ticks.labels[t] = ticks.labels[t].substr(ticks.labels[t].find_first_of("0123456789"));
  return ticks;
}

std::string ping_title(const PingHistory& history) {
  const double seconds = history.time.back() - history.time.front();
  std::string title = "Ping, newest on top";
  if (seconds > 0) title.append(" (").append(number_text(seconds, round_step(seconds / 100))).append(" s in all)");
  return title;
}

}  // namespace

Axes draw_waterfall(Canvas& canvas, const PingHistory& history, const PictureOptions& options) {
  const ColourScale scale = colour_scale(history.level_db, options, canvas.who());
  const int font = font_size_for(options);
  const auto pings = static_cast<double>(history.level_db.rows());
  const double min_range = history.gate.min_range;
  const double max_range = min_range + static_cast<double>(history.level_db.cols()) * history.gate.bin_size;
  const CellAxis across{min_range, max_range, history.range_title, [&](double pixels) {
                          return range_ticks(min_range, max_range, std::min(12.0, pixels / (4.5 * font)));
                        }};
  const CellAxis up{0, pings, ping_title(history),
                    [&](double pixels) { return ping_ticks(history, std::min(12.0, pixels / (2.5 * font))); }};
  const CellFrame frame = lay_out_cell_frame(across, up, scale, history.unit, options);

  // A ping is drawn like a beam of show_rect, rotated by a quarter turn.
  BeamCells rows;
  rows.level_db = history.level_db;
  for (double edge = 0; edge <= pings; ++edge) rows.edges.push_back(edge);
  const Box& box = frame.axes.frame;
  canvas.add_cells(
      rect_patch(rows, history.gate, box.height(), box.width()), rows.edges, scale,
      [&](double ping, double range) { return frame.axes.at(range, ping); }, pings);
  draw_cell_frame(canvas, frame, scale);
  return frame.axes;
}

void show_waterfall(const PingHistory& history, const PictureOptions& options, const std::string& png_path) {
  require_history(history, options);
  save_picture(options, "show_waterfall", png_path, [&](Canvas& canvas) { draw_waterfall(canvas, history, options); });
}

}  // namespace insonify
