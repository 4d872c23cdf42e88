// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "view/drawing_internal.hpp"
#include "view/show_image.hpp"

namespace insonify {

void show_soundings(const Ping& ping, const BottomSoundings& found, const PictureOptions& options,
                    const std::string& png_path) {
  constexpr const char* who = "show_soundings";
  require_picture_size(options, who);
  if (found.size() == 0) fail(ErrorKind::content, who, ": ping ", ping.number, " has no sounding of the bottom");
  const Eigen::Vector3d head = ping.world_from_head.translation(), port = ping.world_from_head.linear().col(1);
  const Eigen::Vector2d starboard = -port.head<2>().normalized();

  // Make one line for each kind of points.
  LineChart chart;
  chart.lines = {{{}, {}, "by phase", LineStyle::points},
                 {{}, {}, "by amplitude", LineStyle::points},
                 {{}, {}, "rejected", LineStyle::points}};
  double low = found.position[0].z(), high = low, left = 0, right = 0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    const Eigen::Vector3d away = found.position[i] - head;
    ChartLine& line = chart.lines[found.reject[i] != 0 ? 2 : found.method[i] == BottomMethod::phase ? 0 : 1];
    line.x.push_back(starboard.dot(away.head<2>()));
    line.y.push_back(found.position[i].z());
    low = std::min(low, line.y.back()), high = std::max(high, line.y.back());
    left = std::min(left, line.x.back()), right = std::max(right, line.x.back());
  }
  std::erase_if(chart.lines, [](const ChartLine& line) { return line.x.empty(); });
  const double room = 0.05 * std::max(high - low, 0.2);
  chart.low_x = left - 0.02 * (right - left) - 0.1, chart.high_x = right + 0.02 * (right - left) + 0.1;
  chart.low_y = low - room, chart.high_y = high + room;
  chart.title = options.title;
  chart.x_title = "Across to starboard [m]";
  chart.y_title = "Height [m]";
  draw_line_chart(chart, options, who, png_path);
}

}  // namespace insonify
