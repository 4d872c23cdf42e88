#include "returns/bottom_detection.hpp"

#include <algorithm>
#include <cmath>
#include <complex>

#include "acoustics/shoot_ray.hpp"
#include "core/error.hpp"
#include "core/parallel.hpp"
#include "core/require.hpp"
#include "core/units.hpp"
#include "returns/bottom_fits_internal.hpp"
#include "returns/detect_soundings.hpp"
#include "returns/judge_soundings_internal.hpp"

namespace insonify {
namespace {

constexpr const char* bottom_call = "detect_bottom";
constexpr double gaussian_width = 2.354820045;  // full width at half maximum of a Gaussian
constexpr double steepest_view = 1.3;           // [rad] from the vertical, of the footprint that is assumed at first
constexpr int neighbours = 3;                   // beams on either side whose ranges give dr/du
constexpr double half_power_of_line = 0.8859;   // length of a uniform line in wavelengths times its -3 dB width [rad]
constexpr double turn_of_width = 1.2 * half_power_of_line * pi;  // of the phase across a line's -3 dB width [rad]
constexpr std::size_t fewest_slopes = 5;                         // beams whose phases say how it turns in this ping
constexpr double reference_intensity = 2 * micropascal * micropascal;  // at 0 dB re 1 uPa rms [Pa^2]

/// A found echo of a beam.
struct BottomFind {
  double range = 0, energy = 0;
};

/// All beams of a ping, prepared for detection.
class BottomPing {
 public:
  BottomPing(const Ping& ping, const BottomOptions& options);

  /// Echoes of a beam by falling energy; at most options.per_beam.
  std::vector<BottomFind> find(std::size_t beam) const;
  /// dr/du about a beam from the first echoes of its neighbours [m].
  double slope_at(std::size_t beam, const std::vector<std::vector<BottomFind>>& found) const;
  BottomEcho echo_at(std::size_t beam, double range, double slope, double turn) const;
  /// Phase between the halves per direction cosine [rad], by the median of all beams.
  double phase_per_cosine(const std::vector<std::vector<BottomFind>>& found) const;
  BottomBeam beam_of(std::size_t beam) const;
  float level_db_near(std::size_t beam, double range, double reach) const;
  void judge(const std::vector<BottomEcho>& echoes, BottomSoundings& soundings) const;

 private:
  std::size_t reach_of(std::size_t beam, double range) const;
  /// Intensity at each range below which a sample is a side lobe.
  Eigen::Array<double, 1, Eigen::Dynamic> side_lobe_floor() const;
  /// How far in range side lobes stand from their echo [m].
  double side_lobe_reach() const;

