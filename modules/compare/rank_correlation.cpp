// SPDX-License-Identifier: BSD-3-Clause
#include "compare/rank_correlation.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "compare/level_statistics.hpp"
#include "core/error.hpp"
#include "core/random.hpp"
#include "core/units.hpp"

namespace insonify {
namespace {

std::vector<double> ranks_of(const std::vector<double>& values) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
  std::vector<double> ranks(values.size());
  for (std::size_t i = 0; i < order.size();) {
    std::size_t end = i;
    while (end < order.size() && values[order[end]] == values[order[i]]) ++end;
    const double shared = 0.5 * static_cast<double>(i + end - 1);
    for (; i < end; ++i) ranks[order[i]] = shared;
  }
  return ranks;
}

std::vector<double> decades_of(const std::vector<double>& range) {
  std::vector<double> decades(range.size());
  std::transform(range.begin(), range.end(), decades.begin(), [](double r) { return std::log10(r); });
  return decades;
}

}  // namespace

double rank_correlation(const std::vector<double>& a, const std::vector<double>& b) {
  if (a.size() != b.size() || a.size() < 2)
    fail(ErrorKind::argument, "rank_correlation: lists of ", a.size(), " and ", b.size(),
         " numbers, must be of one length, at least 2");
  const std::vector<double> ra = ranks_of(a), rb = ranks_of(b);
  const auto [ma, sa] = mean_and_deviation(ra);
  const auto [mb, sb] = mean_and_deviation(rb);
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (ra[i] - ma) * (rb[i] - mb);
  return sum / static_cast<double>(a.size()) / (sa * sb);  // (E122)
}

std::vector<double> without_range_trend(const std::vector<double>& level_db, const std::vector<double>& range) {
  const std::vector<double> decades = decades_of(range);
  const FittedLine line = fit_line(decades, level_db);
  std::vector<double> rest(level_db.size());
  for (std::size_t i = 0; i < rest.size(); ++i) rest[i] = level_db[i] - line.offset - line.slope * decades[i];
  return rest;
}

PointComparison compare_points(const std::vector<double>& predicted_db, const std::vector<double>& measured_db,
                               const std::vector<double>& range, std::uint64_t seed) {
  const std::size_t n = predicted_db.size();
  if (n < 3 || measured_db.size() != n || range.size() != n)
    fail(ErrorKind::argument, "compare_points: ", n, " predicted, ", measured_db.size(), " measured levels and ",
         range.size(), " ranges, must be as many, at least 3");
  for (std::size_t i = 0; i < n; ++i)
    if (!(std::isfinite(predicted_db[i]) && std::isfinite(measured_db[i]) && range[i] > 0))
      fail(ErrorKind::argument, "compare_points: point ", i, " has levels ", predicted_db[i], " and ", measured_db[i],
           " dB at ", range[i], " m, must be finite, the range > 0");
  std::vector<double> difference(n), drawn(n);
  for (std::size_t i = 0; i < n; ++i) {
    difference[i] = predicted_db[i] - measured_db[i];
    const double u = random_uniform(seed, RandomStage::comparison, {i, 0, 1})[0];
    drawn[i] = predicted_db[i] + db_from_power(-std::log(u));
  }
  const std::vector<double> decades = decades_of(range);
  const std::vector<double> p = without_range_trend(predicted_db, range), m = without_range_trend(measured_db, range);
  std::vector<double> rest(n);
  for (std::size_t i = 0; i < n; ++i) rest[i] = p[i] - m[i];
  PointComparison c;
  c.points = n;
  c.bias_db = mean_and_deviation(difference).mean;
  c.deviation_db = mean_and_deviation(difference).deviation;
  c.predicted_slope_db = fit_line(decades, predicted_db).slope;
  c.measured_slope_db = fit_line(decades, measured_db).slope;
  c.rank = rank_correlation(predicted_db, measured_db);
  c.rank_without_trend = rank_correlation(p, m);
  c.deviation_without_trend_db = mean_and_deviation(rest).deviation;
  std::vector<double> sorted = p;
  std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(n / 2), sorted.end());
  const double median = sorted[n / 2];
  c.far_below = static_cast<double>(std::count_if(p.begin(), p.end(), [&](double l) { return l < median - 20; })) /
                static_cast<double>(n);
  c.ceiling = rank_correlation(predicted_db, drawn);
  c.ceiling_without_trend = rank_correlation(p, without_range_trend(drawn, range));
  return c;
}

}  // namespace insonify
