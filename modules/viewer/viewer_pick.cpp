#include <algorithm>
#include <cmath>

#include "core/units.hpp"
#include "view/drawn_cells_internal.hpp"
#include "viewer/viewer_pick_internal.hpp"

namespace insonify {
namespace {

// The strongest of the beams drawn in the cell at a bearing, which share a cell with the nearest beam.
std::optional<std::size_t> strongest_at(const LevelImage& image, double bearing, Eigen::Index bin) {
  const BeamCells cells = order_beams(image);
  const auto turned = [&](double angle) {  // wraps an angle into the fan's interval
    const double middle = (cells.low() + cells.high()) / 2;
    return middle + std::remainder(angle - middle, 2 * pi);
  };
  const double at = turned(bearing);
  if (at < cells.low() || at > cells.high()) return {};
  const auto edge = std::upper_bound(cells.edges.begin() + 1, cells.edges.end() - 1, at);
  const double low = *(edge - 1), high = *edge;
  std::optional<std::size_t> found;
  for (std::size_t b = 0; b < image.fan.beams(); ++b) {
    const double own = turned(-image.fan.azimuth[b]);
    if (own < low || own > high) continue;
    const auto row = static_cast<Eigen::Index>(b);
    if (!found || image.level_db(row, bin) > image.level_db(static_cast<Eigen::Index>(*found), bin)) found = b;
  }
  return found;
}

}  // namespace

FanPlace fan_place(const FanLayout& layout, Point2 place) {
  const double x = place.x - layout.apex.x, y = place.y - layout.apex.y;
  return {std::atan2(x, y), std::hypot(x, y) / layout.pixels_per_metre};
}

Eigen::Vector2d metres_on_fan(FanPlace place) {
  return place.range * Eigen::Vector2d(std::sin(place.bearing), std::cos(place.bearing));
}

std::optional<PixelPlace> pixel_at(const LevelImage& image, FanPlace place) {
  const double bin = std::floor((place.range - image.gate.min_range) / image.gate.bin_size);
  if (!(bin >= 0 && bin < static_cast<double>(image.level_db.cols()))) return {};
  const auto beam = strongest_at(image, place.bearing, static_cast<Eigen::Index>(bin));
  if (!beam) return {};
  return PixelPlace{*beam, static_cast<std::size_t>(bin)};
}

std::optional<std::size_t> bin_at(const LevelImage& image, const Axes& axes, Point2 place) {
  const Box& frame = axes.frame;
  if (place.x < frame.left || place.x > frame.right || place.y < frame.bottom || place.y > frame.top) return {};
  const double range = axes.low_x + (axes.high_x - axes.low_x) * (place.x - frame.left) / frame.width();
  const double bin = std::floor((range - image.gate.min_range) / image.gate.bin_size);
  if (!(bin >= 0 && bin < static_cast<double>(image.level_db.cols()))) return {};
  return static_cast<std::size_t>(bin);
}

}  // namespace insonify
