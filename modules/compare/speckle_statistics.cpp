// SPDX-License-Identifier: BSD-3-Clause
#include "compare/speckle_statistics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "compare/level_statistics.hpp"
#include "compare/local_mean_internal.hpp"
#include "core/error.hpp"
#include "core/units.hpp"

namespace insonify {
namespace {

constexpr int most_lags = 48;

Grid<double> intensity_of(const Grid<float>& level_db) {
  return level_db.cast<double>().unaryExpr([](double level) { return power_from_db(level); });
}

Grid<double> normalised_intensity(const Grid<float>& level_db, int half_beams, int half_bins) {
  const Grid<double> intensity = intensity_of(level_db);
  const Grid<double> mean = local_mean(intensity, {half_beams, half_bins});
  return (mean > 0).select(intensity / mean, std::numeric_limits<double>::quiet_NaN());
}

// Returns the mean product of deviations at lags along one axis, relative to that at 0.
std::vector<double> autocovariance(const Grid<double>& x, bool along_bins) {
  const Eigen::Index length = along_bins ? x.cols() : x.rows();
  std::vector<double> covariance;
  for (Eigen::Index lag = 0; lag <= std::min<Eigen::Index>(most_lags, length / 4); ++lag) {
    const Eigen::Index beams = x.rows() - (along_bins ? 0 : lag), bins = x.cols() - (along_bins ? lag : 0);
    double sum = 0, count = 0;
    for (Eigen::Index r = 0; r < beams; ++r)
      for (Eigen::Index c = 0; c < bins; ++c) {
        const double product = (x(r, c) - 1) * (x(along_bins ? r : r + lag, along_bins ? c + lag : c) - 1);
        if (!std::isnan(product)) sum += product, ++count;
      }
    covariance.push_back(count > 0 ? sum / count : 0);
  }
  const double variance = covariance.front();
  if (variance > 0)
    for (double& value : covariance) value /= variance;
  return covariance;
}

// Returns twice the lag at which the autocovariance falls to a half.
double width_at_half(const std::vector<double>& covariance) {
  for (std::size_t lag = 1; lag < covariance.size(); ++lag)
    if (covariance[lag] < 0.5)
      return 2 * (static_cast<double>(lag) -
                  (0.5 - covariance[lag]) / std::max(1e-12, covariance[lag - 1] - covariance[lag]));
  return 2.0 * static_cast<double>(covariance.size());
}

// Derivatives of the logarithm of the gamma function: recurrence up to 8, then asymptotic series.
double digamma(double x) {
  double sum = 0;
  for (; x < 8; ++x) sum -= 1 / x;
  const double q = 1 / (x * x);
  return sum + std::log(x) - 0.5 / x - q * (1.0 / 12 - q * (1.0 / 120 - q / 252));
}
double trigamma(double x) {
  double sum = 0;
  for (; x < 8; ++x) sum += 1 / (x * x);
  const double q = 1 / (x * x);
  return sum + 1 / x + 0.5 * q + q / x * (1.0 / 6 - q * (1.0 / 30 - q / 42));
}

}  // namespace

double looks_deviation_db(double looks) { return 10 / std::numbers::ln10 * std::sqrt(trigamma(looks)); }
double looks_bias_db(double looks) { return 10 / std::numbers::ln10 * (digamma(looks) - std::log(looks)); }

SpeckleStatistics speckle_statistics(const Grid<float>& level_db, int half_beams, int half_bins) {
  const Grid<double> x = normalised_intensity(level_db, half_beams, half_bins);
  double n = 0, sum = 0, squares = 0, amplitudes = 0;
  std::vector<double> levels;
  for (const double value : x.reshaped<Eigen::RowMajor>()) {
    if (std::isnan(value)) continue;
    ++n, sum += value, squares += value * value, amplitudes += std::sqrt(value);
    if (value > 0) levels.push_back(db_from_power(value));
  }
  if (levels.empty()) fail(ErrorKind::argument, "speckle_statistics: the image has no pixel with a level");
  SpeckleStatistics s;
  s.pixels = static_cast<std::size_t>(n);
  s.covariance_beams = autocovariance(x, false), s.covariance_bins = autocovariance(x, true);
  s.width = {width_at_half(s.covariance_beams), width_at_half(s.covariance_bins)};
  // The local mean of N independent cells includes the pixel, which takes 1 / (N + 1) of the second moment (E123).
  const double window = std::min<double>(static_cast<double>(x.rows()), 2.0 * half_beams + 1) *
                        std::min<double>(static_cast<double>(x.cols()), 2.0 * half_bins + 1);
  const double cells = window / (std::max(1.0, s.width.beams) * std::max(1.0, s.width.bins));
  const double mean = sum / n;
  s.scintillation = squares / n / (mean * mean) * (1 + 1 / cells) - 1;
  s.looks = 1 / s.scintillation;
  s.k_shape = s.scintillation > 1 ? 2 / (s.scintillation - 1) : std::numeric_limits<double>::infinity();
  s.amplitude_contrast = std::sqrt(std::max(0.0, mean / ((amplitudes / n) * (amplitudes / n)) - 1));
  s.deviation_db = mean_and_deviation(levels).deviation;
  return s;
}

std::vector<double> one_per_cell(const Grid<float>& level_db, const CorrelationWidths& width, int half_beams,
                                 int half_bins) {
  const Grid<double> x = normalised_intensity(level_db, half_beams, half_bins);
  const auto step = [](double w) { return std::max<Eigen::Index>(1, static_cast<Eigen::Index>(std::ceil(w))); };
  std::vector<double> sample;
  for (Eigen::Index r = 0; r < x.rows(); r += step(width.beams))
    for (Eigen::Index c = 0; c < x.cols(); c += step(width.bins))
      if (!std::isnan(x(r, c))) sample.push_back(x(r, c));
  return sample;
}

double shadow_contrast_db(const Grid<float>& level_db) {
  const Grid<double> mean = local_mean(intensity_of(level_db), {2, 4});
  std::vector<double> sorted;
  for (const double value : mean.reshaped<Eigen::RowMajor>())
    if (!std::isnan(value)) sorted.push_back(value);
  if (sorted.empty()) return std::numeric_limits<double>::quiet_NaN();
  std::sort(sorted.begin(), sorted.end());
  const auto tenth = static_cast<std::ptrdiff_t>(std::max<std::size_t>(1, sorted.size() / 10));
  double low = 0, high = 0;
  std::for_each(sorted.begin(), sorted.begin() + tenth, [&](double v) { low += v; });
  std::for_each(sorted.end() - tenth, sorted.end(), [&](double v) { high += v; });
  return db_from_power(high / low);
}

}  // namespace insonify
