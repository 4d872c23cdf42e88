// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "core/units.hpp"
#include "simulate/simulate_ping.hpp"

namespace insonify {

/// Echoes and the head that receives them: the input of every method of synthesis.
struct AccuracyTask {
  SonarHead head;
  Medium medium;
  Echoes echoes;
  std::string name{};  ///< among the tasks of a sweep
};

/// A synthetic task: 600 kHz, half-wavelength line array with Taylor shading, bins of 0.44 c / 2B.
struct TaskSpec {
  std::size_t scatterers = 5000, beams = 64, bins = 500;
  double bandwidth = 30e3;           ///< [Hz]
  double min_range = 1;              ///< range of the first bin [m]
  double dynamic_range_db = 40;      ///< absorption between the first bin and the last
  int absorption_order = 0;          ///< 1: slope a0 / fc; 2: curvature a0 / fc^2 too
  double beam_width = radians(1.0);  ///< [rad]
  double field_of_view = 0;          ///< [rad]; 0: two widths per beam, at most 120 degrees
  double sweep = 0;                  ///< duration of a linear FM pulse [s]; 0: a Gaussian pulse
  double speed = 0;                  ///< largest speed of echoes along the line of sight [m/s]
  std::size_t rows = 1;              ///< number of rows of beams of a planar array; 1: a line array
  double beyond = 0.01;              ///< part of the gate's length by which echoes lie beyond either end
  double from_u = -1;                ///< least direction cosine of echoes: those below it come from there
  std::uint64_t seed = 1;
  std::string name{};
};

/// Returns echoes of complex-normal amplitude, distributed evenly over fan and gate and a little beyond.
AccuracyTask make_task(const TaskSpec& spec);

/// Returns tasks on which engines differ, with a beam width of 1.5 degrees: narrow and wide band, near field at 0.3, 1
/// and 3 lengths of the array, moving echoes (5 m/s), fans of 1, 45 and 130 degrees, a planar array, sweeps of a usual
/// and a wide band, and moving echoes whose Doppler shifts exceed the band (5 m/s, 3 kHz). `echoes`: number in each.
std::vector<AccuracyTask> engine_tasks(std::size_t echoes, std::uint64_t seed);

/// Returns cases that strain the arithmetic: two echoes 300 dB apart, a pulse of one cycle, ranges of 1e-3 and 1e4 m, a
/// fan that grazes its array, one scatterer on a null of the middle beam.
std::vector<AccuracyTask> stability_tasks(std::uint64_t seed);

/// Returns the echoes that a head receives from a scene: the direct echoes of simulate_ping along straight rays, before
/// beams are formed. Throws Error as simulate_ping does, for a head of several rows or a column, and if no surfel is in
/// fan and gate.
AccuracyTask task_of(const SceneCloud& scene, const SonarHead& head, const Pose& world_from_head,
                     const Environment& environment, const SimulationOptions& options = {});

/// Returns the echoes of these indices.
Echoes echoes_at(const Echoes& echoes, const std::vector<std::size_t>& which);
/// Returns `count` echoes, evenly picked in their order; all of them if there are fewer.
Echoes some_echoes(const Echoes& echoes, std::size_t count);

/// Returns the same head with `count` of its beams, evenly picked with both ends.
SonarHead some_beams(const SonarHead& head, std::size_t count);
/// Returns the picked indices: round(k (of - 1) / (count - 1)) for k = 0 ... count - 1.
std::vector<std::size_t> picked(std::size_t of, std::size_t count);

}  // namespace insonify
