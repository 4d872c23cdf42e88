// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include "core/units.hpp"
#include "returns/bottom_fits_internal.hpp"

namespace insonify {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double width_of_deviation = 2.354820045;  // full width at half maximum of a Gaussian
constexpr double most_sine = 0.999;                 // largest sine of a beam's angle from the head's axis
constexpr double prior_looks = 16;                  // looks that the expected variance of a fit counts for
constexpr double fewest_cells = 8;                  // independent samples of a fit of phases
constexpr double fewest_of_slope = 2;               // independent samples of a slope alone
constexpr double most_cells = 64;                   // independent samples of the last pass: more would bend the line
constexpr double phase_reach = 0.8;                 // reach in half-power reaches: phases stay far from +-pi
constexpr double widths_of_echo = 3;                // reach of a centre of gravity, in standard deviations
constexpr double slope_error = 0.05;                // relative error of the slope that a phase is expected to have
constexpr double cell_of_pulse =
    3.545;  // 2 sqrt(pi): effective independent spacing, in standard deviations of the pulse

/// Returns the bins within `reach` of `centre`: the first, and one past the last.
std::pair<std::size_t, std::size_t> bins_within(const BottomBeam& beam, double centre, double reach) {
  const double count = static_cast<double>(beam.intensity.size());
  const double low = std::ceil((centre - reach - beam.first) / beam.step);
  const double high = std::floor((centre + reach - beam.first) / beam.step) + 1;
  return {static_cast<std::size_t>(std::clamp(low, 0.0, count)),
          static_cast<std::size_t>(std::clamp(high, 0.0, count))};
}

double wrapped(double phase) { return std::remainder(phase, 2 * pi); }

/// A line of phase over range: phase = at_centre + slope (r - centre).
struct PhaseLine {
  double centre = 0, at_centre = 0, slope = 0;
  double at(double r) const { return at_centre + slope * (r - centre); }
};

/// Returns the line by pulse pairs: the slope from phases a quarter of the interval apart, then the mean offset.
PhaseLine first_line(const BottomBeam& beam, std::size_t begin, std::size_t end, double centre) {
  const std::size_t lag = std::max<std::size_t>(1, (end - begin) / 4);
  std::complex<double> pairs = 0, all = 0;
  for (std::size_t n = begin; n + lag < end; ++n)
    pairs += std::polar(std::sqrt(beam.intensity[n] * beam.intensity[n + lag]),
                        static_cast<double>(beam.phase[n + lag]) - static_cast<double>(beam.phase[n]));
  PhaseLine line{centre, 0, std::arg(pairs) / (static_cast<double>(lag) * beam.step)};
  for (std::size_t n = begin; n < end; ++n)
    all += std::polar(beam.intensity[n], static_cast<double>(beam.phase[n]) - line.at(beam.range(n)));
  line.at_centre = std::arg(all);
  return line;
}

/// Weighted sums over an interval, relative to a fitted line.
struct PhaseSums {
  double weight = 0, x = 0, xx = 0, y = 0, xy = 0, squares = 0;
};

PhaseSums sums_about(const BottomBeam& beam, std::size_t begin, std::size_t end, const PhaseLine& line) {
  PhaseSums s;
  for (std::size_t n = begin; n < end; ++n) {
    const double w = beam.intensity[n], x = beam.range(n) - line.centre;
    const double y = wrapped(static_cast<double>(beam.phase[n]) - line.at(beam.range(n)));
    s.weight += w, s.x += w * x, s.xx += w * x * x, s.y += w * y, s.xy += w * x * y, s.squares += w * w;
  }
  return s;
}

/// Returns the line after a least-squares fit of the residuals, about the weighted middle of the interval.
PhaseLine refined(const BottomBeam& beam, std::size_t begin, std::size_t end, PhaseLine line) {
  const PhaseSums s = sums_about(beam, begin, end, line);
  const double middle = s.x / s.weight, spread = s.xx - s.x * middle;
  const double slope = spread > 0 ? (s.xy - s.y * middle) / spread : 0;
  return {line.centre + middle, line.at_centre + line.slope * middle + s.y / s.weight, line.slope + slope};
}

/// Returns the variances of offset and slope from the residuals, which a pulse's length correlates. (E95)
std::pair<double, double> variances_of(const BottomBeam& beam, std::size_t begin, std::size_t end,
                                       const PhaseLine& line, double cells) {
  const auto correlated = static_cast<std::size_t>(std::ceil(cell_of_pulse / 2 * 1.5 * cells));
  std::vector<double> offset, slope;
  double weight = 0, spread = 0;
  for (std::size_t n = begin; n < end; ++n) {
    const double w = beam.intensity[n], x = beam.range(n) - line.centre;
    const double e = w * wrapped(static_cast<double>(beam.phase[n]) - line.at(beam.range(n)));
    offset.push_back(e), slope.push_back(e * x);
    weight += w, spread += w * x * x;
  }
  const auto sum_of = [&](const std::vector<double>& v) {
    double sum = 0;
    for (std::size_t i = 0; i < v.size(); ++i)
      for (std::size_t j = i; j < std::min(v.size(), i + correlated + 1); ++j)
        sum += (i == j ? 1 : 2) * (1 - static_cast<double>(j - i) / static_cast<double>(correlated + 1)) * v[i] * v[j];
    return std::max(0.0, sum);
  };
  return {sum_of(offset) / (weight * weight), sum_of(slope) / (spread * spread)};
}

/// Returns the variance of the phase of one look [rad^2]: (1 - g^2) / 2 g^2. The coherence g of the halves falls with
/// the deviation `turn` of the phases that a pulse's length covers, and with the halves' independent noise. (E95)
double variance_of_looks(const BottomBeam& beam, double turn, double mean_intensity) {
  const double noise = 2 * beam.noise / std::max(mean_intensity - beam.noise, 0.01 * mean_intensity);
  const double coherence = std::exp(-0.5 * turn * turn) / (1 + noise);
  return (1 - coherence * coherence) / (2 * coherence * coherence);
}

/// Returns the fraction of the phase's slope that a pulse leaves: at each range it favours the middle of the beam.
double seen_slope(const BottomEcho& echo) {
  const double pulse = echo.pulse_deviation * echo.pulse_deviation;
  const double footprint = echo.footprint_deviation * echo.footprint_deviation;
  return footprint / (footprint + pulse);
}

/// Returns the number of bins in an independent sample.
double bins_of_cell(const BottomBeam& beam, const BottomEcho& echo) {
  return std::max(1.0, cell_of_pulse * echo.pulse_deviation / beam.step);
}

/// Returns the zero of a line of known slope, for an echo with too few samples to show its own slope. (E95)
BottomEstimate zero_of_known_slope(const BottomBeam& beam, const BottomEcho& echo, double start) {
  const double slope = echo.phase_slope * seen_slope(echo);
  const double reach = std::max(phase_reach * echo.half_power_reach, echo.pulse_deviation);
  double centre = start;
  PhaseSums s;
  std::size_t begin = 0, end = 0;
  for (int pass = 0; pass < 6; ++pass) {
    std::tie(begin, end) = bins_within(beam, centre, reach);
    std::complex<double> sum = 0;
    s = {};
    for (std::size_t n = begin; n < end; ++n) {
      const double w = beam.intensity[n], x = beam.range(n) - centre;
      sum += std::polar(w, static_cast<double>(beam.phase[n]) - slope * x);
      s.weight += w, s.x += w * x, s.xx += w * x * x, s.squares += w * w;
    }
    if (!(s.weight > 0)) return {start, infinite};
    centre -= std::arg(sum) / slope;
    if (!(std::abs(centre - start) < 2 * echo.half_power_reach)) return {start, infinite};
  }
  const double looks = std::max(1.0, 2 * s.weight * s.weight / s.squares / bins_of_cell(beam, echo));
  const double turn = echo.phase_slope * std::sqrt(seen_slope(echo)) * echo.pulse_deviation;
  const double variance = variance_of_looks(beam, turn, s.weight / static_cast<double>(end - begin)) / looks;
  const double away = slope_error * s.x / s.weight;
  // At one range the pulse covers a piece of the footprint, whose ranges curve over direction. (E132)
  const double across =
      echo.footprint_deviation * echo.footprint_deviation - echo.along_deviation * echo.along_deviation;
  const double seen = seen_slope(echo);
  const double curved = echo.range_curvature * (seen * s.xx / s.weight + across * (1 - seen) / seen);
  return {centre - std::clamp(curved, -0.5 * reach, 0.5 * reach) - echo.lengthening_along,
          std::sqrt(variance / (slope * slope) + away * away)};
}

}  // namespace

