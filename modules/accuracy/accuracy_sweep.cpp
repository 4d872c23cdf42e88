// SPDX-License-Identifier: BSD-3-Clause
#include "accuracy/accuracy_sweep.hpp"

#include <algorithm>
#include <sstream>

#include "beamforming/gridded/gridded_engine.hpp"
#include "core/error.hpp"
#include "core/parallel.hpp"
#include "core/text.hpp"

namespace insonify {
namespace {

using Runs = std::vector<AccuracyRun>;

constexpr double least_tolerance_of_power = 1e-12;

const AccuracyRun direct_run{"direct", &AccuracyBench::direct}, spectrum_run{"spectrum", &AccuracyBench::spectrum};

Runs gridded_runs(const std::vector<double>& tolerances, int threads = 0) {
  Runs runs;
  for (const double t : tolerances)
    runs.push_back({"gridded", [t, threads](const AccuracyBench& b) { return b.gridded(t, threads); }});
  return runs;
}

Runs windowed_runs(const std::vector<double>& tolerances) {
  Runs runs;
  for (const double t : tolerances)
    runs.push_back({"windowed-direct", [t](const AccuracyBench& b) { return b.windowed("windowed-direct", {t}); }});
  return runs;
}

Runs short_cuts(const std::vector<double>& nulls) {
  Runs runs{{"nearest-bin", [](const AccuracyBench& b) { return b.windowed("nearest-bin", {1e-6, 0, true}); }}};
  for (const double k : nulls)
    runs.push_back({"pattern-cut", [k](const AccuracyBench& b) { return b.windowed("pattern-cut", {1e-6, k}); }});
  return runs;
}

Runs all_of(std::vector<Runs> blocks) {
  Runs all;
  for (Runs& block : blocks) all.insert(all.end(), block.begin(), block.end());
  return all;
}

std::vector<double> tolerances(const SweepOptions& o) {
  const SweepSize size = o.size;
  if (!o.tolerances.empty()) return o.tolerances;
  if (size == SweepSize::quick) return {1e-2, 1e-6, 1e-12};
  if (size == SweepSize::full) return {1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11, 1e-12};
  return {1e-2, 1e-3, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12};
}

/// Every method over its setting.
Runs work_precision(const SweepOptions& o) {
  const bool quick = o.size == SweepSize::quick;
  const std::vector<double> windows = quick ? std::vector<double>{1e-4} : std::vector<double>{1e-2, 1e-4, 1e-6, 1e-8};
  const std::vector<double> nulls = quick ? std::vector<double>{4} : std::vector<double>{1, 4, 16, 64};
  return all_of({gridded_runs(tolerances(o)), {direct_run, spectrum_run}, windowed_runs(windows), short_cuts(nulls)});
}

/// All engines, each at the tolerances that it takes. Engines without a tolerance are measured once.
Runs engine_runs(const std::vector<double>& tolerances) {
  Runs runs;
  for (const Engine& engine : engines()) {
    const auto add = [&](double t) {
      runs.push_back({std::string(engine.word), [&engine, t](const AccuracyBench& b) { return b.engine(engine, t); }});
    };
    if (engine.least_tolerance == 0 && !gives_power(engine.method)) {
      add(0);
      continue;
    }
    for (const double t : tolerances)
      if (t >= std::max(engine.least_tolerance, least_tolerance_of_power) && t <= engine.most_tolerance) add(t);
  }
  return runs;
}

/// Settings of the methods whose run times are compared over the number of scatterers.
std::vector<double> usual_tolerances(const SweepOptions& o) {
  return o.tolerances.empty() ? std::vector<double>{1e-4, 1e-6} : o.tolerances;
}

Runs crossover(const SweepOptions& o) {
  return all_of({gridded_runs(usual_tolerances(o)), {direct_run}, windowed_runs({1e-4, 1e-6})});
}

Runs thread_runs(const SweepOptions& o) {
  Runs runs;
  for (int n = 1; n <= thread_count(o.threads); n = n < 8 ? n + 1 : 2 * n)
    for (const AccuracyRun& run : gridded_runs(usual_tolerances(o), n)) runs.push_back(run);
  return runs;
}

/// Keeps only the methods asked for, and the steps that have one of them.
std::vector<AccuracyStep> chosen(std::vector<AccuracyStep> steps, const std::vector<std::string>& methods) {
  if (methods.empty()) return steps;
  for (AccuracyStep& step : steps)
    std::erase_if(step.runs,
                  [&](const AccuracyRun& run) { return std::ranges::find(methods, run.method) == methods.end(); });
  std::erase_if(steps, [](const AccuracyStep& step) { return step.runs.empty(); });
  return steps;
}

std::string title(const std::string& sweep, const TaskSpec& t) {
  std::ostringstream text;
  text << sweep << ": " << t.scatterers << " scatterers, " << t.beams << " beams, " << t.bins << " bins, "
       << t.bandwidth / 1e3 << " kHz, " << t.dynamic_range_db << " dB";
  return text.str();
}

class Sweep {
 public:
  explicit Sweep(const SweepOptions& options) : options_(options), size_(options.size) {}

  void add(const std::string& sweep, TaskSpec spec, const Runs& runs) {
    spec.seed = options_.seed;
    steps_.push_back({sweep, title(sweep, spec), [spec] { return make_task(spec); }, runs});
  }

