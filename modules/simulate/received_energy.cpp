// SPDX-License-Identifier: BSD-3-Clause
// The squared pattern of N elements is that of 2N - 1, shaded by the autocorrelation R of the shading. Over all beams:
//   sum_b B_b(u)^2 = R_0 beams + 2 Re sum_m R_m exp(i k d m u) sum_b exp(-i k d m u_b)
// The mean over u +- w has each term times sin(k d m w) / (k d m w).
#include "simulate/received_energy.hpp"

#include <algorithm>
#include <cmath>
#include <complex>

#include "core/units.hpp"
#include "simulate/energy_loops_internal.hpp"
#include "sonar/pulse_kind.hpp"
#include "sonar/receive_array.hpp"

namespace insonify {
namespace {

using complex = std::complex<double>;

constexpr std::size_t lanes = kernels::energy_lanes;  // beams or entries that are treated side by side

/// Products R_m sum_b exp(-i k d m u_b), m = 0 .. N-1, those of m > 0 twice.
struct BeamTerms {
  std::vector<double> re, im;

  BeamTerms(const SonarHead& head, double step) {
    const std::vector<double> pairs = lag_sums(head.array);
    const std::size_t n = pairs.size(), beams = head.fan.beams();
    re.assign(n, 0), im.assign(n, 0);
    for (std::size_t first = 0; first < beams; first += lanes) {
      kernels::Turns turns{};
      const std::size_t number = std::min(lanes, beams - first);
      for (std::size_t l = 0; l < number; ++l) {
        const std::size_t b = first + l;
        const complex turn = std::polar(1.0, -step * std::cos(head.fan.elevation[b]) * std::sin(head.fan.azimuth[b]));
        turns.re[l] = turn.real(), turns.im[l] = turn.imag();
      }
      kernels::add_powers(turns, number, n, re.data(), im.data());
    }
    for (std::size_t m = 0; m < n; ++m) scale(m, (m > 0 ? 2 : 1) * pairs[m] / static_cast<double>(n * n));
  }
  void scale(std::size_t m, double factor) { re[m] *= factor, im[m] *= factor; }
};

/// Squared responses of all rows, added up over v from -1 to 1.
std::vector<double> sum_over_rows(const SonarHead& head, double wavelength, const std::vector<FanRow>& rows) {
  constexpr double entries_per_lobe = 32;
  const double lobes = head.column
                           ? 2 * head.column->spacing / wavelength * static_cast<double>(head.column->elements())
                           : 2 / std::max(head.fan.elevation_width, 1e-3);
  std::vector<double> sums(static_cast<std::size_t>(std::clamp(entries_per_lobe * lobes, 256.0, 65536.0)) + 2, 0);
  for (const FanRow& row : rows) {
    RowResponse response(head, wavelength, row.elevation);
    for (std::size_t k = 0; k < sums.size(); ++k)
      sums[k] += std::pow(response.at(2 * static_cast<double>(k) / static_cast<double>(sums.size() - 1) - 1), 2);
  }
  return sums;
}

/// Value at x of a table over x from -1 to 1.
double between_entries(const std::vector<double>& table, double x) {
  const double position = 0.5 * (std::clamp(x, -1.0, 1.0) + 1) * static_cast<double>(table.size() - 1);
  const std::size_t left = std::min(static_cast<std::size_t>(position), table.size() - 2);
  return std::lerp(table[left], table[left + 1], position - static_cast<double>(left));
}

}  // namespace

ReceivedEnergy::ReceivedEnergy(const SonarHead& head, double wavelength, double half_width, bool over_band) {
  const double step = 2 * pi * head.array.spacing / wavelength;
  std::size_t entries = 8 * head.array.elements();
  if (half_width > 0) entries = std::min(entries, static_cast<std::size_t>(8 / half_width));
  table_.assign(entries + 2, 0);
  if (over_band)
    for (const SpectrumNode& node : spectrum_nodes(head.pulse))
      add_frequency(head, step * std::max(0.1, 1 + node.frequency / head.pulse.centre_frequency), half_width,
                    node.weight);
  else
    add_frequency(head, step, half_width, 1);
  const std::vector<FanRow> rows = fan_rows(head.fan);
  for (double& entry : table_) entry /= static_cast<double>(rows.size());
  if (rows.size() > 1 || head.column) rows_ = sum_over_rows(head, wavelength, rows);
}

void ReceivedEnergy::add_frequency(const SonarHead& head, double step, double half_width, double share) {
  if (const auto array = receive_array(head); !array->line())
    return add_responses(*array, head.fan, 2 * pi * head.array.spacing / step, half_width, share);
  BeamTerms terms(head, step);
  if (half_width > 0)
    for (std::size_t m = 1; m < terms.re.size(); ++m) {
      const double x = step * half_width * static_cast<double>(m);
      terms.scale(m, std::sin(x) / x);
    }
  for (std::size_t begin = 0; begin < table_.size(); begin += lanes) {
    kernels::Turns turns;
    for (std::size_t l = 0; l < lanes; ++l) {
      const double u = 2 * static_cast<double>(begin + l) / static_cast<double>(table_.size() - 1) - 1;
      turns.re[l] = std::cos(step * u), turns.im[l] = std::sin(step * u);
    }
    double sum[lanes];
    kernels::sum_powers(turns, terms.re.data(), terms.im.data(), terms.re.size(), sum);
    for (std::size_t l = 0; l < std::min(lanes, table_.size() - begin); ++l)
      table_[begin + l] += share * std::max(0.0, sum[l]);
  }
}

void ReceivedEnergy::add_responses(const ReceiveArray& array, const BeamFan& fan, double wavelength, double half_width,
                                   double share) {
  const std::vector<Eigen::Vector3d> axes = beam_axes(fan);
  const double weights[] = {1.0 / 6, 4.0 / 6, 1.0 / 6};  // Simpson's rule over u +- half_width
  for (std::size_t k = 0; k < table_.size(); ++k)
    for (int j = half_width > 0 ? 0 : 1; j < (half_width > 0 ? 3 : 2); ++j) {
      const double u = 2 * static_cast<double>(k) / static_cast<double>(table_.size() - 1) - 1 + (j - 1) * half_width;
      const Eigen::Vector3d from = ahead(std::clamp(u, -1.0, 1.0), axes[0].z());
      for (const Eigen::Vector3d& axis : axes)
        table_[k] += share * (half_width > 0 ? weights[j] : 1) * std::norm(array.response(from, axis, wavelength));
    }
}

double ReceivedEnergy::along_array(double u) const { return between_entries(table_, u); }

double ReceivedEnergy::at(double u, double v) const {
  return along_array(u) * (rows_.empty() ? 1 : between_entries(rows_, v));
}

}  // namespace insonify
