// SPDX-License-Identifier: BSD-3-Clause
#include "compare/side_scan_statistics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "compare/local_mean_internal.hpp"
#include "core/error.hpp"
#include "core/units.hpp"
#include "returns/first_return.hpp"

namespace insonify {
namespace {

constexpr HalfWindow shadow_window{1, 4};

/// Returns the median of the numbers; NaN without any.
double median_of(std::vector<double> values) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Returns the smoothed intensity of the bed; NaN before the first return.
Grid<double> bed_of(const Grid<float>& level_db, const RangeGate& gate, const SideScanStatistics& s) {
  const float nothing = std::numeric_limits<float>::quiet_NaN();
  Grid<float> bed = level_db;
  for (Eigen::Index p = 0; p < bed.rows(); ++p) {
    const auto& first = s.first_return[static_cast<std::size_t>(p)];
    const double water =
        first ? std::floor((*first - gate.min_range) / gate.bin_size) : static_cast<double>(bed.cols());
    bed.row(p)
        .head(static_cast<Eigen::Index>(std::clamp(water, 0.0, static_cast<double>(bed.cols()))))
        .setConstant(nothing);
  }
  const Grid<double> intensity = bed.cast<double>().unaryExpr([](double level) { return power_from_db(level); });
  const Grid<double> smooth = local_mean(intensity, shadow_window);
  return intensity.isNaN().select(std::numeric_limits<double>::quiet_NaN(), smooth);
}

/// Returns the intensity at each range below which a bed is in shadow: the median over pings, and over so many ranges
/// that a shadow along all pings is a small fraction of them. (E136)
std::vector<double> darkest_bed(const Grid<double>& bed, const RangeGate& gate, const ShadowOptions& o) {
  std::vector<double> typical;  // from the first range with a bed on
  std::size_t first = 0;
  for (Eigen::Index n = 0; n < bed.cols(); ++n) {
    std::vector<double> column;
    for (const double value : bed.col(n))
      if (!std::isnan(value)) column.push_back(value);
    if (2 * std::ssize(column) >= bed.rows())
      typical.push_back(median_of(column));
    else if (typical.empty())
      ++first;
    else
      typical.push_back(std::numeric_limits<double>::quiet_NaN());
  }
  const auto reach = static_cast<std::size_t>(o.along / gate.bin_size);
  std::vector<double> least(static_cast<std::size_t>(bed.cols()), std::numeric_limits<double>::quiet_NaN());
  for (std::size_t n = 0; n < typical.size(); ++n) {
    const std::size_t half = std::min({reach, n, typical.size() - 1 - n});  // symmetric: levels fall with range
    std::vector<double> around;
    for (std::size_t k = n - half; k <= n + half; ++k)
      if (!std::isnan(typical[k])) around.push_back(typical[k]);
    least[first + n] = median_of(around) * power_from_db(-o.below_db);
  }
  return least;
}

}  // namespace

SideScanStatistics side_scan_statistics(const Grid<float>& level_db, const RangeGate& gate, const ShadowOptions& o) {
  if (static_cast<std::size_t>(level_db.cols()) != gate.bins())
    fail(ErrorKind::argument, "side_scan_statistics: ", level_db.cols(), " bins, must be the ", gate.bins(),
         " of the gate");
  SideScanStatistics s;
  const float silence = std::numeric_limits<float>::lowest();
  for (Eigen::Index p = 0; p < level_db.rows(); ++p)
    s.first_return.push_back(first_return(level_db.row(p).isNaN().select(silence, level_db.row(p)), gate));
  const Grid<double> bed = bed_of(level_db, gate, s);

  const std::vector<double> least = darkest_bed(bed, gate, o);
  const auto shortest = static_cast<Eigen::Index>(std::ceil(o.least / gate.bin_size));
  double samples = 0, dark = 0, bright_power = 0, dark_power = 0;
  for (Eigen::Index p = 0; p < bed.rows(); ++p)
    for (Eigen::Index n = 0, end = 0; n < bed.cols(); n = std::max(n + 1, end)) {
      const auto hidden = [&](Eigen::Index k) { return bed(p, k) < least[static_cast<std::size_t>(k)]; };
      for (end = n; end < bed.cols() && hidden(end); ++end) {
      }
      const bool shadow = end - n >= shortest;
      for (Eigen::Index k = n; k < std::max(n + 1, end); ++k)
        if (!std::isnan(bed(p, k))) ++samples, (shadow ? dark_power : bright_power) += bed(p, k), dark += shadow;
      const double length = static_cast<double>(end - n) * gate.bin_size;
      if (!shadow || length <= s.longest_shadow) continue;
      s.longest_shadow = length, s.longest_ping = static_cast<std::size_t>(p);
      s.longest_from = gate.min_range + static_cast<double>(n) * gate.bin_size;
    }
  s.shadow_share = samples > 0 ? dark / samples : 0;
  if (dark > 0 && dark < samples && dark_power > 0)
    s.shadow_depth_db = db_from_power(bright_power / (samples - dark)) - db_from_power(dark_power / dark);
  return s;
}

}  // namespace insonify
