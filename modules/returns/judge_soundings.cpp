// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <optional>

#include "core/parallel.hpp"
#include "core/units.hpp"
#include "returns/echo_shape_internal.hpp"

namespace insonify {
namespace {

constexpr double side_lobe_sum_db = 22;  // below the sum of all other bearings, in beams as wide as a main lobe
constexpr double main_lobe = 1.5;        // half a main lobe with its skirts, in beam widths
constexpr double faint_db = 18;          // level below the louder quarter of the bottom around
constexpr double bottom_about = pi / 6;  // angle around on either side [rad]
constexpr double skirt_margin_db = 8;    // below the level that a louder beam's main lobe brings into this one
constexpr double partly_skirt_db = 2;    // from here on a sounding may lie off its beam, towards the louder one
constexpr double skirt_reach = 3;        // beam widths on either side
constexpr double lone_margin_db = 10;    // above the limits of side lobes and noise, for a sounding without neighbours
constexpr double lone_noise_db = 20;
constexpr double reference_of_levels = 2 * micropascal * micropascal;  // intensity at 0 dB re 1 uPa rms [Pa^2]
constexpr double steepest = 4;               // largest dr / (r dtheta) of one surface: 76 degrees
constexpr std::size_t witnesses = 2;         // neighbours that confirm a sounding
constexpr double median_of_normal = 1.4826;  // standard deviations in a median absolute deviation
constexpr double own_part = 0.5;             // fraction of the largest step beside it that counts as deviation
constexpr double sure_of_relief = 2.5;       // variances that may come from errors alone

/// Distance of a sounding from the plane of its neighbours [m], and the variance that errors alone give it [m^2].
struct Curvature {
  double off, expected;
};

/// Contribution of a neighbouring beam's main lobe to a sounding: fraction of its intensity, angle between them [rad].
struct Skirt {
  double share = 0, away = 0;
};

class Judge {
 public:
  Judge(const JudgedPing& judged, const BottomSoundings& soundings);

  /// Returns the largest contribution of a neighbouring beam to a sounding.
  Skirt skirt_at(std::size_t i) const;
  std::uint8_t reject(std::size_t i, const Skirt& skirt) const;
  /// Finds the residuals of all soundings that are kept, for relief_variance.
  void find_curvatures();
  /// Returns the variance that the relief of the bottom adds to the range of a sounding [m^2].
  double relief_variance(std::size_t i, const Skirt& skirt) const;

 private:
  double strongest(std::size_t beam, Bins bins) const;
  double side_lobes_at(std::size_t i) const;
  bool is_faint(std::size_t i) const;
  bool is_confirmed(std::size_t i) const;
  /// Returns the sounding of a beam with most energy; nothing for a beam without soundings.
  std::optional<std::size_t> sounding_of(std::ptrdiff_t beam) const;
  std::optional<Curvature> curvature_at(std::ptrdiff_t beam) const;
  const std::optional<Curvature>& curvature_of(std::ptrdiff_t beam) const {
    static const std::optional<Curvature> none;
    return beam >= 0 && beam < static_cast<std::ptrdiff_t>(curvatures_.size())
               ? curvatures_[static_cast<std::size_t>(beam)]
               : none;
  }

