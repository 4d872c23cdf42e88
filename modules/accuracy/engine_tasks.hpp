// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "accuracy/accuracy_task.hpp"

namespace insonify {

/// A task by name, made when it is measured.
struct EngineTask {
  std::string name;
  std::function<AccuracyTask()> make;
};

/// Returns tasks on which engines differ, each 600 kHz and a beam width of 1.5 degrees: narrow and wide band, near
/// field at 0.3, 1 and 3 lengths of the array, moving echoes (5 m/s), fans of 1, 45 and 130 degrees, a planar array,
/// sweeps of a usual and a wide band, and moving echoes whose Doppler shifts exceed the band (5 m/s, 3 kHz). `echoes`:
/// number in each.
std::vector<EngineTask> engine_tasks(std::size_t echoes, std::uint64_t seed);

/// Returns cases that strain the arithmetic: two echoes 300 dB apart, a pulse of one cycle, ranges of 1e-3 and 1e4 m, a
/// fan that grazes its array, one scatterer on a null of the middle beam.
std::vector<EngineTask> stability_tasks(std::uint64_t seed);

}  // namespace insonify
