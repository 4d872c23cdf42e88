#include "formats/grey_fan.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include "core/error.hpp"
#include "core/units.hpp"
#include "returns/looks.hpp"

namespace insonify {

void require_one_row(const Ping& ping, const char* who) {
  if (fan_rows(ping.fan).size() > 1)
    fail(ErrorKind::content, who, ": ping ", ping.number, " has several rows of beams, must have one");
}

GreyFan grey_fan(const Ping& ping, const Tvg& tvg, const GreyWindow& window, int rows) {
  require_one_row(ping, "grey_fan");
  const Grid<std::uint8_t> grey = quantise_8(apply_tvg(shown_level_db(ping), ping.gate, tvg), window);
  std::vector<std::size_t> order(ping.fan.beams());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](auto a, auto b) { return ping.fan.azimuth[a] < ping.fan.azimuth[b]; });
  const double half = ping.fan.beam_width / 2;
  const double port = ping.fan.azimuth[order.back()] + half, starboard = ping.fan.azimuth[order.front()] - half;
  const double step = ping.gate.max_range / rows;
  const double side = ping.gate.max_range * std::sin(std::min(std::max(std::abs(port), std::abs(starboard)), pi / 2));
  const int columns = std::max(1, 2 * static_cast<int>(std::ceil(side / step)));

  GreyFan raster{Grid<std::uint8_t>::Zero(rows, columns), step};
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      const double x = (rows - row - 0.5) * step, y = (columns / 2 - column - 0.5) * step;
      const double range = std::hypot(x, y), azimuth = std::atan2(y, x);
      const double bin = std::floor((range - ping.gate.min_range) / ping.gate.bin_size);
      if (azimuth > port || azimuth < starboard || bin < 0 || bin >= static_cast<double>(grey.cols())) continue;
      auto next = std::lower_bound(order.begin(), order.end(), azimuth,
                                   [&](std::size_t b, double a) { return ping.fan.azimuth[b] < a; });
      if (next == order.end() ||
          (next != order.begin() && azimuth - ping.fan.azimuth[*(next - 1)] < ping.fan.azimuth[*next] - azimuth))
        --next;
      raster.grey(row, column) = grey(static_cast<Eigen::Index>(*next), static_cast<Eigen::Index>(bin));
    }
  return raster;
}

}  // namespace insonify
