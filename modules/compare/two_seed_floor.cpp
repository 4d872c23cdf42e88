// SPDX-License-Identifier: BSD-3-Clause
#include "compare/two_seed_floor.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "compare/local_mean_internal.hpp"
#include "core/parallel.hpp"
#include "core/random.hpp"
#include "core/units.hpp"

namespace insonify {
namespace {

// Returns a Gaussian filter that keeps the power of white noise and correlates its intensity over `width` pixels.
std::vector<double> correlating_filter(double width) {
  const double deviation = width / 2.354820045;  // sqrt(8 ln 2)
  const int half = width < 1 ? 0 : static_cast<int>(std::ceil(3 * deviation));
  std::vector<double> taps;
  double power = 0;
  for (int k = -half; k <= half; ++k) {
    taps.push_back(half == 0 ? 1 : std::exp(-0.5 * k * k / (deviation * deviation)));
    power += taps.back() * taps.back();
  }
  for (double& tap : taps) tap /= std::sqrt(power);
  return taps;
}

ComplexGrid filtered_along_rows(const ComplexGrid& noise, const std::vector<double>& taps) {
  ComplexGrid out = ComplexGrid::Zero(noise.rows(), noise.cols() - static_cast<Eigen::Index>(taps.size()) + 1);
  for (std::size_t k = 0; k < taps.size(); ++k)
    out += taps[k] * noise.middleCols(static_cast<Eigen::Index>(k), out.cols());
  return out;
}

// Returns the speckle intensity of one look, of mean 1.
Grid<double> speckle_field(Eigen::Index beams, Eigen::Index bins, const FloorOptions& o, std::uint64_t draw,
                           std::uint64_t look) {
  const std::vector<double> across = correlating_filter(o.width.beams), along = correlating_filter(o.width.bins);
  ComplexGrid noise(beams + static_cast<Eigen::Index>(across.size()) - 1,
                    bins + static_cast<Eigen::Index>(along.size()) - 1);
  parallel_for(static_cast<std::size_t>(noise.rows()), 0, [&](std::size_t r) {
    for (Eigen::Index c = 0; c < noise.cols(); ++c) {
      const auto pixel = static_cast<std::uint64_t>(static_cast<Eigen::Index>(r) * noise.cols() + c);
      noise(static_cast<Eigen::Index>(r), c) =
          random_complex_normal(o.seed, RandomStage::comparison, {pixel, draw, look});
    }
  });
  const ComplexGrid rows = filtered_along_rows(noise, along).transpose();
  return filtered_along_rows(rows, across).transpose().abs2();
}

// Returns the mean of whole looks and of one with less weight, so that the variance is 1 / looks.
Grid<double> speckle_of_looks(Eigen::Index beams, Eigen::Index bins, const FloorOptions& o, double looks,
                              std::uint64_t draw) {
  const double whole = std::floor(std::max(1.0, looks)), share = std::max(1.0, looks) - whole;
  const double total = whole + share;
  const double rest =
      total > 1 ? (whole - std::sqrt(whole * whole - (total - 1) * (total * whole - whole * whole))) / (total - 1) : 0;
  Grid<double> sum = Grid<double>::Zero(beams, bins);
  for (int look = 0; look < static_cast<int>(whole); ++look)
    sum += speckle_field(beams, bins, o, draw, static_cast<std::uint64_t>(look));
  if (rest > 1e-9) sum += rest * speckle_field(beams, bins, o, draw, static_cast<std::uint64_t>(whole));
  return sum / (whole + rest);
}

// Estimates the expected level of an image of so many looks [dB]; NaN where it is clipped.
Grid<double> expected_levels(const Grid<double>& level, double looks, const FloorOptions& o) {
  if (o.expected) return level;
  const int half_bins = std::max(4, static_cast<int>(std::lround(2 * o.width.bins)));
  return local_mean(level, {0, half_bins}) - looks_bias_db(looks);
}

Grid<float> drawn_levels(const Grid<double>& expected, const Grid<double>& speckle) {
  return (expected * speckle)
      .unaryExpr([](double power) { return db_from_power(std::max(power, 1e-30)); })
      .cast<float>();
}

// Two draws about one expected level.
struct DrawnPair {
  Grid<float> first, second;
};

// Draws twice about the expected level of `level_db`, an image of so many looks. Pixels with `held` keep their level.
DrawnPair drawn_pair(const Grid<float>& level_db, const Grid<bool>& held, double looks, const FloorOptions& o,
                     std::uint64_t draw) {
  const double unknown = std::numeric_limits<double>::quiet_NaN();
  const Grid<double> level = (held || level_db.isNaN()).select(unknown, level_db.cast<double>());
  const Grid<double> expected = level.isNaN().select(unknown, expected_levels(level, looks, o)).unaryExpr([](double l) {
    return power_from_db(l);
  });
  const Eigen::Index beams = level_db.rows(), bins = level_db.cols();
  const auto shown = [&](const Grid<double>& speckle) -> Grid<float> {
    return held.select(level_db, drawn_levels(expected, speckle));
  };
  return {shown(o.expected ? Grid<double>::Ones(beams, bins) : speckle_of_looks(beams, bins, o, o.looks, draw)),
          shown(speckle_of_looks(beams, bins, o, o.other_looks, draw + 1))};
}

ImageSimilarity analytic_floor(const GreyWindow& window, const FloorOptions& o) {
  const double span = window.max_db - window.min_db, c2 = 0.03 * 0.03 * span * span;
  const double da = o.expected ? 0 : looks_deviation_db(o.looks), db = looks_deviation_db(o.other_looks);
  const double bias = (o.expected ? 0 : looks_bias_db(o.looks)) - looks_bias_db(o.other_looks);
  ImageSimilarity floor;
  floor.mse = da * da + db * db + bias * bias;  // (E124)
  floor.psnr_db = psnr_db(floor.mse, span);
  floor.ssim = c2 / (da * da + db * db + c2);
  return floor;
}

}  // namespace

TwoSeedFloor two_seed_floor(const Grid<float>& level_db, const GreyWindow& window, const FloorOptions& options,
                            const Grid<bool>& clipped) {
  const Grid<bool> held = clipped.size() > 0 ? clipped : Grid<bool>::Constant(level_db.rows(), level_db.cols(), false);
  const DrawnPair about_image = drawn_pair(level_db, held, options.other_looks, options, 1);
  ImageSimilarity drawn = image_similarity(about_image.first, about_image.second, window);
  if (!options.expected) {
    const DrawnPair about_draw = drawn_pair(about_image.second, held, options.other_looks, options, 3);
    const ImageSimilarity again = image_similarity(about_draw.first, about_draw.second, window);
    drawn.mse = std::max(0.0, 2 * drawn.mse - again.mse);  // (E124)
    drawn.ssim = std::min(1.0, 2 * drawn.ssim - again.ssim);
    drawn.psnr_db = psnr_db(drawn.mse, window.max_db - window.min_db);
  }
  return {drawn, analytic_floor(window, options)};
}

}  // namespace insonify
