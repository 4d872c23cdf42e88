// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <limits>

#include <boost/sort/spreadsort/float_sort.hpp>

#include "scene_io/complete_scene_internal.hpp"

namespace insonify {
namespace {

using Eigen::Vector3f;

constexpr std::uint32_t no_node = std::numeric_limits<std::uint32_t>::max();

struct GridAxis {
  double first = 0, step = 0;  ///< [m]
  std::size_t nodes = 0;       ///< 0: the values are not evenly spaced

  std::size_t node(float value) const { return static_cast<std::size_t>(std::lround((value - first) / step)); }
};

/// Returns the coordinates along an axis, ascending.
std::vector<float> sorted_values(std::span<const Vector3f> points, int axis) {
  std::vector<float> values;
  values.reserve(points.size());
  for (const Vector3f& p : points) values.push_back(p[axis]);
  boost::sort::spreadsort::float_sort(values.begin(), values.end());
  return values;
}

/// Returns a quantile of the gaps between sorted values, without gaps from rounding; 0 if there are none.
double gap_between(const std::vector<float>& values, double quantile) {
  const double least = (values.back() - values.front()) / (2 * static_cast<double>(values.size()));
  std::vector<double> gaps;
  for (std::size_t i = 1; i < values.size(); ++i)
    if (values[i] - values[i - 1] > least) gaps.push_back(values[i] - values[i - 1]);
  if (gaps.empty()) return 0;
  const auto at = gaps.begin() + static_cast<std::ptrdiff_t>(quantile * static_cast<double>(gaps.size()));
  std::nth_element(gaps.begin(), at, gaps.end());
  return *at;
}

std::vector<Vector3f> sample_of(std::span<const Vector3f> points) {
  std::vector<Vector3f> sample;
  for (std::size_t k = 0, i = 0; (i = raster_sample(k, points.size())) < points.size(); ++k)
    sample.push_back(points[i]);
  return sample;
}

/// Returns the grid along an axis. Its step is the typical gap between values.
GridAxis grid_axis(std::span<const Vector3f> points, int axis) {
  const std::vector<float> values = sorted_values(points, axis);
  const double extent = values.back() - values.front(), gap = gap_between(values, 0.5);
  if (!(gap > 0)) return {};

  GridAxis grid{values.front(), 0, static_cast<std::size_t>(std::lround(extent / gap)) + 1};
  grid.step = extent / static_cast<double>(grid.nodes - 1);
  const bool even = std::all_of(values.begin(), values.end(), [&](float v) {
    return std::abs(v - grid.first - static_cast<double>(grid.node(v)) * grid.step) <= 0.02 * grid.step;
  });
  return even ? grid : GridAxis{};
}

}  // namespace

std::size_t raster_sample(std::size_t k, std::size_t points) {
  const auto few = static_cast<std::size_t>(8 * std::sqrt(static_cast<double>(points)));
  const std::size_t step = std::max<std::size_t>(1, points / std::max<std::size_t>(1, few));
  return k * step + (k * 0x9e3779b97f4a7c15ull >> 32) % step;
}

bool may_be_raster(std::span<const Vector3f> sample, std::size_t points) {
  double nodes = 1;
  for (const int axis : {0, 1}) {
    const std::vector<float> values = sorted_values(sample, axis);
    const double gap = gap_between(values, 0.25);
    if (gap > 0) nodes *= (values.back() - values.front()) / gap;
  }
  return nodes <= 20 * static_cast<double>(points);
}

std::vector<std::array<std::uint32_t, 3>> raster_triangles(std::span<const Vector3f> points) {
  if (points.size() < 3 || !may_be_raster(sample_of(points), points.size())) return {};
  const GridAxis x = grid_axis(points, 0);
  if (x.nodes < 2) return {};
  const GridAxis y = grid_axis(points, 1);
  if (y.nodes < 2 || x.nodes > 16 * points.size() / y.nodes) return {};
  std::vector<std::uint32_t> at(x.nodes * y.nodes, no_node);
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    std::uint32_t& node = at[y.node(points[i].y()) * x.nodes + x.node(points[i].x())];
    if (node != no_node) return {};
    node = i;
  }

  std::vector<std::array<std::uint32_t, 3>> triangles;
  const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    if (a != no_node && b != no_node && c != no_node) triangles.push_back({a, b, c});
  };
  for (std::size_t row = 0; row + 1 < y.nodes; ++row)
    for (std::size_t column = 0; column + 1 < x.nodes; ++column) {
      // Number the corners counter-clockwise from the one nearest to the origin of the grid.
      const std::uint32_t *low = &at[row * x.nodes + column], *high = low + x.nodes;
      const std::uint32_t a = low[0], b = low[1], c = high[1], d = high[0];
      const auto length = [&](std::uint32_t i, std::uint32_t j) { return (points[i] - points[j]).squaredNorm(); };
      const bool whole = a != no_node && b != no_node && c != no_node && d != no_node;
      if (a == no_node || c == no_node || (whole && length(b, d) < length(a, c))) {
        add(a, b, d);
        add(b, c, d);
      } else {
        add(a, b, c);
        add(a, c, d);
      }
    }
  return triangles;
}

}  // namespace insonify
