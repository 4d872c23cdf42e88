// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "accuracy/measure_accuracy.hpp"

namespace insonify {

/// Size of a sweep. quick: seconds, as a trial; standard: a minute or two; full: about ten minutes.
enum class SweepSize { quick, standard, full };

/// Extent of a sweep, and its selection of tolerances and methods.
struct SweepOptions {
  SweepSize size = SweepSize::standard;
  std::uint64_t seed = 1;
  int threads = 0;                     ///< 0: all cores
  std::vector<double> tolerances{};    ///< tolerances of gridded, in [1e-13, 1); empty: those of the sweep
  std::vector<std::string> methods{};  ///< names from accuracy_methods; empty: all
};

/// Throws Error for an unknown method, naming the known ones, or a tolerance out of reach.
void require_valid(const SweepOptions& options);

/// A method and the function that measures it.
struct AccuracyRun {
  std::string method;
  std::function<AccuracyRow(const AccuracyBench&)> measure;
};

/// One task and its measurements.
struct AccuracyStep {
  std::string sweep, what;
  std::function<AccuracyTask()> make;
  std::vector<AccuracyRun> runs;
};

/// Returns the sweeps over synthetic tasks, each over one parameter:
///   work-precision   every method over its setting, 512 beams x 2000 bins x 50 000 scatterers
///   scatterers       from 1 on
///   beams, bins      prime numbers and powers of two among them
///   band, absorption, dynamic-range
///   scaling          time of direct, measured whole and scaled up from a part (full size only)
///   threads          gridded on one, two ... all cores
///   engines          all engines of synthesis on engine_tasks: own error, error of their model, time
///   stability        the same on stability_tasks
/// Gridded runs at tolerances from 1e-2 to 1e-12 in all of them. Throws Error unless the options are valid.
std::vector<AccuracyStep> accuracy_sweep(const SweepOptions& options = {});

/// Returns the sweeps work-precision, scatterers (evenly picked) and threads over a user's own echoes. The seed is not
/// used.
std::vector<AccuracyStep> accuracy_sweep_of(const AccuracyTask& task, const SweepOptions& options = {});

/// Returns the names of all methods, in the order of measurement.
std::vector<std::string> accuracy_methods();

}  // namespace insonify