double median_of(std::vector<double>& values) {
  std::sort(values.begin(), values.end());
  const std::size_t middle = values.size() / 2;
  return values.size() % 2 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
}

double noise_of(std::vector<double> values) {
  const std::size_t used = std::max<std::size_t>(1, values.size() / 4);
  const auto last = values.begin() + static_cast<std::ptrdiff_t>(used - 1);
  std::nth_element(values.begin(), last, values.end());
  const double sum = std::accumulate(values.begin(), last + 1, 0.0);
  return (sum + static_cast<double>(values.size() - used) * *last) / static_cast<double>(used);
}

BottomEcho echo_of_plane(const BeamFan& fan, double sine, double range, double slope, double pulse_deviation) {
  const double width = 2 * std::sin(0.5 * fan.beam_width);
  const double across = width / width_of_deviation, along = fan.elevation_width / width_of_deviation;
  // In the fan r'' = r + 2 r'^2 / r; along the track a plane bends away from the cone of a beam. (E132)
  const double u = std::clamp(sine, -most_sine, most_sine), down = std::sqrt(1 - u * u), turned = slope * down;
  const double second = (range + 2 * turned * turned / range + turned * u / down) / (down * down);
  const double away = range + std::max(0.0, turned * u / down);
  const double spread = slope * slope * across * across + 0.5 * range * range * std::pow(across, 4) +
                        0.5 * away * away * std::pow(along, 4);  // (E94)
  BottomEcho echo{pulse_deviation, std::sqrt(spread), 0.5 * std::abs(slope) * width};
  echo.along_deviation = away * along * along / std::sqrt(2.0);
  echo.lengthening_along = 0.5 * away * along * along;
  // Limit the second-order term to the first-order one: neighbours over an edge do not define a plane.
  const double curved = std::min(0.5 * second * across * across, echo.footprint_deviation);
  echo.lengthening = curved + echo.lengthening_along;
  echo.range_curvature = slope != 0 ? curved / (slope * slope * across * across) : 0;
  return echo;
}