  const JudgedPing& judged_;
  const BottomSoundings& soundings_;
  std::vector<std::ptrdiff_t> first_;  ///< first sounding of each beam; -1: none
  std::vector<float> own_;             ///< deviations predicted from the echoes [m]
  std::vector<double> sine_, angle_;   ///< direction cosine and angle of each beam in the plane of the fan
  std::vector<std::optional<Curvature>> curvatures_;  ///< one per beam
  std::vector<double> loudness_db_;                   ///< level of each sounding, compensated for its range
  std::ptrdiff_t lag_ = 1;                            ///< number of beams in a beam's width
  std::ptrdiff_t relief_lag_ = 1;  ///< beams in the longer side of a footprint, at most a sixteenth of all
  double share_ = 1;               ///< distance between two beams, in beam widths
};

Judge::Judge(const JudgedPing& judged, const BottomSoundings& soundings)
    : judged_(judged), soundings_(soundings), first_(judged.ping.fan.beams(), -1), own_(soundings.deviation) {
  const BeamFan& fan = judged.ping.fan;
  for (std::size_t i = soundings.size(); i-- > 0;) first_[soundings.beam[i]] = static_cast<std::ptrdiff_t>(i);
  for (std::size_t b = 0; b < fan.beams(); ++b)
    sine_.push_back(std::cos(fan.elevation[b]) * std::sin(fan.azimuth[b])), angle_.push_back(std::asin(sine_[b]));
  if (fan.beams() > 1) {
    share_ = std::abs(sine_.back() - sine_.front()) / static_cast<double>(fan.beams() - 1) / fan.beam_width;
    lag_ = std::clamp<std::ptrdiff_t>(std::llround(1 / std::max(share_, 1e-6)), 1,
                                      static_cast<std::ptrdiff_t>(fan.beams()));
    const double longer = std::max(1.0, fan.elevation_width / fan.beam_width);
    relief_lag_ = std::min(std::llround(longer * static_cast<double>(lag_)),
                           std::max<long long>(lag_, static_cast<long long>(fan.beams() / 16)));
  }
  for (std::size_t i = 0; i < soundings.size(); ++i)
    loudness_db_.push_back(static_cast<double>(soundings.level_db[i]) + 30 * std::log10(soundings.range[i]) +
                           2 * judged.absorption_db_per_m * soundings.range[i]);
}

double Judge::strongest(std::size_t beam, Bins bins) const {
  return judged_.intensity.row(static_cast<Eigen::Index>(beam)).segment(bins.first, bins.end - bins.first).maxCoeff();
}

/// Returns the largest intensity that side lobes may bring in at the range of a sounding.
double Judge::side_lobes_at(std::size_t i) const {  // (E129)
  const Bins bins =
      bins_about(judged_.ping, soundings_.range[i], judged_.side_lobe_reach + 2 * judged_.echoes[i].pulse_deviation);
  Eigen::Array<double, 1, Eigen::Dynamic> others = judged_.all.segment(bins.first, bins.end - bins.first);
  const std::size_t beam = soundings_.beam[i];
  const auto reach = static_cast<std::size_t>(std::lround(main_lobe * static_cast<double>(lag_)));
  for (std::size_t b = beam - std::min(beam, reach); b <= std::min(sine_.size() - 1, beam + reach); ++b)
    others -= judged_.intensity.row(static_cast<Eigen::Index>(b)).segment(bins.first, bins.end - bins.first);
  return std::max(0.0, others.maxCoeff()) * std::min(1.0, share_) * power_from_db(-side_lobe_sum_db);
}

/// Returns true if the bottom about a sounding is far louder.
bool Judge::is_faint(std::size_t i) const {  // (E130)
  std::size_t about = 0, louder = 0;
  for (std::size_t k = 0; k < soundings_.size(); ++k) {
    const bool near = std::abs(angle_[soundings_.beam[k]] - angle_[soundings_.beam[i]]) < bottom_about;
    about += near, louder += near && loudness_db_[i] < loudness_db_[k] - faint_db;
  }
  return louder >= about - about * 3 / 4;  // the sounding at three quarters is among them
}

/// Returns the beam within a few widths whose main lobe brings most into that of a sounding.
Skirt Judge::skirt_at(std::size_t i) const {
  const std::size_t beam = soundings_.beam[i];
  const Bins bins = bins_about(judged_.ping, soundings_.range[i], 4 * judged_.echoes[i].pulse_deviation);
  const auto reach = static_cast<std::size_t>(std::ceil(skirt_reach * static_cast<double>(lag_)));
  const double here = strongest(beam, bins);
  Skirt most;
  for (std::size_t b = beam - std::min(beam, reach); b <= std::min(sine_.size() - 1, beam + reach); ++b) {
    const double there = strongest(b, bins);
    if (there / here <= most.share) continue;  // too faint even on its axis
    const double off = (sine_[b] - sine_[beam]) / judged_.ping.fan.beam_width;
    const double share = there * std::exp2(-4 * off * off) / here;  // Gaussian main lobe
    if (b != beam && share > most.share) most = {share, std::abs(angle_[b] - angle_[beam])};
  }
  return most;
}

std::optional<std::size_t> Judge::sounding_of(std::ptrdiff_t beam) const {
  if (beam < 0 || beam >= static_cast<std::ptrdiff_t>(first_.size()) || first_[static_cast<std::size_t>(beam)] < 0)
    return {};
  return static_cast<std::size_t>(first_[static_cast<std::size_t>(beam)]);
}

/// Returns true if two neighbours lie on one surface with the sounding.
bool Judge::is_confirmed(std::size_t i) const {
  const auto beam = static_cast<std::ptrdiff_t>(soundings_.beam[i]);
  const double range = soundings_.range[i];
  std::size_t count = 0;
  for (std::ptrdiff_t b = beam - 2 * lag_ - 1; b <= beam + 2 * lag_ + 1; ++b) {
    const std::optional<std::size_t> other = sounding_of(b);
    if (b == beam || !other) continue;
    const double turn = std::abs(angle_[soundings_.beam[*other]] - angle_[soundings_.beam[i]]);
    const double reach = judged_.echoes[i].half_power_reach + 4 * judged_.echoes[i].pulse_deviation;
    count += std::abs(soundings_.range[*other] - range) < std::max(reach, steepest * range * turn);
  }
  return count >= witnesses;
}

std::uint8_t Judge::reject(std::size_t i, const Skirt& skirt) const {
  const double level = power_from_db(static_cast<double>(soundings_.level_db[i])) * reference_of_levels;
  const double side_lobes = side_lobes_at(i), noise = judged_.noise[soundings_.beam[i]] * power_from_db(lone_noise_db);
  std::uint8_t reasons = 0;
  if (level < side_lobes) reasons |= reject_side_lobe;
  if (skirt.share > power_from_db(skirt_margin_db)) reasons |= reject_skirt;
  if (is_faint(i)) reasons |= reject_faint;
  const BottomEcho& echo = judged_.echoes[i];
  if (is_of_grating_lobe(judged_.ping, soundings_.beam[i], soundings_.range[i], echo.half_power_reach,
                         echo.pulse_deviation))
    reasons |= reject_grating_lobe;
  if (!is_confirmed(i) && level < std::max(side_lobes * power_from_db(lone_margin_db), noise)) reasons |= reject_lone;
  return reasons;
}

/// Returns the residual of a sounding from the plane through its neighbours a footprint to either side. On a plane 1 /
/// r is linear in the cosine and sine of the angle.
std::optional<Curvature> Judge::curvature_at(std::ptrdiff_t beam) const {
  const auto before = sounding_of(beam - relief_lag_), here = sounding_of(beam),
             after = sounding_of(beam + relief_lag_);
  if (!before || !here || !after) return {};
  const auto angle = [&](std::size_t i) { return angle_[soundings_.beam[i]]; };
  const auto variance = [&](std::size_t i) { return std::pow(static_cast<double>(own_[i]), 2); };
  const double whole = std::sin(angle(*after) - angle(*before));
  if (std::abs(whole) < 1e-9) return {};  // beams of one angle, in a fan of several rows
  const double to_after = std::sin(angle(*after) - angle(*here)) / whole;
  const double from_before = std::sin(angle(*here) - angle(*before)) / whole;
  const double plane = 1 / (to_after / soundings_.range[*before] + from_before / soundings_.range[*after]);
  return Curvature{std::abs(soundings_.range[*here] - plane) / std::sqrt(1.5),
                   (variance(*here) + 0.25 * (variance(*before) + variance(*after))) / 1.5};
}

void Judge::find_curvatures() {
  for (std::ptrdiff_t& first : first_)
    if (first >= 0 && soundings_.reject[static_cast<std::size_t>(first)] != 0) first = -1;
  for (std::size_t b = 0; b < first_.size(); ++b) curvatures_.push_back(curvature_at(static_cast<std::ptrdiff_t>(b)));
}

double Judge::relief_variance(std::size_t i, const Skirt& skirt) const {  // (E131)
  if (first_.size() == 1) return 0;  // its deviation includes the width of its echo (E171)
  const auto beam = static_cast<std::ptrdiff_t>(soundings_.beam[i]);
  std::vector<double> curvatures, expected;
  for (std::ptrdiff_t b = beam - 2 * relief_lag_; b <= beam + 2 * relief_lag_; ++b)
    if (const std::optional<Curvature>& curvature = curvature_of(b))
      curvatures.push_back(curvature->off), expected.push_back(curvature->expected);
  const double aside = skirt.share > power_from_db(partly_skirt_db) ? soundings_.range[i] * skirt.away : 0;
  const double other = std::pow(
      std::max(aside, deviation_along(judged_, soundings_.beam[i], soundings_.range[i], judged_.echoes[i])), 2);
  if (curvatures.size() < 3) return other;
  double most = 0;
  for (std::ptrdiff_t b = beam - relief_lag_; b <= beam + relief_lag_; ++b)
    if (const std::optional<Curvature>& curvature = curvature_of(b)) most = std::max(most, curvature->off);
  const double scatter = std::max(median_of_normal * median_of(curvatures), own_part * most);
  return std::max({0.0, scatter * scatter - sure_of_relief * median_of(expected), other});
}

}  // namespace

void keep_soundings(BottomSoundings& soundings, const std::vector<char>& keep) {
  const auto keep_of = [&](auto& column) {
    std::size_t next = 0;
    for (std::size_t i = 0; i < column.size(); ++i)
      if (keep[i]) column[next++] = column[i];
    column.resize(next);
  };
  keep_of(soundings.position), keep_of(soundings.range), keep_of(soundings.deviation), keep_of(soundings.quality);
  keep_of(soundings.level_db), keep_of(soundings.method), keep_of(soundings.beam), keep_of(soundings.reject);
}

void judge_soundings(const JudgedPing& judged, BottomSoundings& soundings) {
  soundings.reject.assign(soundings.size(), 0);
  if (soundings.size() == 0) return;
  Judge judge(judged, soundings);
  std::vector<Skirt> skirts(soundings.size());
  parallel_for(soundings.size(), judged.threads, [&](std::size_t i) {
    skirts[i] = judge.skirt_at(i);
    soundings.reject[i] = judge.reject(i, skirts[i]);
  });
  judge.find_curvatures();
  std::vector<double> relief(soundings.size());
  parallel_for(soundings.size(), judged.threads,
               [&](std::size_t i) { relief[i] = judge.relief_variance(i, skirts[i]); });
  for (std::size_t i = 0; i < soundings.size(); ++i) {
    const auto own = static_cast<double>(soundings.deviation[i]);
    soundings.deviation[i] = static_cast<float>(std::sqrt(own * own + relief[i]));
    soundings.quality[i] =
        static_cast<float>(std::log10(soundings.range[i] / static_cast<double>(soundings.deviation[i])));
  }
}

}  // namespace insonify
