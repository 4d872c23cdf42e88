// SPDX-License-Identifier: BSD-3-Clause
#include "sonar/beam_pattern.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <tuple>

#include "core/bisect.hpp"
#include "core/require.hpp"
#include "core/units.hpp"

namespace insonify {
namespace {

/// Response as a function of the offset |u - u_beam|, on which alone its magnitude depends.
struct Pattern {
  const LineArray& array;
  double wavelength;

  double signed_at(double offset) const { return array_response(array, wavelength, offset, 0).real(); }
  double at(double offset) const { return std::abs(signed_at(offset)); }
  double lobe() const { return wavelength / (array.spacing * static_cast<double>(array.elements())); }
  double period() const { return wavelength / array.spacing; }
};

struct Peak {
  double offset = 0, amplitude = 0;
};

constexpr double at_endfire = 1e-9;  // tolerance in u for a lobe at endfire

void require_pattern(const LineArray& array, double wavelength, double steering, const char* who) {
  require_valid(array, who);
  require(std::isfinite(wavelength) && wavelength > 0, who, "wavelength", wavelength, "m", "> 0");
  require(std::abs(steering) <= pi / 2, who, "steering", degrees(steering), "deg", "within -90 and 90");
}

/// Returns the maximum point of f in [low, high], where f is unimodal, by golden-section search.
double locate_maximum(const std::function<double(double)>& f, double low, double high) {
  const double shrink = (std::sqrt(5.0) - 1) / 2;
  double a = high - shrink * (high - low), b = low + shrink * (high - low);
  double fa = f(a), fb = f(b);
  for (int i = 0; i < 40; ++i) {
    if (fa > fb) {
      high = b, b = a, fb = fa;
      fa = f(a = high - shrink * (high - low));
    } else {
      low = a, a = b, fa = fb;
      fb = f(b = low + shrink * (high - low));
    }
  }
  return 0.5 * (low + high);
}

double locate_zero(const Pattern& pattern, double low, double high) {
  const bool positive = pattern.signed_at(low) > 0;
  std::tie(low, high) = bisected(low, high, [&](double x) { return (pattern.signed_at(x) > 0) == positive; });
  return 0.5 * (low + high);
}

/// Returns the end of the main lobe: its first zero, or its first minimum if the response rises again without one.
std::optional<double> main_lobe_end(const Pattern& pattern, double most) {
  const double step = 0.02 * pattern.lobe();
  double before = pattern.signed_at(0);
  for (int i = 1;; ++i) {
    const double offset = std::min(i * step, most), here = pattern.signed_at(offset);
    if ((here > 0) != (before > 0)) return locate_zero(pattern, (i - 1) * step, offset);
    if (std::abs(here) > std::abs(before))
      return locate_maximum([&](double x) { return -pattern.at(x); }, std::max(0, i - 2) * step, offset);
    if (offset >= most) return std::abs(here) < 1e-9 ? std::optional(most) : std::nullopt;
    before = here;
  }
}

/// Returns the highest maximum in [from, to]: samples at 16 points per lobe, then refines each candidate. Of equal
/// maxima the one nearest to the main lobe is returned.
Peak highest_peak(const Pattern& pattern, double from, double to) {
  const auto steps = static_cast<std::size_t>(std::ceil(16 * (to - from) / pattern.lobe())) + 2;
  const double step = (to - from) / static_cast<double>(steps);
  const auto offset = [&](std::size_t i) { return from + step * static_cast<double>(i); };
  std::vector<double> sample(steps + 1);
  for (std::size_t i = 0; i <= steps; ++i) sample[i] = pattern.at(offset(i));
  const double enough = 0.99 * *std::max_element(sample.begin(), sample.end());

  Peak best;
  for (std::size_t i = 0; i <= steps; ++i) {
    const std::size_t left = i > 0 ? i - 1 : i, right = i < steps ? i + 1 : i;
    if (sample[i] < enough || sample[i] < sample[left] || sample[i] < sample[right]) continue;
    const double position = locate_maximum([&](double x) { return pattern.at(x); }, offset(left), offset(right));
    const double amplitude = pattern.at(position);
    if (amplitude > best.amplitude * (1 + 1e-6)) best = {position, amplitude};
  }
  return best;
}

std::vector<double> find_grating_lobes(const Pattern& pattern, double u_beam) {
  std::vector<double> azimuths;
  if (pattern.array.elements() == 1) return azimuths;
  const auto most = static_cast<long>(2 / pattern.period()) + 1;
  for (long n = -most; n <= most; ++n) {
    const double u = u_beam + static_cast<double>(n) * pattern.period();
    if (n != 0 && std::abs(u) <= 1 + at_endfire) azimuths.push_back(std::asin(std::clamp(u, -1.0, 1.0)));  // (E33)
  }
  return azimuths;
}

void find_side_lobe(const Pattern& pattern, double u_beam, double null, BeamPatternReport& report) {
  // Symmetry and periodicity map every offset in the visible region into [0, far], on the side towards broadside.
  const double far = std::min(1 + std::abs(u_beam), pattern.period() / 2);
  const double towards = u_beam > 0 ? -1 : 1;
  Peak peak;
  double u = 0;
  if (far > null + at_endfire) {
    peak = highest_peak(pattern, null, far);
    u = u_beam + towards * peak.offset;
  }
  // A grating lobe with its peak beyond endfire contributes its flank.
  for (const double end : {-1.0, 1.0}) {
    const double offset = std::abs(end - u_beam), copy = std::round(offset / pattern.period()) * pattern.period();
    const bool flank = copy > 0 && copy - offset > at_endfire && copy - offset < null;
    if (flank && pattern.at(offset) > peak.amplitude) peak = {offset, pattern.at(offset)}, u = end;
  }
  if (peak.amplitude < 1e-12) return;
  report.highest_side_lobe_db = db_from_amplitude(peak.amplitude);
  report.highest_side_lobe = std::asin(std::clamp(u, -1.0, 1.0));
}

}  // namespace

BeamPatternReport measure_beam_pattern(const LineArray& array, double wavelength, double steering) {
  require_pattern(array, wavelength, steering, "measure_beam_pattern");
  const Pattern pattern{array, wavelength};
  const double u_beam = std::sin(steering), most = 1 + std::abs(u_beam);
  const auto azimuth = [](double u) { return std::asin(std::clamp(u, -1.0, 1.0)); };

  BeamPatternReport report;
  const double half = half_power_offset(array, wavelength, most);
  report.width = azimuth(u_beam + half) - azimuth(u_beam - half);  // (E35)
  report.grating_lobes = find_grating_lobes(pattern, u_beam);
  report.directivity_index_db = directivity_index_db(array, wavelength, u_beam);
  if (const auto null = main_lobe_end(pattern, most)) {
    report.first_null = std::abs(steering) - azimuth(std::abs(u_beam) - *null);
    find_side_lobe(pattern, u_beam, *null, report);
  }
  return report;
}

BeamPatternCurve beam_pattern_curve(const LineArray& array, double wavelength, double steering) {
  require_pattern(array, wavelength, steering, "beam_pattern_curve");
  const double lobe = Pattern{array, wavelength}.lobe();
  const auto steps = std::max<std::size_t>(1800, static_cast<std::size_t>(std::ceil(16 * pi / lobe)));
  BeamPatternCurve curve;
  const auto add = [&](double azimuth, double amplitude) {
    curve.azimuth.push_back(azimuth);
    curve.level_db.push_back(db_from_amplitude(std::abs(amplitude)));
  };
  double before = 0;
  for (std::size_t i = 0; i <= steps; ++i) {
    const double azimuth = pi * (static_cast<double>(i) / static_cast<double>(steps) - 0.5);
    const double here = array_response(array, wavelength, std::sin(azimuth), std::sin(steering)).real();
    // Insert a point at a null between two samples, where their linear interpolation is zero.
    if (before * here < 0) add(curve.azimuth.back() + (azimuth - curve.azimuth.back()) * before / (before - here), 0);
    add(azimuth, here);
    before = here;
  }
  return curve;
}

}  // namespace insonify
