// SPDX-License-Identifier: BSD-3-Clause
#include "compare/resample_image.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/error.hpp"
#include "core/pose.hpp"
#include "core/units.hpp"

namespace insonify {
namespace {

bool has_rows(const BeamFan& fan) {
  return std::any_of(fan.elevation.begin(), fan.elevation.end(), [&](double e) { return e != fan.elevation.front(); });
}

// The beam nearest to a direction, and its distance in azimuth and elevation.
struct NearBeam {
  std::size_t beam = 0;
  double azimuth = 0, elevation = 0;
};
NearBeam nearest_direction(const BeamFan& fan, double azimuth, double elevation, bool rows) {
  NearBeam best;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t b = 0; b < fan.beams(); ++b) {
    const double da = azimuth - fan.azimuth[b], de = rows ? elevation - fan.elevation[b] : 0;
    if (const double d = da * da + de * de; d < least) least = d, best = {b, std::abs(da), std::abs(de)};
  }
  return best;
}

// Returns half the largest step between neighbouring azimuths.
double half_step(const BeamFan& fan) {
  std::vector<double> azimuth = fan.azimuth;
  std::sort(azimuth.begin(), azimuth.end());
  double step = fan.beam_width;
  for (std::size_t b = 1; b < azimuth.size(); ++b) step = std::max(step, azimuth[b] - azimuth[b - 1]);
  return 0.5 * step;
}

// Returns the mean level of the bins of a beam whose centres lie within a range; without any, that of the nearest bin.
float level_between(const ComparedImage& image, Eigen::Index beam, double from, double to) {
  const RangeGate& gate = *image.gate;
  const double first = std::ceil((from - gate.min_range) / gate.bin_size - 0.5);
  const double last = std::ceil((to - gate.min_range) / gate.bin_size - 0.5) - 1;
  const double middle = std::floor((0.5 * (from + to) - gate.min_range) / gate.bin_size);
  const double bins = static_cast<double>(image.level_db.cols());
  if (!(middle >= 0 && middle < bins)) return std::numeric_limits<float>::quiet_NaN();
  if (last < first) return image.level_db(beam, static_cast<Eigen::Index>(middle));
  double sum = 0, count = 0;
  for (double n = std::max(0.0, first); n <= std::min(last, bins - 1); ++n) {
    const float level = image.level_db(beam, static_cast<Eigen::Index>(n));
    if (!std::isnan(level)) sum += power_from_db(static_cast<double>(level)), ++count;
  }
  return count > 0 ? static_cast<float>(db_from_power(sum / count)) : std::numeric_limits<float>::quiet_NaN();
}

}  // namespace

std::optional<std::size_t> nearest_beam(const BeamFan& fan, const Eigen::Vector3d& p) {
  const bool rows = has_rows(fan);
  const Direction direction = direction_of(p);
  const NearBeam near = nearest_direction(fan, rows ? direction.azimuth : cone_azimuth(p), direction.elevation, rows);
  const double height = fan.row_width > 0 ? fan.row_width : fan.elevation_width;
  if (near.azimuth > std::max(fan.beam_width, half_step(fan)) || (rows && near.elevation > height)) return std::nullopt;
  return near.beam;
}

Grid<float> resampled(const ComparedImage& image, const BeamFan& fan, const RangeGate& gate) {
  if (!image.fan || !image.gate)
    fail(ErrorKind::argument, "resampled: the image has no geometry: beams and ranges are unknown");
  Grid<float> level =
      Grid<float>::Constant(static_cast<Eigen::Index>(fan.beams()), static_cast<Eigen::Index>(gate.bins()),
                            std::numeric_limits<float>::quiet_NaN());
  const bool rows = has_rows(*image.fan) && has_rows(fan);
  const double reach = half_step(*image.fan);
  bool any = false;
  for (std::size_t b = 0; b < fan.beams(); ++b) {
    const NearBeam near = nearest_direction(*image.fan, fan.azimuth[b], fan.elevation[b], rows);
    if (near.azimuth > reach) continue;
    for (Eigen::Index n = 0; n < level.cols(); ++n) {
      const double from = gate.min_range + static_cast<double>(n) * gate.bin_size;
      const float value = level_between(image, static_cast<Eigen::Index>(near.beam), from, from + gate.bin_size);
      level(static_cast<Eigen::Index>(b), n) = value;
      any |= !std::isnan(value);
    }
  }
  if (!any)
    fail(ErrorKind::content, "resampled: beams and ranges of the images do not overlap: ", image.gate->min_range,
         " to ", image.gate->max_range, " m and ", gate.min_range, " to ", gate.max_range, " m");
  return level;
}

Grid<float> resampled_in_range(const ComparedImage& image, const RangeGate& gate) {
  if (!image.gate) fail(ErrorKind::argument, "resampled_in_range: the image has no ranges");
  Grid<float> level(image.level_db.rows(), static_cast<Eigen::Index>(gate.bins()));
  for (Eigen::Index n = 0; n < level.cols(); ++n) {
    const double from = gate.min_range + static_cast<double>(n) * gate.bin_size;
    for (Eigen::Index p = 0; p < level.rows(); ++p) level(p, n) = level_between(image, p, from, from + gate.bin_size);
  }
  if (level.isNaN().all())
    fail(ErrorKind::content, "resampled_in_range: ranges of the images do not overlap: ", image.gate->min_range, " to ",
         image.gate->max_range, " m and ", gate.min_range, " to ", gate.max_range, " m");
  return level;
}

}  // namespace insonify
