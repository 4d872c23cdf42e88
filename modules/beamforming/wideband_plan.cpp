#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <numbers>

#include <Eigen/Dense>

#include "beamforming/wideband_loops_internal.hpp"
#include "beamforming/wideband_plan_internal.hpp"
#include "core/parallel.hpp"
#include "core/units.hpp"

namespace insonify {
namespace {

constexpr std::size_t most_taps = 14;
constexpr int highest_order = 24, highest_order_whole = 10, highest_order_part = 6;

/// The smallest power of 2, or small odd number times one, from `least` on: FFTW's fastest lengths.
std::size_t fast_length(std::size_t least) {
  std::size_t best = std::bit_ceil(std::max<std::size_t>(least, 16));
  for (const std::size_t odd : {3, 5, 9, 15}) best = std::min(best, odd * std::bit_ceil((least + odd - 1) / odd));
  return best;
}

/// How much finer than needed the grid of directions is, for a kernel of width 8 to be good to a fiftieth of the
/// tolerance: its error is exp(-8 pi sqrt(1 - 1 / oversampling)).
double oversampling_for(double tolerance) {
  const double root = std::clamp(-std::log(0.02 * tolerance) / (8 * pi), 0.4, 0.62);
  return 1 / (1 - root * root);
}

/// Highest frequency off the carrier that counts [Hz]: there the spectrum is down to the tolerance.
double band_of(const Pulse& pulse, double tolerance) {
  if (pulse.shape == PulseShape::linear_fm)
    return pulse.bandwidth * (0.5 + 4 / std::sqrt(pulse.bandwidth * pulse.duration));
  return pulse.bandwidth * (0.03 + std::sqrt(-std::log(tolerance) / (2 * std::numbers::ln2)));
}

/// How softly the pattern ends: what is left out of its transform then stays below the tolerance.
double end_decay_for(double tolerance) { return -0.9 - std::log(tolerance); }

/// Fourier transform of a Kaiser bump of unit area and length, to where its main lobe ends.
double end_spectrum(double end_decay, double x) {
  const double squared = end_decay * end_decay - pi * pi * x * x;
  if (squared <= 0) return 0;
  const double root = std::sqrt(squared);
  return (root < 1e-6 ? 1 : std::sinh(root) / root) * end_decay / std::sinh(end_decay);
}

double length_of(const LineArray& array) { return array.spacing * static_cast<double>(array.elements() - 1); }

/// The largest |u| of echoes from `nearest` on as any place on the array sees them.
double widest_seen(const LineArray& array, double widest, double nearest) {
  const double half = 0.5 * length_of(array), across = nearest * widest + half;
  return std::min(1.0, across / std::hypot(across, nearest * std::sqrt(1 - widest * widest)));
}

/// A gate as parts of the array hear it, up to half its length earlier or later.
RangeGate gate_of_parts(RangeGate gate, const ArrayParts& parts) {
  const double beyond = std::ceil(0.5 * parts.centre.back() / gate.bin_size) * gate.bin_size;
  gate.max_range = gate.min_range + static_cast<double>(gate.bins()) * gate.bin_size + beyond;
  gate.min_range -= beyond;
  return gate;
}

}  // namespace

WidebandPlan::WidebandPlan(const SonarHead& head_in, const Medium& medium_in, const SynthesisOptions& options,
                           double widest_in, std::size_t part_count, double nearest_in)
    : head(head_in),
      medium(medium_in),
      tolerance(options.tolerance),
      parts(head.array, part_count),
      nearest_used(nearest_in),
      widest(part_count == 1 ? widest_in : widest_seen(head.array, widest_in, nearest_in)),
      beam_axis(head.gate, medium.sound_speed),
      axis(gate_of_parts(head.gate, parts), medium.sound_speed),
      cut(pulse_cut(options.tolerance)),
      shapes(head.pulse, medium),
      margin(part_count == 1 ? 0.1 : 0.25),
      bend_rows(part_count == 1 ? 16 : 6) {
  plan_moments();
  kernel = GriddingKernel(8, oversampling_for(tolerance));
  plan_time();
  plan_directions();
  plan_response(options.threads);
  plan_curvature();
}

void WidebandPlan::plan_moments() {
  const std::size_t n = head.array.elements();
  double energy = 0, second = 0, fourth = 0;
  moment.assign(highest_order + 2, 0);
  for (std::size_t m = 0, p = 0; m < n; ++m) {
    if (m == parts.first[p + 1]) ++p;
    const double y = head.array.spacing * element_place(m, n) - parts.centre[p], squared = y * y;
    const double w = head.array.shading[m] * head.array.shading[m];
    energy += w;
    second += w * squared;
    fourth += w * squared * squared;
    for (std::size_t k = 0; k < moment.size(); ++k) moment[k] += w * std::pow(squared, 2.0 * static_cast<double>(k));
  }
  for (double& sum : moment) sum = std::sqrt(sum / energy);
  cubic = second > 0 ? fourth / second : 0;

  // What share of the pattern's energy is beside its main lobe: the pattern squared, summed to four lobe widths.
  const double wavelength = medium.sound_speed / head.pulse.centre_frequency;
  LineArray part = head.array;
  if (parts.count() > 1) part.shading.assign(n / parts.count(), 1);
  if (parts.count() > 1) energy = static_cast<double>(part.elements());
  constexpr int steps = 100;
  const double step = 2 * wavelength / std::max(parts.aperture, wavelength) / steps;
  double lobe = 0;
  for (int k = -steps; k <= steps; ++k) lobe += std::pow(array_response(part, wavelength, k * step, 0), 2) * step;
  const double all = wavelength / part.spacing * energy / static_cast<double>(part.elements() * part.elements());
  side_lobes = std::sqrt(std::clamp(1 - lobe / all, 1e-3, 1.0));
}

void WidebandPlan::plan_time() {
  const double c = medium.sound_speed;
  const PulseReach reach(head.pulse, medium.absorption, c, true, cut);
  const double last = axis.start + static_cast<double>(axis.bins) * axis.step;
  const double across = 0.5 * parts.aperture / c * 2.2 * widest;
  guard = static_cast<std::size_t>(std::ceil((across + reach.at(last)) / axis.step)) + (parts.count() == 1 ? 2 : 4);
  block =
      std::max(3 * guard, static_cast<std::size_t>(std::clamp(0.2 * nearest_used / head.gate.bin_size, 32.0, 384.0)));
  cycle = fast_length(block + 2 * guard);
  block = cycle - 2 * guard;
  half_band = band_of(head.pulse, tolerance);
  const double seconds = static_cast<double>(cycle) * axis.step;
  fine = fast_length(static_cast<std::size_t>(std::ceil(2 * half_band * seconds)) + 2);
  fine_step = seconds / static_cast<double>(fine);
  fine_row = (fine + 2 * kernels::lines_at_once - 1) / kernels::lines_at_once * kernels::lines_at_once + 8;

  pulse_range = 0.5 * c * 0.19 / head.pulse.bandwidth;
  one_shape = medium.absorption.a1 == 0 && medium.absorption.a2 == 0 && head.pulse.shape == PulseShape::gaussian;
  if (!one_shape) return;
  half = reach.half;
  pulse_samples = static_cast<std::size_t>(std::floor(2 * half / fine_step + 1e-9)) + 1;
  const EchoEnvelope envelope = echo_envelope(head.pulse, {}, 0);
  pulse = PolynomialPieces<float>::fit([&](double x) { return envelope.at(x * fine_step).real(); }, -half / fine_step,
                                       pulse_samples, 0.1 * tolerance);
}

void WidebandPlan::plan_directions() {
  double beams = 0;
  for (const double u : beam_cosines(head.fan)) beams = std::max(beams, std::abs(u));
  widest = std::max(widest, beams);
  if (parts.count() > 1) beams = widest;
  period = 2 * (widest + beams) / (1 - margin);
  // The array as long as it is at the highest frequency, the ends of the pattern's transform, and room to bend.
  const double wavelengths =
      0.5 * parts.aperture * (head.pulse.centre_frequency + 0.75 * half_band) / medium.sound_speed;
  most =
      static_cast<std::size_t>(std::ceil(wavelengths * period + end_decay_for(tolerance) / (pi * margin))) + bend_rows;
  grid = fast_length(static_cast<std::size_t>(std::ceil(oversampling_for(tolerance) * static_cast<double>(rows()))));
  grid_stride = grid + 16;
  const double half_width = 0.5 * static_cast<double>(kernel.width());
  columns = PolynomialPieces<float>::fit([this](double x) { return kernel.at(x); }, -half_width, kernel.width(), 1e-7);
  for (std::size_t r = 0; r < rows(); ++r) {
    const double k = static_cast<double>(r) - static_cast<double>(most);
    row_factor.push_back(
        static_cast<float>((r + most) % 2 == 0 ? 1 : -1) /
        static_cast<float>(kernel.transform(k / static_cast<double>(grid)) * std::sqrt(static_cast<double>(fine))));
    place.push_back(static_cast<float>(k * k / (period * period)));
  }
}

void WidebandPlan::plan_response(int threads) {
  response.assign(parts.count(), std::vector<float>(rows() * fine_row, 0));
  bend.assign(fine_row, 0);
  squared_wavelength.assign(fine_row, 0);
  place_end.assign(fine_row, 0);
  const std::size_t elements = head.array.elements();
  const double end_decay = end_decay_for(tolerance), reach = end_decay / (pi * margin),
               seconds = static_cast<double>(fine) * fine_step;
  constexpr int steps = 64;
  std::vector<double> ends;
  for (int j = 0; j <= static_cast<int>(reach * steps) + 2; ++j)
    ends.push_back(end_spectrum(end_decay, j * margin / steps));
  parallel_for(fine, threads, [&](std::size_t l) {
    const double line = l <= fine / 2 ? static_cast<double>(l) : static_cast<double>(l) - static_cast<double>(fine);
    if (std::abs(line / seconds) > half_band) return;
    const double frequency = head.pulse.centre_frequency - line / seconds;
    const double wavelength = medium.sound_speed / std::max(std::abs(frequency), 0.05 * head.pulse.centre_frequency);
    bend[l] = static_cast<float>(std::copysign(0.5 * pi * wavelength * widest * widest, frequency));
    squared_wavelength[l] = static_cast<float>(wavelength * wavelength);
    place_end[l] = static_cast<float>(
        std::pow(0.5 * parts.aperture / wavelength + std::max(0.1 * parts.aperture / wavelength, 2.0), 2));
    // Parts are interpolated in time: what the kernel does there is undone here.
    const double all =
        static_cast<double>(elements) * (parts.count() == 1 ? 1 : kernel.transform(line / static_cast<double>(fine)));
    for (std::size_t m = 0, p = 0; m < elements; ++m) {
      if (m == parts.first[p + 1]) ++p;
      const double y = head.array.spacing * element_place(m, elements) - parts.centre[p];
      const double z = period * frequency / medium.sound_speed * y;
      const double weight = head.array.shading[m] / all;
      const double first = std::max(std::ceil(z - reach), -static_cast<double>(most));
      const double last = std::min(std::floor(z + reach), static_cast<double>(most));
      const double sine = std::sin(pi * (first - z)) / pi;
      double sign = 1;
      for (double k = first; k <= last; ++k, sign = -sign) {
        const double q = k - z, at = std::abs(q) * steps, part = at - std::floor(at);
        const auto j = static_cast<std::size_t>(at);
        const double end = ends[j] + part * (ends[j + 1] - ends[j]);
        const double sinc = std::abs(q) < 1e-9 ? 1 : sign * sine / q;
        response[p][static_cast<std::size_t>(k + static_cast<double>(most)) * fine_row + l] +=
            static_cast<float>(weight * sinc * end);
      }
    }
  });
}

void WidebandPlan::plan_curvature() {
  // 1 - u^2 = 1 - w^2 / 2 + (w^2 / 2) x(u), x = sum_l tap_l cos(2 pi l u / period).
  const auto x = [this](double u) { return 1 - 2 * u * u / (widest * widest); };
  const double fine_enough = std::sqrt(1e-3 * tolerance);
  tap = harmonics(x, false, 0, fine_enough);
  steep_tap = harmonics(x, false, 1e-2, 0.1 * fine_enough);
  whole_tap = tap;
  whole_tap[0] += static_cast<float>(2 / (widest * widest) - 1);
  cubic_tap = harmonics([](double u) { return u * (1 - u * u); }, true, 1e-3, 0.1 * fine_enough);
}

std::vector<float> WidebandPlan::harmonics(const std::function<double(double)>& f, bool odd, double beside,
                                           double error) const {
  constexpr int points = 100;
  const double turn = 2 * pi / period;
  const auto wave = [&](std::size_t l, double u) {
    return odd ? std::sin(static_cast<double>(l + 1) * turn * u) : std::cos(static_cast<double>(l) * turn * u);
  };
  for (std::size_t n = 3;; ++n) {
    // Least squares within the directions in use; beside them near the value at their end, with little weight.
    Eigen::MatrixXd matrix(2 * points, n);
    Eigen::VectorXd value(2 * points);
    for (int i = 0; i < 2 * points; ++i) {
      const bool within = i < points;
      const double angle = 0.5 * pi * (i % points + 0.5) / points, part = std::sin(angle);
      const double u = within ? widest * part : widest + (0.5 * period - widest) * (i % points + 0.5) / points;
      const double weight = within ? 1 : beside;
      value[i] = weight * (within ? f(u) : odd ? 0.0 : f(widest));
      for (std::size_t l = 0; l < n; ++l) matrix(i, static_cast<Eigen::Index>(l)) = weight * wave(l, u);
    }
    const Eigen::VectorXd found = matrix.colPivHouseholderQr().solve(value);
    const double worst = (matrix * found - value).head(points).cwiseAbs().maxCoeff();
    if (worst > error && n < most_taps) continue;
    std::vector<float> result(odd ? n + 1 : n, 0);
    for (std::size_t l = 0; l < n; ++l)
      result[odd ? l + 1 : l] = static_cast<float>(l == 0 && !odd ? found[l] : 0.5 * found[l]);
    return result;
  }
}

WidebandEffort WidebandPlan::effort(double curvature, double spread) const {
  // Phases of a wavefront between directions far apart and a main lobe apart: by the square of a place [1/m^2].
  const double wavelength = medium.sound_speed / head.pulse.centre_frequency, enough = 0.25 * tolerance;
  const double lobe = std::min(1.0, wavelength / std::max(parts.aperture, 1e-3 * wavelength));
  const double far = pi * curvature / wavelength * widest * widest;
  const double near = pi * curvature / wavelength * 1.2 * lobe * widest;
  const auto beyond = [&](int n) {
    const double all = moment[n] / std::tgamma(n + 1.0);
    return (side_lobes * std::pow(far, n) + std::pow(near, n)) * all;
  };
  WidebandEffort effort;
  const double late = pi * curvature / wavelength * moment[1] * pulse_range * curvature;
  effort.fields = spread * beyond(1) + late < enough ? 1 : 2;
  const double cubic_phase = 0.4 * pi / wavelength * curvature * curvature * std::pow(moment[1], 1.5) * widest;
  effort.cubic = (side_lobes + lobe) * cubic_phase > enough;
  effort.order = effort.fields - 1;
  while (effort.order < highest_order && beyond(effort.order + 1) > enough) ++effort.order;

  // What is left out: powers, the third order beside the second, the fourth; and whether wavefronts bend across more
  // harmonics than there are.
  effort.error = beyond(effort.order + 1);
  if (effort.fields == 2) effort.error += spread * spread * beyond(1) + 0.5 * late * late;
  const double fourth = pi / wavelength * std::pow(curvature, 3) * moment[1] * moment[1] * widest * widest;
  effort.error += (side_lobes + lobe) * ((effort.cubic ? cubic_phase * far * moment[1] : 0) + 0.2 * fourth +
                                         (parts.count() == 1 ? 5 : 2) * spread * cubic_phase);
  if (0.25 * parts.aperture * parts.aperture * curvature * period / wavelength > static_cast<double>(bend_rows))
    effort.error = 1;
  return effort;
}

double WidebandPlan::nearest() const {
  const double length = length_of(head.array), beside = parts.count() == 1 ? 0 : 0.35 * length;
  double range = 0.5 * length + 0.1 * parts.aperture;
  for (;; range *= 1.05) {
    const WidebandEffort needed = effort(1 / (range - beside), 0.05);
    if (needed.error <= tolerance && needed.order <= (parts.count() == 1 ? highest_order_whole : highest_order_part))
      return range;
  }
}

}  // namespace insonify