BottomEstimate centre_of_gravity(const BottomBeam& beam, const BottomEcho& echo, double start) {
  const double pulse = echo.pulse_deviation * echo.pulse_deviation;
  const double footprint = echo.footprint_deviation * echo.footprint_deviation;
  const double reach = std::max(widths_of_echo * std::sqrt(pulse + footprint), 1.01 * beam.step);
  double centre = start, sum = 0, square = 0;
  for (int pass = 0; pass < 6; ++pass) {
    const auto [begin, end] = bins_within(beam, centre, reach);
    double moment = 0;
    sum = square = 0;
    for (std::size_t n = begin; n < end; ++n) {
      const double x = beam.range(n) - centre;
      const double here = beam.compensated(n);
      sum += here, moment += x * here, square += x * x;
    }
    if (!(sum > 0) || !(std::abs(moment / sum) < reach)) return {start, infinite};
    centre += moment / sum;
    if (std::abs(moment / sum) < 1e-3 * beam.step) break;
  }
  const double speckle = 0.5 * footprint / std::sqrt(1 + footprint / pulse);  // (E94)
  // Noise adds its own variance and that of its product with the echo; bins a pulse's length apart are independent.
  const double at = beam.first + beam.step * std::round((centre - beam.first) / beam.step);
  const auto nearest = static_cast<std::size_t>(
      std::clamp((at - beam.first) / beam.step, 0.0, static_cast<double>(beam.intensity.size() - 1)));
  const double gain = beam.compensated(nearest) / (beam.intensity[nearest] - beam.noise);
  const double noise = beam.noise * (std::isfinite(gain) ? std::abs(gain) : 0);
  const double cells = std::max(1.0, cell_of_pulse * echo.pulse_deviation / beam.step);
  const double from_noise = cells * (noise * noise * square / (sum * sum) + 2 * noise * (pulse + footprint) / sum);
  return {centre - echo.lengthening, std::sqrt(speckle + from_noise)};
}

