// SPDX-License-Identifier: BSD-3-Clause
#include "returns/compare.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/units.hpp"

namespace insonify {

ImageDifference compare_images(const ComplexGrid& a, const ComplexGrid& b, double window_db) {
  if (a.rows() != b.rows() || a.cols() != b.cols())
    fail(ErrorKind::argument, "compare_images: sizes ", a.rows(), " x ", a.cols(), " and ", b.rows(), " x ", b.cols(),
         " differ");
  const double power_a = a.abs2().sum(), power_b = b.abs2().sum();
  if (!(power_b > 0)) fail(ErrorKind::argument, "compare_images: the reference image is all zero");

  ImageDifference d;
  d.relative_l2 = std::sqrt((a - b).abs2().sum() / power_b);
  d.correlation = power_a > 0 ? std::abs((a * b.conjugate()).sum()) / std::sqrt(power_a * power_b) : 0;
  d.mean_level_db = db_from_power(power_a / power_b);
  const double weakest = b.abs().maxCoeff() * amplitude_from_db(-window_db);
  for (Eigen::Index i = 0; i < b.size(); ++i) {
    const double reference = std::abs(b(i));
    if (reference >= weakest)
      d.max_level_db = std::max(d.max_level_db, std::abs(db_from_amplitude(std::abs(a(i)) / reference)));
  }
  return d;
}

}  // namespace insonify