  const Ping& ping_;
  const BottomOptions& options_;
  Grid<double> intensity_, compensated_;
  std::vector<double> noise_, threshold_, cosine_, down_;
  double pulse_deviation_ = 0;
};

// Sound from u reaches the ends of an array steered to u_b by L |u - u_b| / 2c earlier and later: by L / 2 in range.
double BottomPing::side_lobe_reach() const {
  const double wavelength = options_.centre_frequency > 0 ? options_.sound_speed / options_.centre_frequency : 0;
  return 0.5 * half_power_of_line * wavelength / ping_.fan.beam_width;
}

void BottomPing::judge(const std::vector<BottomEcho>& echoes, BottomSoundings& soundings) const {
  judge_soundings(
      {ping_, intensity_, noise_, echoes, options_.absorption_db_per_m, side_lobe_reach(), options_.threads},
      soundings);
}

Eigen::Array<double, 1, Eigen::Dynamic> BottomPing::side_lobe_floor() const {
  Eigen::Array<double, 1, Eigen::Dynamic> strongest = intensity_.row(0);
  for (Eigen::Index b = 1; b < intensity_.rows(); ++b) strongest = strongest.max(intensity_.row(b));
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
      intensity_(ping.pressure.cast<std::complex<double>>().abs2()),
      compensated_(intensity_.rows(), intensity_.cols()) {
  const double resolution = options.range_resolution > 0 ? options.range_resolution : ping.gate.bin_size;
  pulse_deviation_ = resolution / gaussian_width;
  // Of so many independent cells of noise the strongest exceeds this, above the estimate of their mean, with the
  // false-alarm rate. (E78)
  const double cells =
      std::max(1.0, static_cast<double>(ping.gate.bins()) * std::min(1.0, ping.gate.bin_size / resolution));
  const double rate_of_cell = -std::expm1(std::log1p(-options.false_alarm_rate) / cells);
  const double factor = background_factor(rate_of_cell, std::max(1, static_cast<int>(cells / 4)));
  Eigen::ArrayXd gain(intensity_.cols());
  for (Eigen::Index n = 0; n < gain.size(); ++n) {
    const double r = ping.gate.centre(static_cast<std::size_t>(n));
    gain[n] = std::pow(r, 4) * power_from_db(2 * options.absorption_db_per_m * r);
  }
  const Eigen::Array<double, 1, Eigen::Dynamic> floor = side_lobe_floor();
  for (std::size_t b = 0; b < ping.fan.beams(); ++b) {
    const auto row = static_cast<Eigen::Index>(b);
    noise_.push_back(noise_of({intensity_.row(row).begin(), intensity_.row(row).end()}));
    threshold_.push_back(factor * noise_.back());
    compensated_.row(row) =
        (intensity_.row(row) > floor).select((intensity_.row(row) - noise_.back()) * gain.transpose(), 0.0);
    cosine_.push_back(std::cos(ping.fan.elevation[b]) * std::sin(ping.fan.azimuth[b]));
    const Eigen::Vector3d axis =
        ping.world_from_head.linear() * unit_vector({ping.fan.azimuth[b], ping.fan.elevation[b]});
    down_.push_back(std::min(steepest_view, std::acos(std::clamp(std::abs(axis.z()), 0.0, 1.0))));
  }
}

/// Half the footprint on a level bottom [bins], at least a pulse.
std::size_t BottomPing::reach_of(std::size_t beam, double range) const {
  const double along = 0.5 * range * std::tan(down_[beam]) * ping_.fan.beam_width / std::cos(down_[beam]);
  return static_cast<std::size_t>(
      std::ceil(std::max(along, 0.5 * gaussian_width * pulse_deviation_) / ping_.gate.bin_size));
}

std::vector<BottomFind> BottomPing::find(std::size_t beam) const {
  const auto row = static_cast<Eigen::Index>(beam);
  const auto bins = static_cast<std::size_t>(intensity_.cols());
  std::vector<double> sum(bins + 1, 0), moment(bins + 1, 0);  // of compensated intensities before a bin
  for (std::size_t n = 0; n < bins; ++n) {
    const double here = compensated_(row, static_cast<Eigen::Index>(n));
    sum[n + 1] = sum[n] + here;
    moment[n + 1] = moment[n] + here * static_cast<double>(n);
  }
  std::vector<char> taken(bins, 0);
  std::vector<BottomFind> found;
  while (static_cast<int>(found.size()) < options_.per_beam) {
    std::size_t best = bins;
    double most = found.empty() ? 0 : found.front().energy * power_from_db(options_.least_energy_db);
    for (std::size_t n = 0; n < bins; ++n) {
      const auto at = static_cast<Eigen::Index>(n);
      if (taken[n] || !(intensity_(row, at) > threshold_[beam]) || compensated_(row, at) == 0) continue;
      const std::size_t reach = reach_of(beam, ping_.gate.centre(n));
      const double energy = sum[std::min(bins, n + reach + 1)] - sum[n - std::min(n, reach)];
      if (energy > most) most = energy, best = n;
    }
    if (best == bins) break;
    // Where in the interval most energy is: any that holds a short echo has as much as the one about it.
    const std::size_t reach = reach_of(beam, ping_.gate.centre(best));
    const std::size_t begin = best - std::min(best, reach), end = std::min(bins, best + reach + 1);
    const double middle = std::clamp((moment[end] - moment[begin]) / (sum[end] - sum[begin]),
                                     static_cast<double>(begin), static_cast<double>(end - 1));
    found.push_back({ping_.gate.centre(0) + middle * ping_.gate.bin_size, most});
    for (std::size_t n = best - std::min(best, 3 * reach); n < std::min(bins, best + 3 * reach + 1); ++n) taken[n] = 1;
  }
  return found;
}

double BottomPing::slope_at(std::size_t beam, const std::vector<std::vector<BottomFind>>& found) const {
  const auto from = beam - std::min<std::size_t>(beam, neighbours), to = std::min(found.size(), beam + neighbours + 1);
  std::vector<double> slopes;
  for (std::size_t i = from; i < to; ++i)
    for (std::size_t j = i + 1; j < to; ++j)
      if (!found[i].empty() && !found[j].empty() && cosine_[i] != cosine_[j])
        slopes.push_back((found[j].front().range - found[i].front().range) / (cosine_[j] - cosine_[i]));
  if (slopes.empty()) {  // on its own: as of a level bottom
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

double BottomPing::phase_per_cosine(const std::vector<std::vector<BottomFind>>& found) const {
  std::vector<double> turns;
  for (std::size_t b = 0; b < found.size(); ++b) {
    if (found[b].empty()) continue;
    const double range = found[b].front().range, slope = slope_at(b, found);
    if (const auto of_range = phase_slope(beam_of(b), echo_at(b, range, slope, 0), range))
      turns.push_back(*of_range * slope);
  }
  if (turns.size() < fewest_slopes) return turn_of_width / ping_.fan.beam_width;
  return median_of(turns);
}

BottomBeam BottomPing::beam_of(std::size_t beam) const {
  const auto row = static_cast<Eigen::Index>(beam);
  const auto bins = static_cast<std::size_t>(intensity_.cols());
  BottomBeam view{{intensity_.row(row).data(), bins},
                  {compensated_.row(row).data(), bins},
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

/// The place of a sounding in the world.
Eigen::Vector3d place_of(const Ping& ping, const BottomOptions& options, std::size_t beam, double range) {
  const Eigen::Vector3d axis = unit_vector({ping.fan.azimuth[beam], ping.fan.elevation[beam]});
  if (!options.profile) return ping.world_from_head * (range * axis);
  const Eigen::Vector3d away = ping.world_from_head.linear() * axis;
  const RayEnd end = shoot_ray(*options.profile, options.head_depth, std::asin(std::clamp(away.z(), -1.0, 1.0)),
                               range / options.sound_speed);
  const double level = std::hypot(away.x(), away.y());
  const Eigen::Vector3d head = ping.world_from_head.translation();
  const Eigen::Vector2d ahead = level > 0 ? Eigen::Vector2d(away.head<2>() / level) : Eigen::Vector2d(0, 0);
  return {head.x() + end.horizontal * ahead.x(), head.y() + end.horizontal * ahead.y(),
          head.z() - (end.depth - options.head_depth)};
}

void require_bottom_options(const Ping& ping, const BottomOptions& o) {
  require(o.false_alarm_rate > 0 && o.false_alarm_rate < 1, bottom_call, "false_alarm_rate", o.false_alarm_rate, "",
          "above 0 and below 1");
  require(o.per_beam >= 1, bottom_call, "per_beam", o.per_beam, "", ">= 1");
  require(o.sound_speed > 0, bottom_call, "sound_speed", o.sound_speed, "m/s", "> 0");
  require(o.range_resolution >= 0, bottom_call, "range_resolution", o.range_resolution, "m", ">= 0");
  if (o.profile) require_valid(*o.profile, bottom_call);
  if (ping.split_phase.size() > 0 &&
      (ping.split_phase.rows() != ping.pressure.rows() || ping.split_phase.cols() != ping.pressure.cols()))
    fail(ErrorKind::argument, bottom_call, ": split_phase has ", ping.split_phase.rows(), " x ",
         ping.split_phase.cols(), " cells, must have one for each of the pressure");
  if (ping.expected_level)
    fail(ErrorKind::argument, bottom_call, ": ping ", ping.number,
         " is an expected level, without the samples of an echo; ", "simulate it with another method");
}

}  // namespace

BottomSoundings detect_bottom(const Ping& ping, const BottomOptions& options) {
  require_bottom_options(ping, options);
  const BottomPing prepared(ping, options);
  const std::size_t beams = ping.fan.beams();

  // Where the echoes are, refined by their centres of gravity on a level bottom.
  std::vector<std::vector<BottomFind>> found(beams);
  parallel_for(beams, options.threads, [&](std::size_t b) { found[b] = prepared.find(b); });

  // How the bottom slopes in each beam, and with it the better of both methods.
  struct Sounding {
    BottomEstimate best;
    BottomMethod method;
    float level_db;
    BottomEcho echo;
  };
  std::vector<std::vector<Sounding>> soundings(beams);
  const double turn = prepared.phase_per_cosine(found);
  parallel_for(beams, options.threads, [&](std::size_t b) {
    if (found[b].empty()) return;
    const double slope = prepared.slope_at(b, found);
    const BottomBeam beam = prepared.beam_of(b);
    for (const BottomFind& find : found[b]) {
      const BottomEcho echo = prepared.echo_at(b, find.range, slope, turn);
      const BottomEstimate amplitude = centre_of_gravity(beam, echo, find.range);
      const BottomEstimate phase = zero_crossing(
          beam, echo, std::isfinite(amplitude.deviation) ? amplitude.range + echo.lengthening : find.range);
      const bool by_phase = phase.deviation < amplitude.deviation;
      BottomEstimate best = by_phase ? phase : amplitude;
      const double cell = std::max(echo.half_power_reach, ping.gate.bin_size);
      if (!std::isfinite(best.deviation) || !(best.range > ping.gate.min_range)) best = {find.range, cell};
      const auto met = [&](const Sounding& s) { return std::abs(s.best.range - best.range) < cell; };
      if (std::any_of(soundings[b].begin(), soundings[b].end(), met)) continue;  // both fits are of one echo
      soundings[b].push_back({best, by_phase ? BottomMethod::phase : BottomMethod::amplitude,
                              prepared.level_db_near(b, best.range, echo.half_power_reach), echo});
    }
  });
  BottomSoundings all;
  std::vector<BottomEcho> echoes;
  for (std::size_t b = 0; b < beams; ++b)
    for (const Sounding& s : soundings[b]) {
      all.position.push_back(place_of(ping, options, b, s.best.range));
      all.range.push_back(s.best.range);
      all.deviation.push_back(static_cast<float>(s.best.deviation));
      all.quality.push_back(static_cast<float>(std::log10(s.best.range / s.best.deviation)));
      all.level_db.push_back(s.level_db);
      all.method.push_back(s.method);
      all.beam.push_back(static_cast<std::uint32_t>(b));
      echoes.push_back(s.echo);
    }
  prepared.judge(echoes, all);
  return all;
}

}  // namespace insonify
