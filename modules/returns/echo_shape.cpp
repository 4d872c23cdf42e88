// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <complex>

#include "core/units.hpp"
#include "returns/echo_shape_internal.hpp"

namespace insonify {
namespace {

constexpr double half_maximum_width = 2.354820045;  // width of a normal law at half maximum, in deviations
constexpr double widest_slope = 0.6;                // largest slope along the track of a bottom whose echo is measured
constexpr double mean_part = 0.6;                   // fraction of the shift by skewness that counts as deviation
constexpr double width_part = 0.25;                 // fraction of an echo's excess width that counts as deviation
constexpr double coherence_reach = 20;              // smallest reach, in standard deviations of the pulse
constexpr double fewest_samples = 8;                // independent samples for a coherence
constexpr double most_coherent = 0.7;               // largest coherence of speckle a pulse's length apart
constexpr double most_off = 0.6;                    // largest distance from the coherence of the pulse

/// Moments of an echo's range about a position: mean [m], variance [m^2] and third central one [m^3].
struct EchoMoments {
  double mean = 0, variance = 0, third = 0;
};

EchoMoments moments_about(const JudgedPing& judged, std::size_t beam, double range, double reach) {
  const Bins bins = bins_about(judged.ping, range, reach);
  double sum = 0, first = 0, second = 0, third = 0;
  for (Eigen::Index n = bins.first; n < bins.end; ++n) {
    const double x = judged.ping.gate.centre(static_cast<std::size_t>(n)) - range;
    const double w = std::max(0.0, judged.intensity(static_cast<Eigen::Index>(beam), n) - judged.noise[beam]);
    sum += w, first += w * x, second += w * x * x, third += w * x * x * x;
  }
  if (!(sum > 0)) return {};
  const double m = first / sum, square = second / sum;
  return {m, std::max(0.0, square - m * m), third / sum - 3 * m * square + 2 * m * m * m};
}

}  // namespace

Bins bins_about(const Ping& ping, double range, double reach) {
  const RangeGate& gate = ping.gate;
  const double last = static_cast<double>(ping.pressure.cols() - 1);
  const double low = std::clamp(std::floor((range - reach - gate.centre(0)) / gate.bin_size), 0.0, last);
  const double high = std::clamp(std::ceil((range + reach - gate.centre(0)) / gate.bin_size), low, last);
  return {static_cast<Eigen::Index>(low), static_cast<Eigen::Index>(high) + 1};
}

bool is_of_grating_lobe(const Ping& ping, std::size_t beam, double range, double reach,
                        double pulse_deviation) {  // (E133)
  const double width = half_maximum_width * pulse_deviation, bin = ping.gate.bin_size;
  const Bins bins = bins_about(ping, range, std::max(reach, coherence_reach * pulse_deviation));
  const Eigen::Index lag = std::max<Eigen::Index>(1, std::lround(width / bin));
  const auto row = ping.pressure.row(static_cast<Eigen::Index>(beam));
  std::complex<double> pairs = 0;
  double sum = 0, squares = 0;
  for (Eigen::Index n = bins.first; n < bins.end; ++n) {
    const std::complex<double> here(row[n]);
    sum += std::norm(here), squares += std::norm(here) * std::norm(here);
    if (n + lag < bins.end) pairs += std::conj(here) * std::complex<double>(row[n + lag]);
  }
  if (!(sum * sum * std::min(1.0, bin / width) >= fewest_samples * squares)) return false;
  const std::complex<double> coherence = pairs / sum;
  const double apart = static_cast<double>(lag) * bin / pulse_deviation;
  return std::abs(coherence) > most_coherent && std::abs(coherence - std::exp(-apart * apart / 8)) > most_off;
}

double deviation_along(const JudgedPing& judged, std::size_t beam, double range, const BottomEcho& echo) {  // (E131)
  if (echo.along_deviation < 2 * echo.pulse_deviation) return 0;
  const double plane = std::hypot(echo.footprint_deviation, echo.pulse_deviation);
  const double slope = widest_slope * range * judged.ping.fan.elevation_width / half_maximum_width;
  const EchoMoments of = moments_about(judged, beam, range, std::max(3 * plane, 2 * slope));
  const double along = of.variance - plane * plane + echo.along_deviation * echo.along_deviation;
  if (!(along > 0)) return echo.lengthening_along;
  // Fit the range s v + c v^2 / 2 with a normal angle v along the track: variance and skewness give the mean shift by
  // c.
  const double skewness = of.third / std::pow(along, 1.5);
  const double mean = std::sqrt(2 * along) * std::sin(std::asin(std::clamp(skewness / std::sqrt(8.0), -1.0, 1.0)) / 3);
  const double excess = std::sqrt(std::max(0.0, of.variance - plane * plane));
  return std::max(mean_part * std::abs(mean - echo.lengthening_along), width_part * excess);
}

}  // namespace insonify
