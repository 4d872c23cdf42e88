// SPDX-License-Identifier: BSD-3-Clause
#include "beamforming/gridded/narrow_band_error.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <numeric>
#include <utility>

#include "beamforming/gridded/error_loops_internal.hpp"
#include "core/parallel.hpp"
#include "core/units.hpp"
#include "sonar/receive_array.hpp"

namespace insonify {
namespace {

constexpr std::size_t near_beams = 16, far_beams = 8;

}  // namespace

NarrowBandError::NarrowBandError(const SonarHead& head, double sound_speed)
    : head_(head), nodes_(spectrum_nodes(head.pulse)) {
  cycles_per_m_ = head.pulse.centre_frequency / sound_speed;
  off_focus_ = std::sqrt(3 * std::numbers::ln2 / 2) * sound_speed / (2 * pi * head.pulse.bandwidth);
  for (const Eigen::Vector3d& axis : beam_axes(head.fan)) u_beam_.push_back(axis.y());
  const auto array = receive_array(head);
  for (const Eigen::Vector3d& p : array->positions()) y_.push_back(p.y());
  shading_ = head.array.shading;
  while (y_.size() % kernels::phasor_lanes != 0) y_.push_back(0), shading_.push_back(0);
}

NarrowBandError::Sums NarrowBandError::of(const Scatterers& positions, const std::vector<double>& power,
                                          const std::vector<double>& doppler, int threads) const {
  // Some of the positions, and how many parts of the power each stands for.
  const double shares = std::max(32.0, 768.0 / static_cast<double>(std::min(u_beam_.size(), near_beams)));
  const double share = std::accumulate(power.begin(), power.end(), 0.0) / shares;
  double passed = -0.5 * share;
  std::vector<std::pair<std::size_t, double>> chosen;
  for (std::size_t i = 0; i < power.size(); ++i) {
    passed += power[i];
    if (power[i] == 0 || passed < 0) continue;
    chosen.emplace_back(i, std::floor(passed / share) + 1);
    passed -= chosen.back().second * share;
  }
  // Their errors, added in their order.
  std::vector<Sums> sums(chosen.size());
  parallel_blocks(chosen.size(), 8, threads, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const auto [i, times] = chosen[k];
      sums[k] = of_echo({positions.range[i], std::cos(positions.elevation[i]) * std::sin(positions.azimuth[i]), times,
                         head_.pulse.centre_frequency + (doppler.empty() ? 0 : doppler[i])});
    }
  });
  Sums sum;
  for (const Sums& of_position : sums) sum.error += share * of_position.error, sum.image += share * of_position.image;
  return sum;
}

// Adds all beams that have the echo in or near their main or grating lobes, and a few that stand for the rest.
NarrowBandError::Sums NarrowBandError::of_echo(const Echo& echo) const {
  struct Beam {
    double away, u;
  };
  const std::size_t beams = u_beam_.size(), near = std::min(near_beams, beams);
  const double lobes_apart = 1 / (cycles_per_m_ * head_.array.spacing);
  std::vector<Beam> beam;
  for (const double u : u_beam_) beam.push_back({std::abs(std::remainder(u - echo.u, lobes_apart)), u});
  std::ranges::sort(beam, {}, &Beam::away);
  Sums sums;
  for (std::size_t b = 0; b < near; ++b) add_beam(echo, beam[b].u, echo.times, sums);
  const std::size_t rest = beams - near, step = std::max<std::size_t>(1, rest / far_beams);
  for (std::size_t b = near + step / 2; b < beams; b += step)
    add_beam(echo, beam[b].u, echo.times * static_cast<double>(step), sums);
  return sums;
}

// Nodes of the spectrum with the focus at the echo, and nodes of the pulse's length at the carrier: both at once are
// of higher order.
void NarrowBandError::add_beam(const Echo& echo, double u_beam, double weight, Sums& sums) const {
  const double nearer = std::max(echo.range - off_focus_, 0.3 * echo.range);
  const auto [narrow, carrier, before, behind, near_cosine, far_cosine, near_sine, far_sine] =
      kernels::sum_phasors(y_.data(), shading_.data(), y_.size(),
                           {echo.range, echo.u, u_beam, nearer, echo.range + off_focus_,
                            cycles_per_m_ * echo.carrier / head_.pulse.centre_frequency, cycles_per_m_,
                            nodes_[3].frequency / echo.carrier, nodes_[4].frequency / echo.carrier});
  const std::complex<double> truth[5] = {far_cosine - far_sine, near_cosine - near_sine, carrier,
                                         near_cosine + near_sine, far_cosine + far_sine};
  const auto add_node = [&, narrow = narrow](const std::complex<double>& t, double share) {
    sums.error += weight * share * std::norm(t - narrow);
    sums.image += weight * share * std::norm(t);
  };
  for (std::size_t n = 0; n < nodes_.size(); ++n) add_node(truth[n], nodes_[n].weight - (n == 2 ? 1.0 / 3 : 0));
  add_node(before, 1.0 / 6);
  add_node(behind, 1.0 / 6);
}

}  // namespace insonify
