// SPDX-License-Identifier: BSD-3-Clause
// Whole images: 512 beams x 2000 bins by argument 0 echoes at a tolerance of 10^-argument 1, on argument 2 threads.
#include <cmath>

#include <benchmark/benchmark.h>

#include "accuracy/accuracy_task.hpp"
#include "accuracy/reference_sums.hpp"
#include "beamforming/gridded/gridded_engine.hpp"
#include "beamforming/true_delays/true_delay_engine.hpp"

using namespace insonify;

namespace {

AccuracyTask task_for(const benchmark::State& state) {
  return make_task({.scatterers = static_cast<std::size_t>(state.range(0)), .beams = 512, .bins = 2000});
}

double tolerance_for(const benchmark::State& state) { return std::pow(10.0, -static_cast<double>(state.range(1))); }

void gridded_engine(benchmark::State& state) {
  const AccuracyTask task = task_for(state);
  const GriddedEngine plan(task.head, task.medium, {tolerance_for(state), static_cast<int>(state.range(2))});
  for (auto _ : state) benchmark::DoNotOptimize(plan.pressure(task.echoes));
  state.SetItemsProcessed(state.iterations() * state.range(0));
  state.counters["width"] = static_cast<double>(plan.choice().kernel_width);
}
BENCHMARK(gridded_engine)
    ->ArgsProduct({{1000, 50000, 500000}, {3, 4, 6}, {1, 2}})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

/// Times true delays for every element, to compare with gridded_engine of the same arguments; 600 kHz, 5 to 40 m.
void true_delay_engine(benchmark::State& state) {
  const AccuracyTask task = task_for(state);
  const TrueDelayEngine plan(task.head, task.medium, {tolerance_for(state), static_cast<int>(state.range(2))});
  for (auto _ : state) benchmark::DoNotOptimize(plan.pressure(task.echoes));
  state.SetItemsProcessed(state.iterations() * state.range(0));
}
BENCHMARK(true_delay_engine)
    ->ArgsProduct({{1000, 50000, 500000}, {3, 4}, {1, 2}})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

/// Times a few echoes. Argument 0: number of echoes; 1: gridded (0), or by the plain sum (1).
void few_echoes(benchmark::State& state) {
  const AccuracyTask task =
      make_task({.scatterers = static_cast<std::size_t>(state.range(0)), .beams = 512, .bins = 2000});
  const SynthesisOptions options{1e-6, 1};
  const GriddedEngine plan(task.head, task.medium, options);
  for (auto _ : state) {
    if (state.range(1) == 0) benchmark::DoNotOptimize(plan.pressure(task.echoes));
    if (state.range(1) == 1) benchmark::DoNotOptimize(synthesize_direct(task.echoes, task.head, task.medium, options));
  }
}
BENCHMARK(few_echoes)
    ->ArgsProduct({{1, 10, 100, 300, 1000}, {0}})
    ->ArgsProduct({{1, 10, 100}, {1}})
    ->Unit(benchmark::kMillisecond);

void make_gridded_engine(benchmark::State& state) {
  const AccuracyTask task = task_for(state);
  for (auto _ : state)
    benchmark::DoNotOptimize(GriddedEngine(task.head, task.medium, {tolerance_for(state), 1}).choice());
}
BENCHMARK(make_gridded_engine)->Args({1, 4, 1})->Args({1, 6, 1})->Unit(benchmark::kMillisecond);

void windowed_direct(benchmark::State& state) {
  const AccuracyTask task = task_for(state);
  for (auto _ : state)
    benchmark::DoNotOptimize(
        windowed_synthesizer(task.head, task.medium, {tolerance_for(state), 0, false, 1})(task.echoes));
  state.SetItemsProcessed(state.iterations() * state.range(0));
}
BENCHMARK(windowed_direct)->Args({1000, 6, 1})->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
