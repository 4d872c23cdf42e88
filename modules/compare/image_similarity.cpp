// SPDX-License-Identifier: BSD-3-Clause
#include "compare/image_similarity.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "core/units.hpp"

namespace insonify {
namespace {

constexpr int ssim_radius = 5;
constexpr double ssim_deviation = 1.5;

// Returns the levels clamped to the window, less its lower end; NaN stays.
Grid<double> declared_levels(const Grid<float>& level_db, const GreyWindow& window) {
  return level_db.unaryExpr([&](float level) {
    return std::isnan(level) ? std::numeric_limits<double>::quiet_NaN()
                             : std::clamp(static_cast<double>(level), window.min_db, window.max_db) - window.min_db;
  });
}

std::array<double, 2 * ssim_radius + 1> ssim_weights() {
  std::array<double, 2 * ssim_radius + 1> weights{};
  double sum = 0;
  for (int k = -ssim_radius; k <= ssim_radius; ++k)
    sum += weights[static_cast<std::size_t>(k + ssim_radius)] =
        std::exp(-0.5 * k * k / (ssim_deviation * ssim_deviation));
  for (double& weight : weights) weight /= sum;
  return weights;
}

// Returns the weighted mean about every pixel whose window lies within the image.
Grid<double> windowed(const Grid<double>& image) {
  static const auto weights = ssim_weights();
  Grid<double> rows = Grid<double>::Zero(image.rows() - 2 * ssim_radius, image.cols());
  for (std::size_t k = 0; k < weights.size(); ++k)
    rows += weights[k] * image.middleRows(static_cast<Eigen::Index>(k), rows.rows());
  Grid<double> means = Grid<double>::Zero(rows.rows(), image.cols() - 2 * ssim_radius);
  for (std::size_t k = 0; k < weights.size(); ++k)
    means += weights[k] * rows.middleCols(static_cast<Eigen::Index>(k), means.cols());
  return means;
}

double mean_ssim(const Grid<double>& a, const Grid<double>& b, double span) {
  if (std::min(a.rows(), a.cols()) <= 2 * ssim_radius) return std::numeric_limits<double>::quiet_NaN();
  const double c1 = 0.01 * 0.01 * span * span, c2 = 0.03 * 0.03 * span * span;
  const Grid<double> ma = windowed(a), mb = windowed(b);
  const Grid<double> vaa = windowed(a * a) - ma * ma, vbb = windowed(b * b) - mb * mb, vab = windowed(a * b) - ma * mb;
  const Grid<double> s =
      ((2 * ma * mb + c1) * (2 * vab + c2)) / ((ma * ma + mb * mb + c1) * (vaa + vbb + c2));  // (E120)
  double sum = 0, count = 0;
  for (const double value : s.reshaped())
    if (!std::isnan(value)) sum += value, ++count;
  return sum / count;
}

}  // namespace

double psnr_db(double mse, double span) { return db_from_power(span * span / mse); }

ImageSimilarity image_similarity(const Grid<float>& a, const Grid<float>& b, const GreyWindow& window) {
  if (a.rows() != b.rows() || a.cols() != b.cols())
    fail(ErrorKind::argument, "image_similarity: images of ", a.rows(), " x ", a.cols(), " and ", b.rows(), " x ",
         b.cols(), " pixels, must have the same size");
  if (!(std::isfinite(window.min_db) && std::isfinite(window.max_db) && window.min_db < window.max_db))
    fail(ErrorKind::argument, "image_similarity: window = ", window.min_db, " to ", window.max_db,
         " dB, must be finite and ascend");
  const Grid<double> da = declared_levels(a, window), db = declared_levels(b, window);
  ImageSimilarity result;
  double sum = 0;
  for (Eigen::Index i = 0; i < da.size(); ++i) {
    const double difference = da(i) - db(i);
    if (!std::isnan(difference)) sum += difference * difference, ++result.pixels;
  }
  if (result.pixels == 0) fail(ErrorKind::content, "image_similarity: no pixel has a level in both images");
  const double span = window.max_db - window.min_db;
  result.mse = sum / static_cast<double>(result.pixels);
  result.psnr_db = psnr_db(result.mse, span);
  result.ssim = mean_ssim(da, db, span);
  return result;
}

}  // namespace insonify
