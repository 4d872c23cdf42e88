// SPDX-License-Identifier: BSD-3-Clause
#include "compare/image_shift.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "compare/local_mean_internal.hpp"
#include "core/error.hpp"

namespace insonify {
namespace {

// Returns the correlation of the overlap at a shift, over every second pixel of either axis.
double overlap_correlation(const Grid<double>& a, const Grid<double>& b, Eigen::Index beams, Eigen::Index bins) {
  double n = 0, sa = 0, sb = 0, saa = 0, sbb = 0, sab = 0;
  for (Eigen::Index r = std::max<Eigen::Index>(0, -beams); r < std::min(b.rows(), b.rows() - beams); r += 2)
    for (Eigen::Index c = std::max<Eigen::Index>(0, -bins); c < std::min(b.cols(), b.cols() - bins); c += 2) {
      const double x = a(r + beams, c + bins), y = b(r, c);
      if (std::isnan(x) || std::isnan(y)) continue;
      ++n, sa += x, sb += y, saa += x * x, sbb += y * y, sab += x * y;
    }
  const double va = saa - sa * sa / n, vb = sbb - sb * sb / n;
  return va > 0 && vb > 0 ? (sab - sa * sb / n) / std::sqrt(va * vb) : 0;
}

}  // namespace

ImageShift find_shift(const Grid<float>& a, const Grid<float>& b, int max_beams, int max_bins) {
  if (a.rows() != b.rows() || a.cols() != b.cols())
    fail(ErrorKind::argument, "find_shift: images of ", a.rows(), " x ", a.cols(), " and ", b.rows(), " x ", b.cols(),
         " pixels, must have the same size");
  const Grid<double> sa = local_mean(a.cast<double>(), {1, 2}), sb = local_mean(b.cast<double>(), {1, 2});
  max_beams = std::min(max_beams, static_cast<int>(a.rows()) / 4);
  max_bins = std::min(max_bins, static_cast<int>(a.cols()) / 4);
  ImageShift best;
  best.correlation = best.correlation_at_0 = overlap_correlation(sa, sb, 0, 0);
  for (int beams = -max_beams; beams <= max_beams; ++beams)
    for (int bins = -max_bins; bins <= max_bins; ++bins)
      if (const double c = overlap_correlation(sa, sb, beams, bins); c > best.correlation)
        best.beams = beams, best.bins = bins, best.correlation = c;
  // Ignore a shift that noise may have made: five deviations of the transformed correlation (Fisher), of as many
  // independent pixels as boxes.
  const double boxes = static_cast<double>((!sb.isNaN()).count()) / 15;
  const double gain =
      std::atanh(std::min(best.correlation, 1 - 1e-15)) - std::atanh(std::min(best.correlation_at_0, 1 - 1e-15));
  if (!(gain > 5 / std::sqrt(std::max(1.0, boxes))))
    best.beams = best.bins = 0, best.correlation = best.correlation_at_0;
  return best;
}

Grid<float> without_shift(const Grid<float>& a, const ImageShift& shift) {
  Grid<float> moved = Grid<float>::Constant(a.rows(), a.cols(), std::numeric_limits<float>::quiet_NaN());
  const Eigen::Index beams = shift.beams, bins = shift.bins;
  const Eigen::Index rows = a.rows() - std::abs(beams), columns = a.cols() - std::abs(bins);
  if (rows > 0 && columns > 0)
    moved.block(std::max<Eigen::Index>(0, -beams), std::max<Eigen::Index>(0, -bins), rows, columns) =
        a.block(std::max<Eigen::Index>(0, beams), std::max<Eigen::Index>(0, bins), rows, columns);
  return moved;
}

}  // namespace insonify
