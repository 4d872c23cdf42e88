// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include <Eigen/Dense>

#include "beamforming/head_patterns.hpp"
#include "beamforming/true_delays/node_functions_internal.hpp"
#include "beamforming/true_delays/true_delay_loops_internal.hpp"
#include "beamforming/true_delays/true_delay_plan_internal.hpp"
#include "core/units.hpp"
#include "sonar/pulse_kind.hpp"

namespace insonify {
namespace {

using kernels::lines_at_once;

/// Others, that take twice as long: good where they are few beside other transforms.
constexpr std::size_t fair_lengths[] = {300, 480, 600, 960};

/// How much finer than needed a grid is, for a kernel of width 8 to be good to a fiftieth of the tolerance: its error
/// is exp(-8 pi sqrt(1 - 1 / oversampling)).
double oversampling_for(double tolerance) {
  const double root = std::clamp(-std::log(0.02 * tolerance) / (8 * pi), 0.4, 0.62);
  return 1 / (1 - root * root);
}

}  // namespace

double length_of(const LineArray& array) { return array.spacing * static_cast<double>(array.elements() - 1); }

double half_band_of(const Pulse& pulse, double tolerance) {
  return pulse.bandwidth * ((is_gaussian(pulse) ? 0.03 : 0) + kind_of(pulse).relative_band(pulse, tolerance));
}

TrueDelaySizes::TrueDelaySizes(const SonarHead& head, const Medium& medium, double tolerance_in, double widest_in,
                               DopplerSpan doppler_in, std::size_t block_bins)
    : tolerance(tolerance_in),
      widest(widest_in),
      doppler(doppler_in),
      axis(head.gate, medium.sound_speed),
      cut(pulse_cut(tolerance_in)),
      aperture(length_of(head.array)),
      reach(PulseReach(head.pulse, medium.absorption, medium.sound_speed, true, cut)
                .at(2 * head.gate.max_range / medium.sound_speed)) {
  for (const double u : beam_cosines(head.fan)) widest = std::max(widest, std::abs(u));
  const double across = 0.5 * aperture / medium.sound_speed * 2.1 * widest;
  guard = static_cast<std::size_t>(std::ceil((across + reach) / axis.step)) + 2;
  half_band = half_band_of(head.pulse, tolerance) + doppler.most;
  // Take the cycle that holds the block with the fewest samples for its bins.
  const auto fine_of = [this](std::size_t bins) {
    const double lines = 2 * half_band * static_cast<double>(bins) * axis.step;
    std::size_t length = fft_length(static_cast<std::size_t>(std::ceil(lines)) + 2);
    while (length % (2 * lines_at_once) != 0) length = fft_length(length + 1);  // no chunk holds both ends
    return length;
  };
  cycle = fft_length(block_bins + 2 * guard);
  fine = fine_of(cycle);
  for (const std::size_t other : fair_lengths)
    if (other >= block_bins + 2 * guard && other < cycle &&
        (fine_of(other) + other) * (cycle - 2 * guard) < (fine + cycle) * (other - 2 * guard)) {
      cycle = other;
      fine = fine_of(other);
    }
  block = cycle - 2 * guard;
  fine_step = static_cast<double>(cycle) * axis.step / static_cast<double>(fine);
  fine_row = fine + 8;

  // A period that the kernel between harmonics needs, and the array as long as it is at the highest frequency.
  const double finer = oversampling_for(tolerance);
  // Curved wavefronts come to the ends of a long array from other directions.
  const double curved = aperture > 0 ? 0.65 * aperture / std::max(3 * aperture, head.gate.min_range) : 0;
  period = 2.02 * std::max(widest, curved) * finer;
  const double wavelengths = 0.5 * aperture * (head.pulse.centre_frequency + 0.8 * half_band) / medium.sound_speed;
  most = static_cast<std::size_t>(std::ceil(wavelengths * period + 0.5 * static_cast<double>(kernel_width))) + 1;
  grid =
      fft_length(std::max<std::size_t>(64, static_cast<std::size_t>(std::ceil(finer * static_cast<double>(rows())))));
  grid_stride = grid + 16;
  const double shift =
      0.5 * period * aperture / medium.sound_speed / seconds() * static_cast<double>(lines_at_once - 1);
  taps = kernel_width + static_cast<std::size_t>(std::ceil(shift));
}

TrueDelayPlan::TrueDelayPlan(const SonarHead& head_in, const Medium& medium_in, double tolerance_in, double widest_in,
                             DopplerSpan doppler_in, std::size_t block_bins)
    : TrueDelaySizes(head_in, medium_in, tolerance_in, widest_in, doppler_in, block_bins),
      head(head_in),
      medium(medium_in),
      shapes(head.pulse, medium),
      u_beam(beam_cosines(head.fan)),
      kernel(kernel_width, oversampling_for(tolerance)),
      columns(kernel.pieces<float>(1e-7)) {
  for (std::size_t m = 0; m < head.array.elements(); ++m)
    y.push_back(head.array.spacing * element_position(m, head.array.elements()));
  if (is_gaussian(head.pulse)) spectral_width2 = echo_envelope(head.pulse, {}, 0).a;
  plan_directions();
  plan_elements();
  plan_band();
}

void TrueDelayPlan::plan_directions() {
  const auto half_width = 0.5 * static_cast<double>(kernel.width());
  // The trapezoidal rule in s, x = (w / 2) sin(s), as the kernel's transform has it.
  constexpr int steps = 24;
  for (int k = 0; k < steps; ++k) {
    const double s = 0.5 * pi * k / steps;
    node_.push_back(half_width * std::sin(s));
    node_weight_.push_back((k == 0 ? 1 : 2) * half_width * 0.5 * pi / steps * kernel.at(node_.back()) * std::cos(s));
  }
  const auto factor = [this](double frequency) { return 1 / kernel_transform(frequency); };
  for (std::size_t g = 0; g < grid; ++g)
    position_factor.push_back(factor(static_cast<double>(g) / static_cast<double>(grid) - 0.5));
  for (const double u : u_beam) {
    const double first = std::ceil(column_of(u) - half_width);
    for (std::size_t k = 0; k < kernel.width(); ++k) {
      beam_weight.push_back(static_cast<float>(kernel.at(first + static_cast<double>(k) - column_of(u))));
      beam_row.push_back(static_cast<std::uint32_t>(first) + static_cast<std::uint32_t>(k));
    }
  }
}

std::array<std::complex<double>, TrueDelayPlan::moments> TrueDelayPlan::kernel_moments(double frequency) const {
  std::array<std::complex<double>, moments> result = {};
  for (std::size_t k = 0; k < node_.size(); ++k) {
    const double turn = 2 * pi * frequency * node_[k];
    const std::complex<double> both[2] = {node_weight_[k] * std::cos(turn), {0, -node_weight_[k] * std::sin(turn)}};
    double power = 1;
    for (std::size_t j = 0; j < moments; ++j, power *= node_[k]) result[j] += power * both[j % 2];
  }
  return result;
}

double TrueDelayPlan::kernel_transform(double frequency) const {
  double result = 0;
  for (std::size_t k = 0; k < node_.size(); ++k) result += node_weight_[k] * std::cos(2 * pi * frequency * node_[k]);
  return result;
}

void TrueDelayPlan::plan_elements() {
  const std::size_t width = kernel.width(), n = elements();
  const double c = medium.sound_speed, top = half_band * seconds(), half_width = 0.5 * static_cast<double>(width);
  for (std::size_t chunk = 0; chunk < fine / lines_at_once; ++chunk) {
    const double first = line_of(chunk * lines_at_once), last = line_of(chunk * lines_at_once + lines_at_once - 1);
    if (std::min(std::abs(first), std::abs(last)) <= top) chunks.push_back(chunk);
  }
  tap_row.assign(chunks.size() * n, 0);
  tap_weight.assign(chunks.size() * n * taps * lines_at_once, 0);
  element_weight.assign(chunks.size() * n * lines_at_once, 0);
  // Find the factors that undo the kernel on the grid, at 32nds of harmonics.
  std::vector<double> undo;
  for (std::size_t k = 0; k <= 32 * most + 32; ++k)
    undo.push_back(1 / kernel_transform(static_cast<double>(k) / 32 / static_cast<double>(grid)));
  for (std::size_t i = 0; i < chunks.size(); ++i)
    for (std::size_t m = 0; m < n; ++m) {
      std::array<double, lines_at_once> position;
      for (std::size_t l = 0; l < lines_at_once; ++l) {
        const double frequency = head.pulse.centre_frequency - line_of(chunks[i] * lines_at_once + l) / seconds();
        position[l] = period * frequency / c * y[m] + static_cast<double>(most);
      }
      const double base = std::ceil(*std::min_element(position.begin(), position.end()) - half_width);
      if (base < 0 || base + static_cast<double>(taps) > static_cast<double>(rows())) continue;
      tap_row[i * n + m] = static_cast<std::uint32_t>(base);
      for (std::size_t l = 0; l < lines_at_once; ++l) {
        if (std::abs(line_of(chunks[i] * lines_at_once + l)) > top) continue;
        const double low = position[l] - half_width, first = std::ceil(low);
        const auto t = static_cast<float>(2 * (first - low) - 1);
        std::array<float, 8> value = {};
        for (std::size_t p = 0; p <= columns.degree; ++p)
          for (std::size_t k = 0; k < 8; ++k) value[k] = value[k] * t + columns.coefficient[p * columns.lanes + k];
        const auto skipped = static_cast<std::size_t>(first - base);
        for (std::size_t k = 0; k < width && skipped + k < taps; ++k)
          tap_weight[((i * n + m) * taps + skipped + k) * lines_at_once + l] = value[k];
        const double at = 32 * std::abs(position[l] - static_cast<double>(most)), share = at - std::floor(at);
        const double* here = undo.data() + static_cast<std::size_t>(at);
        element_weight[(i * n + m) * lines_at_once + l] = static_cast<float>(
            std::pow(here[0] + share * (here[1] - here[0]), 2) * head.array.shading[m] / static_cast<double>(n * fine));
      }
    }
}

void TrueDelayPlan::plan_band() {
  const auto most_of = static_cast<Eigen::Index>(most_powers);
  const auto weights = [this](const Eigen::VectorXd& x) -> Eigen::VectorXd {
    const Eigen::ArrayXd beside = (x.array().abs() - doppler.most / half_band).max(0);  // the largest shift
    const Eigen::VectorXd weight =
        (-spectral_width2 * half_band * half_band * beside.square()).exp() * (1 - x.array().square()).pow(0.25);
    return weight / weight.norm();
  };
  digits = -std::log10(tolerance);
  // Where the band reaches near zero, rows of harmonics move faster along the array.
  const double low = std::clamp(24 * (half_band / head.pulse.centre_frequency - 0.6), 0.0, 16.0);
  const Eigen::VectorXd nodes = chebyshev_points(
                            static_cast<std::size_t>(std::ceil(std::max(7.0, 6 + 1.6 * digits) + low))),
                        at_nodes = weights(nodes);
  const Eigen::VectorXd fit = chebyshev_points(fit_nodes), at_fit = weights(fit);
  for (const double x : nodes) node_frequency.push_back(half_band * x);
  for (const double x : fit) fit_frequency.push_back(half_band * x);
  node_weight.assign(at_nodes.begin(), at_nodes.end());
  fit_weight.assign(at_fit.begin(), at_fit.end());
  // Orthonormal by weight; and the same polynomials at lines.
  const Eigen::MatrixXd weighted = at_fit.asDiagonal() * chebyshev_polynomials(fit, most_of);
  const Eigen::MatrixXd root = weighted.householderQr().matrixQR().topRows(most_of);
  const auto orthonormal = [&](const Eigen::VectorXd& at) -> Eigen::MatrixXd {
    return root.triangularView<Eigen::Upper>().solve<Eigen::OnTheRight>(chebyshev_polynomials(at, most_of));
  };
  const Eigen::MatrixXd powers = orthonormal(fit);
  for (Eigen::Index j = 0; j < fit.size(); ++j)
    for (Eigen::Index s = 0; s < most_of; ++s) fit_power.push_back(powers(j, s));
  for (const std::size_t chunk : chunks) {
    Eigen::VectorXd lines(lines_at_once);
    for (std::size_t l = 0; l < lines_at_once; ++l)
      lines[static_cast<Eigen::Index>(l)] =
          std::clamp(line_of(chunk * lines_at_once + l) / (seconds() * half_band), -1.0, 1.0);
    const Eigen::MatrixXd at_lines = orthonormal(lines);
    for (Eigen::Index s = 0; s < most_of; ++s)
      for (Eigen::Index l = 0; l < at_lines.rows(); ++l) line_power.push_back(static_cast<float>(at_lines(l, s)));
  }
}

}  // namespace insonify
