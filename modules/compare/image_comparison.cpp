// SPDX-License-Identifier: BSD-3-Clause
#include "compare/image_comparison.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/error.hpp"
#include "core/units.hpp"

namespace insonify {
namespace {

constexpr double default_span_db = 60;

GreyWindow window_of(const Grid<float>& level_db) {
  std::vector<double> levels;
  for (const float level : level_db.reshaped<Eigen::RowMajor>())
    if (!std::isnan(level)) levels.push_back(static_cast<double>(level));
  const auto top = levels.begin() + static_cast<std::ptrdiff_t>(0.999 * static_cast<double>(levels.size() - 1));
  std::nth_element(levels.begin(), top, levels.end());
  const double max_db = 5 * std::ceil(*top / 5) + 0.0;  // no -0
  return {max_db - default_span_db, max_db};
}

ImageCharacter character_of(const Grid<float>& levels, const ComparedImage& image) {
  ImageCharacter c;
  c.speckle = speckle_statistics(levels);
  c.exponential = kolmogorov_smirnov_exponential(one_per_cell(levels, c.speckle.width));
  c.shadow_contrast_db = shadow_contrast_db(levels);
  double power = 0, count = 0;
  for (const float level : levels.reshaped<Eigen::RowMajor>())
    if (!std::isnan(level)) power += power_from_db(static_cast<double>(level)), ++count;
  c.mean_level_db = db_from_power(power / count);
  c.clipped = static_cast<double>(levels.isNaN().count() - image.level_db.isNaN().count()) /
              static_cast<double>(std::max<Eigen::Index>(1, (!image.level_db.isNaN()).count()));
  return c;
}

// Levels of the pixels that both images have, with the logarithm of range.
struct LevelPairs {
  std::vector<double> a, b, decades;
};
LevelPairs pairs_of(const Grid<float>& a, const Grid<float>& b, const std::optional<RangeGate>& gate) {
  LevelPairs pairs;
  for (Eigen::Index beam = 0; beam < a.rows(); ++beam)
    for (Eigen::Index n = 0; n < a.cols(); ++n) {
      if (std::isnan(a(beam, n)) || std::isnan(b(beam, n))) continue;
      pairs.a.push_back(static_cast<double>(a(beam, n)));
      pairs.b.push_back(static_cast<double>(b(beam, n)));
      if (gate) pairs.decades.push_back(std::log10(gate->centre(static_cast<std::size_t>(n))));
    }
  if (pairs.a.empty())
    fail(ErrorKind::content,
         "compare_level_images: no pixel has a level in both images: they are silent, clipped or apart");
  return pairs;
}

// Compares pixel by pixel. Returns the line of A - B over the decades of range.
FittedLine compare_pairs(const LevelPairs& pairs, ImageComparison& c) {
  std::vector<double> difference(pairs.a.size());
  for (std::size_t i = 0; i < difference.size(); ++i) difference[i] = pairs.a[i] - pairs.b[i];
  c.pixels = difference.size();
  c.bias_db = mean_and_deviation(difference).mean;
  const auto power = [](double sum, double level) { return sum + power_from_db(level); };
  c.power_bias_db = db_from_power(std::accumulate(pairs.a.begin(), pairs.a.end(), 0.0, power)) -
                    db_from_power(std::accumulate(pairs.b.begin(), pairs.b.end(), 0.0, power));
  c.deviation_db = mean_and_deviation(difference).deviation;
  c.wasserstein_db = wasserstein_1(pairs.a, pairs.b);
  std::vector<double> level = pairs.a;
  for (double& l : level) l -= c.bias_db;
  c.wasserstein_after_gain_db = wasserstein_1(level, pairs.b);
  const FittedLine line = pairs.decades.empty() ? FittedLine{c.bias_db, 0} : fit_line(pairs.decades, difference);
  c.tvg_slope_db = pairs.decades.empty() ? std::numeric_limits<double>::quiet_NaN() : line.slope;
  for (std::size_t i = 0; i < level.size(); ++i)
    level[i] = pairs.a[i] - line.offset - (pairs.decades.empty() ? 0 : line.slope * pairs.decades[i]);
  c.map = level_map(level, pairs.b);
  const auto spread = [](std::vector<double> l) {
    std::sort(l.begin(), l.end());
    return l[3 * (l.size() - 1) / 4] - l[(l.size() - 1) / 4];
  };
  c.map_slope = spread(level) > 0 ? spread(pairs.b) / spread(level) : 1;
  return line;
}

void compare_fitted(const ComparedImage& a, const ComparedImage& b, const FittedLine& line, ImageComparison& c) {
  const auto add = [&](const char* fitted, const Grid<float>& level) {
    c.similarity.push_back({fitted, image_similarity(level, b.level_db, c.window)});
  };
  add("nothing", a.level_db);
  add("gain", a.level_db - static_cast<float>(c.bias_db));
  Grid<float> level = a.level_db;
  if (b.gate) {
    for (Eigen::Index n = 0; n < level.cols(); ++n)
      level.col(n) -=
          static_cast<float>(line.offset + line.slope * std::log10(b.gate->centre(static_cast<std::size_t>(n))));
    add("gain and TVG", level);
  } else {
    level -= static_cast<float>(c.bias_db);
  }
  const Grid<float> matched = level.unaryExpr(
      [&](float l) { return std::isnan(l) ? l : static_cast<float>(mapped(c.map, static_cast<double>(l))); });
  add(b.gate ? "gain, TVG and map" : "gain and map", matched);
}

double whole_looks(const SpeckleStatistics& s) { return std::clamp(s.looks, 1.0, 16.0); }

// Returns the floor about the expected level if one of the images is that, otherwise about the reference.
TwoSeedFloor floor_of(const ComparedImage& a, const ComparedImage& b, const Grid<float>& la, const Grid<float>& lb,
                      const ImageComparison& c, std::uint64_t seed) {
  const SpeckleStatistics &sa = c.a.speckle, &sb = c.b.speckle;
  if (a.expected_level && b.expected_level) {
    const ImageSimilarity same = image_similarity(lb, lb, c.window);
    return {same, same};
  }
  const auto floor = [&](const ComparedImage& of, const Grid<float>& levels, const FloorOptions& options) {
    return two_seed_floor(of.level_db, c.window, options, levels.isNaN() && !of.level_db.isNaN());
  };
  if (a.expected_level) return floor(a, la, {1, whole_looks(sb), true, sb.width, seed});
  if (b.expected_level) return floor(b, lb, {1, whole_looks(sa), true, sa.width, seed});
  return floor(b, lb, {whole_looks(sa), whole_looks(sb), false, sb.width, seed});
}

}  // namespace

Grid<float> unclipped_levels(const ComparedImage& image) {
  const float nothing = std::numeric_limits<float>::quiet_NaN();
  return image.level_db.unaryExpr([&](float level) {
    const bool clipped =
        level <= silence_db || (image.scale && (level <= image.scale->min_db || level >= image.scale->max_db));
    return clipped ? nothing : level;
  });
}

ImageComparison compare_level_images(const ComparedImage& a, const ComparedImage& b, const ComparisonOptions& options) {
  if (a.level_db.rows() != b.level_db.rows() || a.level_db.cols() != b.level_db.cols())
    fail(ErrorKind::argument, "compare_level_images: images of ", a.level_db.rows(), " x ", a.level_db.cols(), " and ",
         b.level_db.rows(), " x ", b.level_db.cols(), " beams x bins, must have the same size");
  const Grid<float> la = unclipped_levels(a), lb = unclipped_levels(b);
  const LevelPairs pairs = pairs_of(la, lb, b.gate);
  ImageComparison c;
  c.window = options.window ? *options.window : window_of(lb);
  c.a = character_of(la, a), c.b = character_of(lb, b);
  compare_fitted(a, b, compare_pairs(pairs, c), c);

  // Take one sample for each resolution cell of the coarser image.
  const CorrelationWidths wa = c.a.speckle.width, wb = c.b.speckle.width;
  const CorrelationWidths coarser{std::max(wa.beams, wb.beams), std::max(wa.bins, wb.bins)};
  c.samples = kolmogorov_smirnov(one_per_cell(la, coarser), one_per_cell(lb, coarser));

  c.floor = floor_of(a, b, la, lb, c, options.seed);
  c.shift = find_shift(la, lb);
  return c;
}

}  // namespace insonify
