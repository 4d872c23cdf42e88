// SPDX-License-Identifier: BSD-3-Clause
#include "compare/range_bands.hpp"

#include <cmath>

#include "compare/speckle_statistics.hpp"
#include "core/error.hpp"
#include "core/units.hpp"

namespace insonify {

std::vector<RangeBand> range_bands(const Grid<float>& level_db, const RangeGate& gate, std::size_t bands) {
  constexpr std::size_t fewest = 100;
  const auto bins = static_cast<std::size_t>(level_db.cols());
  if (bins != gate.bins() || bands == 0 || bands > bins)
    fail(ErrorKind::argument, "range_bands: ", bins, " bins in ", bands, " bands, must be the ", gate.bins(),
         " of the gate, in 1 to as many");
  std::vector<RangeBand> all;
  for (std::size_t k = 0; k < bands; ++k) {
    const std::size_t first = k * bins / bands, last = (k + 1) * bins / bands;
    const Grid<float> share =
        level_db.middleCols(static_cast<Eigen::Index>(first), static_cast<Eigen::Index>(last - first));
    RangeBand band;
    band.from = gate.min_range + static_cast<double>(first) * gate.bin_size;
    band.to = gate.min_range + static_cast<double>(last) * gate.bin_size;
    double power = 0;
    for (const float level : share.reshaped<Eigen::RowMajor>())
      if (!std::isnan(level)) power += power_from_db(static_cast<double>(level)), ++band.pixels;
    if (band.pixels >= fewest && power > 0) {
      const SpeckleStatistics speckle = speckle_statistics(share);
      band.mean_level_db = db_from_power(power / static_cast<double>(band.pixels));
      band.amplitude_contrast = speckle.amplitude_contrast, band.deviation_db = speckle.deviation_db;
      band.width_beams = speckle.width.beams, band.width_bins = speckle.width.bins;
    }
    all.push_back(band);
  }
  return all;
}

}  // namespace insonify