std::optional<double> phase_slope(const BottomBeam& beam, const BottomEcho& echo, double start) {
  const auto [begin, end] = bins_within(beam, start, phase_reach * echo.half_power_reach);
  if (beam.phase.empty() ||
      static_cast<double>(end - std::min(begin, end)) < fewest_of_slope * bins_of_cell(beam, echo))
    return {};
  return first_line(beam, begin, end, start).slope / seen_slope(echo);
}

BottomEstimate zero_crossing(const BottomBeam& beam, const BottomEcho& echo, double start) {
  // A footprint that is long along the track smears the range, so that it does not give the direction in the fan.
  if (beam.phase.empty() || echo.lengthening_along > echo.half_power_reach) return {start, infinite};
  const double cells = bins_of_cell(beam, echo);
  const double widest = phase_reach * echo.half_power_reach;
  const double narrowest = std::min(widest, 0.5 * most_cells * cells * beam.step);
  double centre = start;
  PhaseLine line;
  std::size_t begin = 0, end = 0;
  for (int pass = 0; pass < 4; ++pass) {
    std::tie(begin, end) = bins_within(beam, centre, pass < 2 ? widest : narrowest);
    if (static_cast<double>(end - std::min(begin, end)) < fewest_cells * cells)
      return zero_of_known_slope(beam, echo, start);
    line = first_line(beam, begin, end, centre);
    for (int step = 0; step < 3; ++step) line = refined(beam, begin, end, line);
    const double crossing = line.centre - wrapped(line.at_centre) / line.slope;
    if (!(std::abs(crossing - start) < 2 * echo.half_power_reach)) return {start, infinite};
    centre = crossing;
  }
  const PhaseSums s = sums_about(beam, begin, end, line);
  const double independent = s.weight * s.weight / s.squares / cells;
  if (!(independent > 2.5)) return {start, infinite};
  const auto [of_offset, of_slope] = variances_of(beam, begin, end, line, cells);
  const double away = centre - line.centre;
  const double residual = of_offset + away * away * of_slope;
  // Mix in the variance expected for so many looks while the fit has too few to judge itself. Speckle halves
  // `independent`, but not the precision: strong samples have the more precise phases.
  const double expected =
      variance_of_looks(beam, line.slope * echo.pulse_deviation, s.weight / static_cast<double>(end - begin));
  const double spread = 1 + away * away * s.weight / std::max(s.xx, 1e-30);
  const double variance = (independent * residual + prior_looks * expected * spread / (2 * independent)) /
                          (independent + prior_looks) / (line.slope * line.slope);  // (E95)
  // The fitted line is straight, but a plane's range over direction curves.
  const double curved = echo.range_curvature * (s.xx / s.weight - away * away);
  return {centre - std::clamp(curved, -0.5 * widest, 0.5 * widest) - echo.lengthening_along, std::sqrt(variance)};
}

}  // namespace insonify
