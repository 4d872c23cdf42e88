// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <complex>

#include "core/parallel.hpp"
#include "core/units.hpp"
#include "returns/bottom_ping_internal.hpp"
#include "returns/detect_soundings.hpp"
#include "returns/echo_shape_internal.hpp"
#include "returns/judge_soundings_internal.hpp"

namespace insonify {
namespace {

constexpr double gaussian_width = 2.354820045;  // full width at half maximum of a Gaussian
constexpr double steepest_view = 1.3;           // largest angle from the vertical of the first assumed footprint [rad]
constexpr int neighbours = 3;                   // beams on either side whose ranges give dr/du
constexpr double turn_of_width = 1.2 * half_power_of_line * pi;  // phase across a line's -3 dB width [rad]
constexpr double part_of_noise = 0.25;    // fraction of the floor below which a beam contains no receiver noise
constexpr std::size_t fewest_slopes = 5;  // fewest beams whose phases determine the phase per cosine
constexpr double reference_intensity = 2 * micropascal * micropascal;  // at 0 dB re 1 uPa rms [Pa^2]

}  // namespace

// Sound from u reaches the ends of an array steered to u_b by L |u - u_b| / 2c earlier or later: by L / 2 in range.
double BottomPing::side_lobe_reach() const {
  const double wavelength = options_.centre_frequency > 0 ? options_.sound_speed / options_.centre_frequency : 0;
  return 0.5 * half_power_of_line * wavelength / ping_.fan.beam_width;
}

void BottomPing::judge(const std::vector<BottomEcho>& echoes, BottomSoundings& soundings) const {
  judge_soundings(
      {ping_, intensity_, all_, noise_, echoes, options_.absorption_db_per_m, side_lobe_reach(), options_.threads},
      soundings);
}

Eigen::Array<double, 1, Eigen::Dynamic> BottomPing::side_lobe_floor(
    const Eigen::Array<double, 1, Eigen::Dynamic>& strongest) const {
  const auto reach = static_cast<Eigen::Index>(std::ceil(side_lobe_reach() / ping_.gate.bin_size));
  Eigen::Array<double, 1, Eigen::Dynamic> floor(strongest.size());
  for (Eigen::Index n = 0; n < floor.size(); ++n) {
    const Eigen::Index first = std::max<Eigen::Index>(0, n - reach);
    floor[n] = strongest.segment(first, std::min(floor.size() - 1, n + reach) - first + 1).maxCoeff();
  }
  return floor * power_from_db(-options_.side_lobe_margin_db);
}

BottomPing::BottomPing(const Ping& ping, const BottomOptions& options)
    : ping_(ping),
      options_(options),
      intensity_(ping.pressure.rows(), ping.pressure.cols()),
      gain_(ping.pressure.cols()) {
  const double resolution = options.range_resolution > 0 ? options.range_resolution : ping.gate.bin_size;
  pulse_deviation_ = resolution / gaussian_width;
  // The strongest of so many independent noise cells exceeds `factor` times the estimated mean with the false-alarm
  // rate. (E78)
  const double cells =
      std::max(1.0, static_cast<double>(ping.gate.bins()) * std::min(1.0, ping.gate.bin_size / resolution));
  const double rate_of_cell = -std::expm1(std::log1p(-options.false_alarm_rate) / cells);
  const double factor = background_factor(rate_of_cell, std::max(1, static_cast<int>(cells / 4)));
  for (Eigen::Index n = 0; n < gain_.size(); ++n) {
    const double r = ping.gate.centre(static_cast<std::size_t>(n));
    gain_[n] = std::pow(r, 4) * power_from_db(2 * options.absorption_db_per_m * r);
  }
  all_.setZero(intensity_.cols());
  Eigen::Array<double, 1, Eigen::Dynamic> strongest = all_;
  for (Eigen::Index b = 0; b < intensity_.rows(); ++b) {
    intensity_.row(b) = ping.pressure.row(b).cast<std::complex<double>>().abs2();
    all_ += intensity_.row(b), strongest = strongest.max(intensity_.row(b));
  }
  const double beams = std::max(1.0, static_cast<double>(intensity_.rows()));
  floor_ = side_lobe_floor(strongest).max(all_ * (options.tolerance * options.tolerance / beams));
  const double receiver = power_from_db(options.noise_floor_db) * reference_intensity;  // (E18)
  noise_.resize(ping.fan.beams());
  parallel_for(noise_.size(), options.threads, [&](std::size_t b) {
    const double* row = intensity_.row(static_cast<Eigen::Index>(b)).data();
    noise_[b] = noise_of({row, row + intensity_.cols()});
    if (noise_[b] < part_of_noise * receiver) noise_[b] = receiver;
  });
  for (std::size_t b = 0; b < ping.fan.beams(); ++b) {
    threshold_.push_back(factor * noise_[b]);
    cosine_.push_back(std::cos(ping.fan.elevation[b]) * std::sin(ping.fan.azimuth[b]));
    const Eigen::Vector3d axis =
        ping.world_from_head.linear() * unit_vector({ping.fan.azimuth[b], ping.fan.elevation[b]});
    down_.push_back(std::min(steepest_view, std::acos(std::clamp(std::abs(axis.z()), 0.0, 1.0))));
  }
}

std::size_t BottomPing::reach_of(double tangent, double cosine, double range) const {
  const double along = 0.5 * range * tangent * ping_.fan.beam_width / cosine;
  return static_cast<std::size_t>(
      std::ceil(std::max(along, 0.5 * gaussian_width * pulse_deviation_) / ping_.gate.bin_size));
}

std::vector<BottomFind> BottomPing::find(std::size_t beam) const {
  const auto bins = static_cast<std::size_t>(intensity_.cols());
  const BottomBeam view = beam_of(beam);
  const double tangent = std::tan(down_[beam]), cosine = std::cos(down_[beam]);
  std::vector<double> sum(bins + 1, 0), moment(bins + 1, 0);  // of compensated intensity before each bin
  for (std::size_t n = 0; n < bins; ++n) {
    const double here = view.compensated(n);
    sum[n + 1] = sum[n] + here;
    moment[n + 1] = moment[n] + here * static_cast<double>(n);
  }
  std::vector<char> taken(bins, 0);
  std::vector<BottomFind> found, in_lobes;
  double strongest = 0;
  while (static_cast<int>(found.size()) < options_.per_beam) {
    std::size_t best = bins;
    double most = strongest * power_from_db(options_.least_energy_db);
    for (std::size_t n = 0; n < bins; ++n) {
      if (taken[n] || !(view.intensity[n] > threshold_[beam]) || view.compensated(n) == 0) continue;
      const std::size_t reach = reach_of(tangent, cosine, ping_.gate.centre(n));
      const double energy = sum[std::min(bins, n + reach + 1)] - sum[n - std::min(n, reach)];
      if (energy > most) most = energy, best = n;
    }
    if (best == bins) break;
    // Move to the centroid of the interval: any interval that holds a short echo has the energy of the one about it.
    std::size_t reach = reach_of(tangent, cosine, ping_.gate.centre(best));
    const std::size_t begin = best - std::min(best, reach), end = std::min(bins, best + reach + 1);
    const double middle = std::clamp((moment[end] - moment[begin]) / (sum[end] - sum[begin]),
                                     static_cast<double>(begin), static_cast<double>(end - 1));
    const double range = ping_.gate.centre(0) + middle * ping_.gate.bin_size;
    const bool in_lobe =
        is_of_grating_lobe(ping_, beam, range, static_cast<double>(reach) * ping_.gate.bin_size, pulse_deviation_);
    (in_lobe ? in_lobes : found).push_back({range, most});
    strongest = std::max(strongest, most);
    reach *= 3;
    std::fill(taken.begin() + static_cast<std::ptrdiff_t>(best - std::min(best, reach)),
              taken.begin() + static_cast<std::ptrdiff_t>(std::min(bins, best + reach + 1)), 1);
  }
  if (found.empty() && !in_lobes.empty()) found.push_back(in_lobes.front());  // judged later
  return found;
}

double BottomPing::slope_at(std::size_t beam, const std::vector<std::vector<BottomFind>>& found) const {
  const auto from = beam - std::min<std::size_t>(beam, neighbours), to = std::min(found.size(), beam + neighbours + 1);
  std::vector<double> slopes;
  for (std::size_t i = from; i < to; ++i)
    for (std::size_t j = i + 1; j < to; ++j)
      if (!found[i].empty() && !found[j].empty() && cosine_[i] != cosine_[j])
        slopes.push_back((found[j].front().range - found[i].front().range) / (cosine_[j] - cosine_[i]));
  if (slopes.empty()) {  // a lone beam: as on a level bottom
    const double range = found[beam].front().range;
    return range * std::tan(down_[beam]) / std::max(0.1, std::sqrt(1 - cosine_[beam] * cosine_[beam]));
  }
  return median_of(slopes);
}

BottomEcho BottomPing::echo_at(std::size_t beam, double range, double slope, double turn) const {
  BottomEcho echo = echo_of_plane(ping_.fan, cosine_[beam], range, slope, pulse_deviation_);
  echo.phase_slope = turn / slope;
  return echo;
}

LonePlane BottomPing::lone_plane_at(double range) const { return plane_of_lone_beam(ping_, range, pulse_deviation_); }

double BottomPing::phase_per_cosine(const std::vector<std::vector<BottomFind>>& found,
                                    const std::vector<double>& slopes) const {
  std::vector<double> turns;
  for (std::size_t b = 0; b < found.size(); ++b) {
    if (found[b].empty()) continue;
    const double range = found[b].front().range;
    if (const auto of_range = phase_slope(beam_of(b), echo_at(b, range, slopes[b], 0), range))
      turns.push_back(*of_range * slopes[b]);
  }
  if (turns.size() < fewest_slopes) return turn_of_width / ping_.fan.beam_width;
  return median_of(turns);
}

BottomBeam BottomPing::beam_of(std::size_t beam) const {
  const auto row = static_cast<Eigen::Index>(beam);
  const auto bins = static_cast<std::size_t>(intensity_.cols());
  BottomBeam view{{intensity_.row(row).data(), bins},
                  {floor_.data(), bins},
                  {gain_.data(), bins},
                  {},
                  noise_[beam],
                  ping_.gate.centre(0),
                  ping_.gate.bin_size};
  if (options_.phase && ping_.split_phase.size() > 0) view.phase = {ping_.split_phase.row(row).data(), bins};
  return view;
}

float BottomPing::level_db_near(std::size_t beam, double range, double reach) const {
  const double step = ping_.gate.bin_size, last = static_cast<double>(intensity_.cols() - 1);
  const double low = std::clamp(std::floor((range - reach - ping_.gate.centre(0)) / step), 0.0, last);
  const double high = std::clamp(std::ceil((range + reach - ping_.gate.centre(0)) / step), low, last);
  const double most = intensity_.row(static_cast<Eigen::Index>(beam))
                          .segment(static_cast<Eigen::Index>(low), static_cast<Eigen::Index>(high - low) + 1)
                          .maxCoeff();
  return static_cast<float>(db_from_power(most / reference_intensity));
}

}  // namespace insonify