  /// Large images: the methods against each other.
  void add_large() {
    const bool quick = size_ == SweepSize::quick, full = size_ == SweepSize::full;
    const TaskSpec large{
        .scatterers = quick ? 300u : 50000u, .beams = quick ? 32u : 512u, .bins = quick ? 200u : 2000u};
    add("work-precision", large, work_precision(options_));
    if (full) {  // whether the direct sum's time is proportional to the number of echoes: all timed, and scaled up
      TaskSpec fewer = large;
      fewer.scatterers = 5000;
      add("scaling", fewer, {direct_run, {"direct", &AccuracyBench::direct_whole}});
    }
    std::vector<std::size_t> counts{1, 10, 100};
    if (!quick) counts.insert(counts.end(), {1000, 10000, 50000});
    if (full) counts.push_back(500000);
    for (const std::size_t n : counts) {
      TaskSpec spec = large;
      spec.scatterers = n;
      add("scatterers", spec, crossover(options_));
    }
    add("threads", large, thread_runs(options_));
  }

  /// Small images of all kinds, to check the tolerance; with the spectrum where its accuracy is in doubt.
  void add_small() {
    const Runs all = all_of({gridded_runs(tolerances(options_)), {direct_run}});
    const Runs with_spectrum = all_of({all, {spectrum_run}});
    const bool quick = size_ == SweepSize::quick;
    const std::size_t n = quick ? 100 : 5000;
    std::vector<std::size_t> beams{1, 17};
    if (!quick) beams.insert(beams.end(), {256, 512});
    if (size_ == SweepSize::full) beams.push_back(4096);
    for (const std::size_t b : beams) add("beams", {.scatterers = n, .beams = b}, all);
    if (quick) return;
    for (const std::size_t b : {251, 256, 1999, 2048}) add("bins", {.scatterers = n, .bins = b}, with_spectrum);
    for (const double band : {3e3, 30e3, 300e3}) add("band", {.scatterers = n, .bandwidth = band}, all);
    for (const double db : {0.0, 50.0, 100.0, 150.0})
      add("dynamic-range", {.scatterers = n, .dynamic_range_db = db}, with_spectrum);
    for (const int order : {1, 2}) {
      Runs runs = all_of({all, {{"absorption-order", [](const AccuracyBench& b) { return b.absorption_order(0); }}}});
      if (order == 2)
        runs.push_back({"absorption-order", [](const AccuracyBench& b) { return b.absorption_order(1); }});
      add("absorption", {.scatterers = n, .bandwidth = 100e3, .dynamic_range_db = 60, .absorption_order = order}, runs);
    }
  }

  /// Engines of all models where they differ, and where arithmetic is strained.
  void add_engines() {
    const bool quick = size_ == SweepSize::quick;
    const std::vector<double>&requested = options_.tolerances,
          one = requested.empty() ? std::vector<double>{1e-4} : requested, most = quick ? one : tolerances(options_);
    const auto add_tasks = [&](const std::string& sweep, const std::vector<AccuracyTask>& tasks,
                               const std::vector<double>& at) {
      for (std::size_t k = 0; k < tasks.size(); k += quick ? 3 : 1)  // every third, of a quick sweep
        steps_.push_back({sweep, sweep + ": " + tasks[k].name, [task = tasks[k]] { return task; }, engine_runs(at)});
    };
    add_tasks("engines", engine_tasks(quick ? 40 : 1000, options_.seed), most);
    add_tasks("stability", stability_tasks(options_.seed), one);
  }

  std::vector<AccuracyStep> steps() && { return std::move(steps_); }

 private:
  const SweepOptions& options_;
  SweepSize size_;
  std::vector<AccuracyStep> steps_;
};

}  // namespace

void require_valid(const SweepOptions& options) {
  const std::vector<std::string> known = accuracy_methods();
  for (const std::string& method : options.methods)
    if (std::ranges::find(known, method) == known.end())
      fail(ErrorKind::argument, "accuracy_sweep: method '", method, "' is unknown; known are ", joined(known));
  for (const double tolerance : options.tolerances)
    if (!(tolerance >= min_gridding_tolerance && tolerance < 1))
      fail(ErrorKind::argument, "accuracy_sweep: tolerance = ", tolerance, ", must be within [", min_gridding_tolerance,
           ", 1)");
}

std::vector<AccuracyStep> accuracy_sweep(const SweepOptions& options) {
  require_valid(options);
  Sweep sweep(options);
  sweep.add_large();
  sweep.add_small();
  sweep.add_engines();
  return chosen(std::move(sweep).steps(), options.methods);
}

std::vector<AccuracyStep> accuracy_sweep_of(const AccuracyTask& task, const SweepOptions& options) {
  require_valid(options);
  const std::size_t all = task.echoes.size();
  std::vector<AccuracyStep> steps{
      {"work-precision", "work-precision", [task] { return task; }, work_precision(options)}};
  for (std::size_t n = 1; n < 10 * all; n *= 10) {
    const std::size_t count = std::min(n, all);
    const auto some = [task, count] { return AccuracyTask{task.head, task.medium, some_echoes(task.echoes, count)}; };
    steps.push_back({"scatterers", "scatterers: " + std::to_string(count), some, crossover(options)});
  }
  steps.push_back({"threads", "threads", [task] { return task; }, thread_runs(options)});
  return chosen(std::move(steps), options.methods);
}

std::vector<std::string> accuracy_methods() {
  std::vector<std::string> methods;
  for (const Engine& engine : engines()) methods.emplace_back(engine.word);
  for (const char* short_cut : {"windowed-direct", "nearest-bin", "pattern-cut", "absorption-order"})
    methods.emplace_back(short_cut);
  return methods;
}

}  // namespace insonify
