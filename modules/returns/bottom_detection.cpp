// SPDX-License-Identifier: BSD-3-Clause
#include "returns/bottom_detection.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "acoustics/noise.hpp"
#include "acoustics/shoot_ray.hpp"
#include "core/error.hpp"
#include "core/parallel.hpp"
#include "core/require.hpp"
#include "core/units.hpp"
#include "returns/bottom_ping_internal.hpp"
#include "returns/echo_place.hpp"

namespace insonify {
namespace {

constexpr const char* bottom_call = "detect_bottom";

Eigen::Vector3d position_of(const Ping& ping, const BottomOptions& options, std::size_t beam, double range) {
  const Eigen::Vector3d head = ping.world_from_head.translation();
  const Eigen::Vector3d away = way_of_beam(ping, beam, range, options.sound_speed);
  if (!options.profile) return head + away;
  const double distance = away.norm(), level = std::hypot(away.x(), away.y());
  const RayEnd end = shoot_ray(*options.profile, options.head_depth,
                               std::asin(std::clamp(away.z() / distance, -1.0, 1.0)), distance / options.sound_speed);
  const Eigen::Vector2d ahead = level > 0 ? Eigen::Vector2d(away.head<2>() / level) : Eigen::Vector2d(0, 0);
  return {head.x() + end.horizontal * ahead.x(), head.y() + end.horizontal * ahead.y(),
          head.z() - (end.depth - options.head_depth)};
}

/// Returns the better of both estimates, and true if it is that by phase.
std::pair<BottomEstimate, bool> fit_of(const BottomPing& prepared, const BottomBeam& beam, const BottomEcho& echo,
                                       double range) {
  // A lone beam has no neighbours to give the slope that a phase needs.
  if (prepared.has_one_beam()) return {range_of_lone_beam(beam, prepared.lone_plane_at(range), range), false};
  const BottomEstimate amplitude = centre_of_gravity(beam, echo, range);
  const BottomEstimate phase =
      zero_crossing(beam, echo, std::isfinite(amplitude.deviation) ? amplitude.range + echo.lengthening : range);
  if (phase.deviation < amplitude.deviation) return {phase, true};
  return {amplitude, false};
}

void require_bottom_options(const Ping& ping, const BottomOptions& o) {
  require(o.false_alarm_rate > 0 && o.false_alarm_rate < 1, bottom_call, "false_alarm_rate", o.false_alarm_rate, "",
          "above 0 and below 1");
  require(o.per_beam >= 1, bottom_call, "per_beam", o.per_beam, "", ">= 1");
  require(o.sound_speed > 0, bottom_call, "sound_speed", o.sound_speed, "m/s", "> 0");
  require(o.noise_floor_db < std::numeric_limits<double>::infinity(), bottom_call, "noise_floor_db", o.noise_floor_db,
          "dB", "finite, or -infinity for none");
  require(o.tolerance >= 0 && o.tolerance < 1, bottom_call, "tolerance", o.tolerance, "", "at least 0 and below 1");
  require(o.range_resolution >= 0, bottom_call, "range_resolution", o.range_resolution, "m", ">= 0");
  if (o.profile) require_valid(*o.profile, bottom_call);
  if (ping.split_phase.size() > 0 &&
      (ping.split_phase.rows() != ping.pressure.rows() || ping.split_phase.cols() != ping.pressure.cols()))
    fail(ErrorKind::argument, bottom_call, ": split_phase has ", ping.split_phase.rows(), " x ",
         ping.split_phase.cols(), " cells, must have one for each of the pressure");
  if (ping.display_cells)
    fail(ErrorKind::argument, bottom_call, ": ping ", ping.number,
         " holds display cells, without the samples of an echo; make it without --display");
  if (ping.expected_level)
    fail(ErrorKind::argument, bottom_call, ": ping ", ping.number,
         " is an expected level, without the samples of an echo; ", "simulate it with another method");
}

}  // namespace

double thermal_floor_db(const Pulse& pulse, const BeamFan& fan) {
  const auto gain_db = [](double width) {
    return width > 0 ? std::max(0.0, db_from_power(2 * half_power_of_line / width)) : 0;
  };
  return thermal_noise_level_db(pulse) - gain_db(fan.beam_width) - gain_db(fan.row_width);  // (E18)
}

BottomSoundings detect_bottom(const Ping& ping, const BottomOptions& options) {
  require_bottom_options(ping, options);
  const BottomPing prepared(ping, options);
  const std::size_t beams = ping.fan.beams();

  // Find the echoes, refined by their centres of gravity on a level bottom.
  std::vector<std::vector<BottomFind>> found(beams);
  parallel_for(beams, options.threads, [&](std::size_t b) { found[b] = prepared.find(b); });

  // Estimate the bottom's slope in each beam, and with it the better of both methods.
  struct Sounding {
    BottomEstimate best;
    BottomMethod method;
    float level_db;
    BottomEcho echo;
  };
  std::vector<std::vector<Sounding>> soundings(beams);
  std::vector<double> slopes(beams);
  parallel_for(beams, options.threads, [&](std::size_t b) {
    if (!found[b].empty()) slopes[b] = prepared.slope_at(b, found);
  });
  const double turn = prepared.phase_per_cosine(found, slopes);
  parallel_for(beams, options.threads, [&](std::size_t b) {
    if (found[b].empty()) return;
    const BottomBeam beam = prepared.beam_of(b);
    for (const BottomFind& find : found[b]) {
      const BottomEcho echo = prepared.echo_at(b, find.range, slopes[b], turn);
      const auto [best_fit, by_phase] = fit_of(prepared, beam, echo, find.range);
      BottomEstimate best = best_fit;
      const double cell = std::max(echo.half_power_reach, ping.gate.bin_size);
      if (!std::isfinite(best.deviation) || !(best.range > ping.gate.min_range)) best = {find.range, cell};
      const auto met = [&](const Sounding& s) { return std::abs(s.best.range - best.range) < cell; };
      if (std::any_of(soundings[b].begin(), soundings[b].end(), met)) continue;  // both fits found one echo
      soundings[b].push_back(
          {best, by_phase ? BottomMethod::phase : BottomMethod::amplitude,
           prepared.level_db_near(b, best.range, std::max(echo.half_power_reach, echo.along_deviation)), echo});
    }
  });
  BottomSoundings all;
  std::vector<BottomEcho> echoes;
  for (std::size_t b = 0; b < beams; ++b)
    for (const Sounding& s : soundings[b]) {
      all.position.push_back(position_of(ping, options, b, s.best.range));
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
