// SPDX-License-Identifier: BSD-3-Clause
#include "accuracy/measure_accuracy.hpp"

#include <algorithm>
#include <cmath>

#include "beamforming/gridded/gridded_engine.hpp"
#include "beamforming/synthesize.hpp"
#include "core/parallel.hpp"
#include "core/stop_watch.hpp"
#include "files/peak_memory.hpp"
#include "returns/compare.hpp"

namespace insonify {
namespace {

constexpr std::size_t least_beams = 4, most_beams = 64, least_timed = 128;

double work(std::size_t echoes, std::size_t beams, std::size_t bins) {
  return std::max(1.0, static_cast<double>(echoes)) * static_cast<double>(beams) * static_cast<double>(bins);
}

/// Which eighths of the range axis hold an echo.
std::vector<bool> eighths_with_echo(const Echoes& echoes, const AccuracyTask& task) {
  std::vector<bool> counts(8, false);
  const RangeGate& gate = task.head.gate;
  const double length = gate.bin_size * static_cast<double>(gate.bins());
  for (const double delay : echoes.delay) {
    const double at = (0.5 * task.medium.sound_speed * delay - gate.min_range) / length;
    if (at >= 0 && at < 1) counts[static_cast<std::size_t>(8 * at)] = true;
  }
  return counts;
}

Absorption of_order(Absorption a, int order) {
  if (order < 2) a.a2 = 0;
  if (order < 1) a.a1 = 0;
  return a;
}

}  // namespace

double relative_error(const ComplexGrid& pressure, const ComplexGrid& referee) {
  const double power = referee.abs2().sum();
  return power > 0 ? std::sqrt((pressure - referee).abs2().sum() / power) : 0;
}

ImageError image_error(const ComplexGrid& pressure, const ComplexGrid& referee,
                       const std::vector<bool>& eighth_counts) {
  ImageError error;
  error.whole = relative_error(pressure, referee);
  for (Eigen::Index k = 0; k < 8; ++k) {
    const Eigen::Index first = k * referee.cols() / 8, last = (k + 1) * referee.cols() / 8;
    if (eighth_counts[static_cast<std::size_t>(k)] && last > first)
      error.worst_eighth = std::max(error.worst_eighth, relative_error(pressure.middleCols(first, last - first),
                                                                       referee.middleCols(first, last - first)));
  }
  return error;
}

AccuracyBench::AccuracyBench(std::string sweep, AccuracyTask task, const MeasureOptions& options)
    : sweep_(std::move(sweep)), task_(std::move(task)), options_(options) {
  const std::size_t beams = task_.head.fan.beams();
  const double affordable = options.referee_work / work(task_.echoes.size(), 1, task_.head.gate.bins());
  const std::size_t count = std::clamp<std::size_t>(static_cast<std::size_t>(std::min(affordable, 1e9)),
                                                    std::min(least_beams, beams), std::min(most_beams, beams));
  beams_ = picked(beams, count);
  checked_head_ = some_beams(task_.head, count);
  referee_ = synthesize(task_.echoes, checked_head_, task_.medium, SynthesisMethod::direct, {1e-4, options.threads});
}

AccuracyRow AccuracyBench::row(const std::string& method) const {
  AccuracyRow r;
  r.sweep = sweep_;
  r.method = method;
  r.task = task_.name;
  r.precision = "double";
  r.scatterers = r.timed_scatterers = task_.echoes.size();
  r.beams = r.timed_beams = task_.head.fan.beams();
  r.elements = task_.head.array.elements();
  r.bins = task_.head.gate.bins();
  r.bandwidth = task_.head.pulse.bandwidth;
  const Absorption& a = task_.medium.absorption;
  r.dynamic_range_db = 2 * a.a0 * (task_.head.gate.max_range - task_.head.gate.min_range) / nepers_per_db;
  r.absorption_order = a.a2 != 0 ? 2 : a.a1 != 0 ? 1 : 0;
  r.threads = thread_count(options_.threads);
  r.checked_beams = beams_.size();
  return r;
}

std::size_t AccuracyBench::timed(double affordable) const {
  const auto most = static_cast<std::size_t>(std::min(affordable, 1e12));
  return std::min(task_.echoes.size(), std::max(least_timed, most));
}

void AccuracyBench::compare(const ComplexGrid& pressure, const ComplexGrid& referee, const Echoes& echoes,
                            AccuracyRow& row) const {
  const ImageError error = image_error(pressure, referee, eighths_with_echo(echoes, task_));
  row.error = error.whole;
  row.local_error = error.worst_eighth;
  if (referee.abs2().sum() > 0) row.max_level_db = compare_images(pressure, referee, 60).max_level_db;
}

void AccuracyBench::time_all(const Synthesis& run, AccuracyRow& row) const {
  const Echoes echoes = some_echoes(task_.echoes, row.timed_scatterers);
  forget_peak_memory();
  run(echoes);  // warms caches
  std::vector<double> seconds;
  StopWatch whole;
  double spent = 0;
  while (static_cast<int>(seconds.size()) < options_.repeats && (spent < options_.most_seconds || seconds.size() < 2)) {
    StopWatch watch;
    run(echoes);
    seconds.push_back(watch.lap());
    spent += whole.lap();
  }
  row.peak_mib = peak_memory_mib();
  std::sort(seconds.begin(), seconds.end());
  const auto block = static_cast<double>(std::max<std::size_t>(1, echoes.size()) * row.timed_beams);
  const double scale = static_cast<double>(std::max<std::size_t>(1, row.scatterers) * row.beams) / block;
  row.repeats = static_cast<int>(seconds.size());
  row.seconds = scale * seconds[seconds.size() / 2];
  row.seconds_min = scale * seconds.front();
  row.seconds_max = scale * seconds.back();
}

AccuracyRow AccuracyBench::direct() const {
  AccuracyRow r = row("direct");
  const SynthesisOptions options{1e-4, options_.threads};
  r.timed_scatterers = timed(options_.direct_work / work(1, r.beams, r.bins));
  time_all([&](const Echoes& e) { return synthesize_direct(e, task_.head, task_.medium, options); }, r);

  // Error of the referee itself: a part of it against extended precision.
  const Echoes some = some_echoes(task_.echoes, options_.twice_checked);
  const SonarHead head = some_beams(task_.head, std::min<std::size_t>(4, r.beams));
  const std::vector<std::size_t> bins = picked(r.bins, 64);
  const ComplexGrid in_double = synthesize_direct(some, head, task_.medium, options);
  const ComplexGrid exact = synthesize_extended(some, head, task_.medium, bins, options_.threads);
  compare(in_double(Eigen::all, bins), exact, some, r);
  r.checked_beams = head.fan.beams();
  return r;
}

AccuracyRow AccuracyBench::direct_whole() const {
  AccuracyRow r = row("direct");
  forget_peak_memory();
  StopWatch watch;
  const ComplexGrid pressure = synthesize_direct(task_.echoes, task_.head, task_.medium, {1e-4, options_.threads});
  r.seconds = r.seconds_min = r.seconds_max = watch.lap();
  r.peak_mib = peak_memory_mib();
  r.repeats = 1;
  compare(pressure(beams_, Eigen::all), referee_, task_.echoes, r);
  return r;
}

AccuracyRow AccuracyBench::gridded_row(AccuracyRow r, const Medium& medium) const {
  StopWatch watch;
  const GriddedEngine plan(task_.head, medium, {r.tolerance, r.threads});
  r.plan_seconds = watch.lap();
  if (plan.choice().single_precision) r.precision = "single";
  r.kernel_width = plan.choice().kernel_width;
  compare(plan.pressure(task_.echoes)(beams_, Eigen::all), referee_, task_.echoes, r);
  time_all([&](const Echoes& e) { return plan.pressure(e); }, r);
  return r;
}

AccuracyRow AccuracyBench::gridded(double tolerance, int threads) const {
  AccuracyRow r = row("gridded");
  if (threads > 0) r.threads = threads;
  r.tolerance = tolerance;
  return gridded_row(r, task_.medium);
}

AccuracyRow AccuracyBench::spectrum() const {
  AccuracyRow r = row("spectrum");
  const SonarHead head = some_beams(task_.head, least_beams);
  r.checked_beams = r.timed_beams = head.fan.beams();
  r.timed_scatterers = timed(options_.spectrum_work / work(1, r.timed_beams, r.bins));
  const SynthesisOptions options{1e-12, options_.threads};
  const Echoes some = some_echoes(task_.echoes, r.timed_scatterers);
  compare(synthesize_spectrum(some, head, task_.medium, options), synthesize_direct(some, head, task_.medium, options),
          some, r);
  time_all([&](const Echoes& e) { return synthesize_spectrum(e, head, task_.medium, options); }, r);
  return r;
}

AccuracyRow AccuracyBench::windowed(const std::string& method, WindowedOptions options) const {
  AccuracyRow r = row(method);
  options.threads = options_.threads;
  r.parameter = options.pattern_nulls;
  if (!options.nearest_bin && options.pattern_nulls == 0) r.tolerance = options.tolerance;
  r.timed_scatterers = timed(options_.windowed_work / work(1, r.beams, 1));
  compare(windowed_synthesizer(checked_head_, task_.medium, options)(task_.echoes), referee_, task_.echoes, r);
  StopWatch watch;
  const auto run = windowed_synthesizer(task_.head, task_.medium, options);
  r.plan_seconds = watch.lap();
  time_all(run, r);
  return r;
}

AccuracyRow AccuracyBench::absorption_order(int order) const {
  AccuracyRow r = row("absorption-order");
  r.parameter = order;
  r.tolerance = 1e-8;
  return gridded_row(r, {task_.medium.sound_speed, of_order(task_.medium.absorption, order)});
}

}  // namespace insonify
