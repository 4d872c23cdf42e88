// SPDX-License-Identifier: BSD-3-Clause
#include "returns/first_return.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/error.hpp"
#include "core/units.hpp"

namespace insonify {

std::optional<double> first_return(const Grid<float>& row_db, const RangeGate& gate, const FirstReturnOptions& o) {
  constexpr double least_water = 1e-5;  // fraction of the strongest mean
  const auto bins = static_cast<std::size_t>(row_db.size());
  if (row_db.rows() != 1 || bins != gate.bins())
    fail(ErrorKind::argument, "first_return: a row of ", row_db.rows(), " x ", row_db.cols(), " levels, must be 1 x ",
         gate.bins());

  // Integrate the intensity before each bin; differences give means over a window.
  std::vector<double> before(bins + 1, 0.0);
  for (std::size_t n = 0; n < bins; ++n)
    before[n + 1] = before[n] + power_from_db(static_cast<double>(row_db(0, static_cast<Eigen::Index>(n))));
  const auto window = std::max<std::size_t>(1, static_cast<std::size_t>(std::lround(o.window / gate.bin_size)));
  const double blanked = std::max(0.0, std::ceil((o.blanking - gate.min_range) / gate.bin_size));
  const std::size_t begin = static_cast<std::size_t>(std::min(blanked, static_cast<double>(bins))) + window;
  const auto mean = [&](std::size_t from) {
    return (before[from + window] - before[from]) / static_cast<double>(window);
  };
  double strongest = 0;
  for (std::size_t n = begin; n + window <= bins; ++n) strongest = std::max(strongest, mean(n));

  // Find the first step that is high enough, and near it the bin where two means of speckle fit best. (E135)
  const auto water = [&](double mean_before) { return std::max(mean_before, least_water * strongest); };
  for (std::size_t n = begin; n + window <= bins && strongest > 0; ++n) {
    if (!(mean(n) >= power_from_db(o.step_db) * water(mean(n - window)))) continue;
    const std::size_t end = std::min(bins, n + 2 * window);
    std::size_t best = n;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t k = n; k < std::min(n + window, end); ++k) {
      const auto first = static_cast<double>(k - (n - window)), second = static_cast<double>(end - k);
      const double cost = first * std::log(water((before[k] - before[n - window]) / first)) +
                          second * std::log(water((before[end] - before[k]) / second));
      if (cost < least) least = cost, best = k;
    }
    return gate.min_range + static_cast<double>(best) * gate.bin_size;
  }
  return {};
}

}  // namespace insonify
