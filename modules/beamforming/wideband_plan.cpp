#include "beamforming/wideband_plan_internal.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Dense>

#include "core/parallel.hpp"
#include "core/units.hpp"
#include "beamforming/wideband_loops_internal.hpp"

namespace insonify {
namespace {

constexpr double oversampling = 1.5;  // of the grid of directions
constexpr double margin = 0.1;        // of the period, over which the pattern may end
constexpr double end_decay = 7;       // how softly it ends there
constexpr std::size_t most_taps = 12;
constexpr int highest_order = 8;

std::size_t fast_length(std::size_t least) {
  for (std::size_t n = least + least % 2;; n += 2) {
    std::size_t rest = n;
    for (const std::size_t factor : {2, 3, 5})
      while (rest % factor == 0) rest /= factor;
    if (rest == 1) return n;
  }
}

/// Highest frequency off the carrier that counts [Hz]: there the spectrum is down to the tolerance.
double band_of(const Pulse& pulse, double tolerance) {
  if (pulse.shape == PulseShape::linear_fm)
    return pulse.bandwidth * (0.5 + 4 / std::sqrt(pulse.bandwidth * pulse.duration));
  return pulse.bandwidth * (0.1 + std::sqrt(-std::log(tolerance) / (2 * std::numbers::ln2)));
}

/// Fourier transform of a Kaiser bump of unit area and length, to where its main lobe ends.
double end_spectrum(double x) {
  const double squared = end_decay * end_decay - pi * pi * x * x;
  if (squared <= 0) return 0;
  const double root = std::sqrt(squared);
  return (root < 1e-6 ? 1 : std::sinh(root) / root) * end_decay / std::sinh(end_decay);
}

}  // namespace

WidebandPlan::WidebandPlan(const SonarHead& head_in, const Medium& medium_in, const SynthesisOptions& options,
                           double widest_in)
    : head(head_in),
      medium(medium_in),
      tolerance(options.tolerance),
      widest(widest_in),
      axis(head.gate, medium.sound_speed),
      cut(pulse_cut(options.tolerance)),
      shapes(head.pulse, medium),
      aperture(head.array.spacing * static_cast<double>(head.array.elements() - 1)) {
  double weight = 0, second = 0, fourth = 0;
  for (std::size_t m = 0; m < head.array.elements(); ++m) {
    const double y = head.array.spacing * element_place(m, head.array.elements());
    const double w = head.array.shading[m] * head.array.shading[m];
    weight += w;
    second += w * y * y;
    fourth += w * y * y * y * y;
  }
  place_squared = second / weight;
  cubic = second > 0 ? fourth / second : 0;
  plan_time();
  plan_directions();
  plan_response(options.threads);
  plan_curvature();
}

void WidebandPlan::plan_time() {
  const double c = medium.sound_speed;
  const PulseReach reach(head.pulse, medium.absorption, c, true, cut);
  const double last = axis.start + static_cast<double>(axis.bins) * axis.step;
  const double across = 0.5 * aperture / c * 2.2 * widest;
  guard = static_cast<std::size_t>(std::ceil((across + reach.at(last)) / axis.step)) + 2;
  block = std::max<std::size_t>(384, 3 * guard);
  cycle = fast_length(block + 2 * guard);
  block = cycle - 2 * guard;
  half_band = band_of(head.pulse, tolerance);
  const double seconds = static_cast<double>(cycle) * axis.step;
  fine = fast_length(static_cast<std::size_t>(std::ceil(2 * half_band * seconds)) + 2);
  fine_step = seconds / static_cast<double>(fine);
  fine_row = (fine + 2 * kernels::lines_at_once - 1) / kernels::lines_at_once * kernels::lines_at_once + 8;

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
  period = 2 * (widest + beams) / (1 - margin);
  // The array as long as it is at the highest frequency, the ends of the pattern's transform, and room to bend.
  const double wavelengths =
      0.5 * aperture * (head.pulse.centre_frequency + 0.8 * half_band) / medium.sound_speed;
  most = static_cast<std::size_t>(std::ceil(wavelengths * period + end_decay / (pi * margin))) + most_taps;
  grid = fast_length(static_cast<std::size_t>(std::ceil(oversampling * static_cast<double>(rows()))));
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
  response.assign(rows() * fine_row, 0);
  bend.assign(fine_row, 0);
  const std::size_t elements = head.array.elements();
  const double reach = end_decay / (pi * margin), seconds = static_cast<double>(fine) * fine_step;
  constexpr int steps = 64;
  std::vector<double> ends;
  for (int j = 0; j <= static_cast<int>(reach * steps) + 2; ++j) ends.push_back(end_spectrum(j * margin / steps));
  parallel_for(fine, threads, [&](std::size_t l) {
    const double line = l <= fine / 2 ? static_cast<double>(l) : static_cast<double>(l) - static_cast<double>(fine);
    if (std::abs(line / seconds) > half_band) return;
    const double frequency = head.pulse.centre_frequency - line / seconds;
    if (frequency > 0.25 * head.pulse.centre_frequency)
      bend[l] = static_cast<float>(0.5 * pi * medium.sound_speed / frequency * widest * widest);
    for (std::size_t m = 0; m < elements; ++m) {
      const double z = period * frequency / medium.sound_speed * head.array.spacing * element_place(m, elements);
      const double weight = head.array.shading[m] / static_cast<double>(elements);
      const double first = std::max(std::ceil(z - reach), -static_cast<double>(most));
      const double last = std::min(std::floor(z + reach), static_cast<double>(most));
      const double sine = std::sin(pi * (first - z)) / pi;
      double sign = 1;
      for (double k = first; k <= last; ++k, sign = -sign) {
        const double q = k - z, at = std::abs(q) * steps, part = at - std::floor(at);
        const auto j = static_cast<std::size_t>(at);
        const double end = ends[j] + part * (ends[j + 1] - ends[j]);
        const double sinc = std::abs(q) < 1e-9 ? 1 : sign * sine / q;
        response[static_cast<std::size_t>(k + static_cast<double>(most)) * fine_row + l] +=
            static_cast<float>(weight * sinc * end);
      }
    }
  });
}

void WidebandPlan::plan_curvature() {
  // 1 - u^2 = 1 - w^2 / 2 + (w^2 / 2) x(u), x = sum_l tap_l cos(2 pi l u / period): through the nodes of Chebyshev in cos.
  const double turn = 2 * pi / period, low = std::cos(turn * widest);
  const auto wanted = [&](double cosine) {
    const double u = std::acos(std::clamp(cosine, -1.0, 1.0)) / turn;
    return 1 - 2 * u * u / (widest * widest);
  };
  for (std::size_t n = 3; n <= most_taps; ++n) {
    Eigen::MatrixXd matrix(n, n);
    Eigen::VectorXd value(n);
    for (std::size_t i = 0; i < n; ++i) {
      const double node = std::cos(pi * (static_cast<double>(i) + 0.5) / static_cast<double>(n));
      const double cosine = 0.5 * (1 + low) + 0.5 * (1 - low) * node;
      value[i] = wanted(cosine);
      for (std::size_t l = 0; l < n; ++l) matrix(i, l) = std::cos(static_cast<double>(l) * std::acos(cosine));
    }
    const Eigen::VectorXd taps = matrix.partialPivLu().solve(value);
    double error = 0;
    for (int i = 0; i <= 200; ++i) {
      const double cosine = std::cos(turn * widest * i / 200.0);
      double sum = 0;
      for (std::size_t l = 0; l < n; ++l) sum += taps[l] * std::cos(static_cast<double>(l) * std::acos(cosine));
      error = std::max(error, std::abs(sum - wanted(cosine)));
    }
    tap.assign(n, 0);
    for (std::size_t l = 0; l < n; ++l) tap[l] = static_cast<float>(l == 0 ? taps[l] : 0.5 * taps[l]);
    if (error < tolerance) break;
  }
}

int WidebandPlan::order(double curvature) const {
  const double wavelength = medium.sound_speed / head.pulse.centre_frequency;
  const double phase = pi * place_squared * curvature / wavelength;
  const double beside = phase * widest * widest, ahead = phase * 1.2 * wavelength / aperture * widest;
  double error = 1;
  for (int n = 0; n < highest_order; ++n) {
    double far = 0.03, near = 1;
    for (int j = 1; j <= n + 1; ++j) far *= beside / j, near *= ahead / j;
    error = far + near;
    if (error < 0.25 * tolerance) return n;
  }
  return highest_order;
}

}  // namespace insonify
