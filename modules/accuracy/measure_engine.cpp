// SPDX-License-Identifier: BSD-3-Clause
// Errors of engines: against the referee of their model, and of the model.
#include <algorithm>
#include <cmath>

#include "accuracy/measure_accuracy.hpp"
#include "beamforming/gridded/narrow_band_error.hpp"
#include "beamforming/synthesizer.hpp"
#include "core/error.hpp"
#include "core/stop_watch.hpp"
#include "simulate/plan_ping.hpp"

namespace insonify {
namespace {

/// Root of the sum of |P_i|^2 over echoes (E65), each echo by the direct sum.
ComplexGrid expected_by_echoes(const AccuracyTask& task, const SonarHead& head, int threads) {
  const Synthesizer direct(head, task.medium, SynthesisMethod::direct, {1e-4, threads});
  Grid<double> intensity = Grid<double>::Zero(head.fan.beams(), head.gate.bins());
  for (std::size_t i = 0; i < task.echoes.size(); ++i) intensity += direct.pressure(echoes_at(task.echoes, {i})).abs2();
  return intensity.sqrt().cast<std::complex<double>>();
}

/// Places from which the echoes come, and their powers.
Scatterers positions_of(const Echoes& echoes, double sound_speed) {
  Scatterers positions;
  for (std::size_t i = 0; i < echoes.size(); ++i) {
    const double v = echoes.v.empty() ? 0 : echoes.v[i], elevation = std::asin(v);
    positions.range.push_back(0.5 * sound_speed * echoes.delay[i]);
    positions.elevation.push_back(elevation);
    positions.azimuth.push_back(std::asin(std::clamp(echoes.u[i] / std::cos(elevation), -1.0, 1.0)));
  }
  positions.cos_incidence.assign(echoes.size(), 1);
  positions.projected_area.assign(echoes.size(), 1);
  positions.material.assign(echoes.size(), 0);
  for (std::size_t i = 0; i < echoes.size(); ++i) positions.id.push_back(i), positions.surfel.push_back(0);
  return positions;
}

/// The plan's bound of the error of the narrow band.
double bound_of_narrow_band(const AccuracyTask& task, int threads) {
  std::vector<double> power;
  for (const std::complex<double>& amplitude : task.echoes.amplitude) power.push_back(std::norm(amplitude));
  const NarrowBandError error(task.head, task.medium.sound_speed);
  const NarrowBandError::Sums sums =
      error.of(positions_of(task.echoes, task.medium.sound_speed), power, task.echoes.doppler, threads);
  return sums.image > 0 ? std::sqrt(sums.error / sums.image) : 0;
}

/// The method that the plan takes.
SynthesisMethod planned_method(const AccuracyTask& task, double tolerance, int threads) {
  SimulationOptions options;
  options.synthesis.tolerance = tolerance;
  options.threads = threads;
  return decided_synthesis(positions_of(task.echoes, task.medium.sound_speed), task.echoes, task.head, {}, options)
      .synthesis.method;
}

}  // namespace

const ComplexGrid& AccuracyBench::referee_of(ImageModel model) const {
  if (model == ImageModel::narrow_band) return referee_;
  ComplexGrid& referee = model_referees_[model];
  if (referee.size() == 0)
    referee = model == ImageModel::expected_power
                  ? expected_by_echoes(task_, checked_head_, options_.threads)
                  : synthesize(task_.echoes, checked_head_, task_.medium, referee_for(model).method,
                               {referee_for(model).least_tolerance, options_.threads});
  return referee;
}

void AccuracyBench::measure_engine(const Engine& engine, AccuracyRow& r) const {
  const SynthesisOptions options{engine.least_tolerance > 0 || gives_power(engine.method) ? r.tolerance : 1e-4,
                                 options_.threads};
  StopWatch watch;
  const Synthesizer synthesizer(task_.head, task_.medium, engine.method, options);
  const ComplexGrid image = synthesizer.pressure(task_.echoes);
  r.plan_seconds = watch.lap();
  compare(image(beams_, Eigen::all), referee_of(engine.model), task_.echoes, r);
  if (engine.model == ImageModel::narrow_band) {
    r.model_error = relative_error(referee_, referee_of(ImageModel::true_delays));
    r.model_bound = bound_of_narrow_band(task_, options_.threads);
  }
  time_all([&](const Echoes& echoes) { return synthesizer.pressure(echoes); }, r);
  r.plan_seconds = std::max(0.0, r.plan_seconds - r.seconds);
}

AccuracyRow AccuracyBench::engine(const Engine& engine, double tolerance) const {
  AccuracyRow r = row(std::string(engine.word));
  r.tolerance = tolerance;
  try {
    r.planned = tolerance > 0 && planned_method(task_, tolerance, options_.threads) == engine.method;
    measure_engine(engine, r);
  } catch (const Error& error) {
    r.refused = error.what();
    std::replace(r.refused.begin(), r.refused.end(), ',', ';');  // a field of CSV
    r.error = r.local_error = std::nan("");
  }
  return r;
}

}  // namespace insonify
