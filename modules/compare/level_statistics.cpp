// SPDX-License-Identifier: BSD-3-Clause
#include "compare/level_statistics.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"

namespace insonify {
namespace {

void sort_sample(std::vector<double>& sample, const char* who) {
  if (sample.empty()) fail(ErrorKind::argument, who, ": a sample is empty, must hold a number at least");
  std::sort(sample.begin(), sample.end());
}

// Returns the probability of a distance above D by Kolmogorov's distribution, for an effective number of samples.
double kolmogorov_tail(double distance, double samples) {
  const double root = std::sqrt(samples), x = (root + 0.12 + 0.11 / root) * distance;
  if (x < 0.2) return 1;
  double sum = 0;
  for (int k = 1; k <= 100; ++k) sum += (k % 2 ? 2 : -2) * std::exp(-2.0 * k * k * x * x);
  return std::clamp(sum, 0.0, 1.0);
}

double quantile_of(const std::vector<double>& sorted, double share) {
  const double at = share * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(at);
  const std::size_t above = std::min(below + 1, sorted.size() - 1);
  return sorted[below] + (at - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

}  // namespace

MeanAndDeviation mean_and_deviation(const std::vector<double>& values) {
  const double count = static_cast<double>(values.size());
  double sum = 0, squares = 0;
  for (const double value : values) sum += value;
  const double mean = sum / count;
  for (const double value : values) squares += (value - mean) * (value - mean);
  return {mean, std::sqrt(squares / count)};
}

double wasserstein_1(std::vector<double> a, std::vector<double> b) {
  sort_sample(a, "wasserstein_1"), sort_sample(b, "wasserstein_1");
  // Both quantile functions are steps: go through the steps of both.
  const double na = static_cast<double>(a.size()), nb = static_cast<double>(b.size());
  double sum = 0, share = 0;
  for (std::size_t i = 0, j = 0; i < a.size() && j < b.size();) {
    const double end_a = static_cast<double>(i + 1) / na, end_b = static_cast<double>(j + 1) / nb;
    const double end = std::min(end_a, end_b);
    sum += (end - share) * std::abs(a[i] - b[j]);  // (E121)
    share = end;
    if (end_a <= end) ++i;
    if (end_b <= end) ++j;
  }
  return sum;
}

KolmogorovSmirnov kolmogorov_smirnov(std::vector<double> a, std::vector<double> b) {
  sort_sample(a, "kolmogorov_smirnov"), sort_sample(b, "kolmogorov_smirnov");
  const double na = static_cast<double>(a.size()), nb = static_cast<double>(b.size());
  KolmogorovSmirnov test{0, 1, a.size(), b.size()};
  for (std::size_t i = 0, j = 0; i < a.size() && j < b.size();) {
    const double at = std::min(a[i], b[j]);
    while (i < a.size() && a[i] <= at) ++i;
    while (j < b.size() && b[j] <= at) ++j;
    test.distance = std::max(test.distance, std::abs(static_cast<double>(i) / na - static_cast<double>(j) / nb));
  }
  test.probability = kolmogorov_tail(test.distance, na * nb / (na + nb));
  return test;
}

KolmogorovSmirnov kolmogorov_smirnov_exponential(std::vector<double> sample) {
  sort_sample(sample, "kolmogorov_smirnov_exponential");
  const double n = static_cast<double>(sample.size());
  KolmogorovSmirnov test{0, 1, sample.size(), 0};
  for (std::size_t i = 0; i < sample.size(); ++i) {
    const double law = -std::expm1(-sample[i]), below = static_cast<double>(i) / n;
    test.distance = std::max({test.distance, law - below, below + 1 / n - law});
  }
  test.probability = kolmogorov_tail(test.distance, n);
  return test;
}

FittedLine fit_line(const std::vector<double>& x, const std::vector<double>& y) {
  const double mx = mean_and_deviation(x).mean, my = mean_and_deviation(y).mean;
  double xx = 0, xy = 0;
  for (std::size_t i = 0; i < x.size(); ++i) xx += (x[i] - mx) * (x[i] - mx), xy += (x[i] - mx) * (y[i] - my);
  const double slope = xx > 0 ? xy / xx : 0;
  return {my - slope * mx, slope};
}

LevelMap level_map(std::vector<double> from, std::vector<double> to) {
  sort_sample(from, "level_map"), sort_sample(to, "level_map");
  LevelMap map;
  for (int k = 0; k <= 20; ++k) {
    const double level = quantile_of(from, k / 20.0);
    if (!map.from.empty() && level <= map.from.back()) continue;  // map equal levels to one
    map.from.push_back(level);
    map.to.push_back(quantile_of(to, k / 20.0));
  }
  return map;
}

double mapped(const LevelMap& map, double level) {
  if (level <= map.from.front()) return map.to.front() + (level - map.from.front());
  if (level >= map.from.back()) return map.to.back() + (level - map.from.back());
  const auto above =
      static_cast<std::size_t>(std::upper_bound(map.from.begin(), map.from.end(), level) - map.from.begin());
  const double share = (level - map.from[above - 1]) / (map.from[above] - map.from[above - 1]);
  return map.to[above - 1] + share * (map.to[above] - map.to[above - 1]);
}

}  // namespace insonify
