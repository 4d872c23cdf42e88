// SPDX-License-Identifier: BSD-3-Clause
#include "accuracy/engine_tasks.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/bisect.hpp"
#include "core/random.hpp"
#include "sonar/sonar_spec.hpp"

namespace insonify {
namespace {

constexpr double centre_frequency = 600e3, beam_width = radians(1.5);

/// The numbers in which tasks differ: ranges [m], angles [rad].
struct Variation {
  double bandwidth = 30e3, min_range = 3;
  std::size_t bins = 256;
  double field_of_view = radians(45);
  std::size_t beams = 48;
  double sweep = 0;              ///< duration of a linear FM pulse [s]; 0: a Gaussian pulse
  double speed = 0;              ///< largest speed of echoes along the line of sight [m/s]
  std::size_t rows = 1;          ///< number of rows of beams of a planar array; 1: a line array
  double from_u = -1, to_u = 1;  ///< echoes outside of the fan as far as this are left out
};

SonarHead head_of(const Variation& v) {
  SonarSpec s;
  s.name = "accuracy";
  s.centre_frequency = centre_frequency;
  s.bandwidth = v.bandwidth;
  s.beams = v.beams;
  s.field_of_view = v.field_of_view;
  s.beam_width = beam_width;
  s.elevation_width = radians(20);
  s.min_range = v.min_range;
  s.bin_size = 0.44 * nominal_sound_speed / (2 * v.bandwidth);
  s.max_range = v.min_range + (static_cast<double>(v.bins) - 0.5) * *s.bin_size;
  if (v.rows > 1) {
    s.column_beam_width = radians(4);
    for (std::size_t k = 0; k < v.rows; ++k) s.elevations.push_back(radians(3.0 * static_cast<double>(k)));
  }
  SonarHead head = make_head(s, nominal_sound_speed);
  if (v.sweep > 0) head.pulse.shape = PulseShape::linear_fm, head.pulse.duration = v.sweep;
  return head;
}

AccuracyTask task_for(const Variation& v, std::size_t echoes, std::uint64_t seed) {
  AccuracyTask task{head_of(v), {}, {}};
  task.medium.sound_speed = nominal_sound_speed;
  const double length = task.head.gate.max_range - v.min_range, widest = 0.5 * v.field_of_view + beam_width;
  for (std::size_t i = 0; i < echoes; ++i) {
    const auto at = random_uniform(seed, RandomStage::scene_points, {i, 0, 0});
    const auto by = random_uniform(seed, RandomStage::scene_points, {i, 1, 0});
    Echoes& e = task.echoes;
    e.delay.push_back(2 * (v.min_range + length * at[0]) / nominal_sound_speed);
    e.u.push_back(std::clamp(std::sin((2 * at[1] - 1) * std::min(widest, radians(89.9))), v.from_u, v.to_u));
    e.amplitude.push_back(random_complex_normal(seed, RandomStage::surface_amplitude, {i, 0, 0}));
    if (v.rows > 1) e.v.push_back(std::sin(by[0] * radians(3.0 * static_cast<double>(v.rows - 1))));
    if (v.speed > 0) e.doppler.push_back(2 * (2 * by[1] - 1) * v.speed * centre_frequency / nominal_sound_speed);
  }
  return task;
}

/// A task with these echoes alone.
AccuracyTask with_echoes(const Variation& v, const std::vector<double>& range, const std::vector<double>& u,
                         const std::vector<double>& amplitude) {
  AccuracyTask task = task_for(v, 0, 0);
  for (const double r : range) task.echoes.delay.push_back(2 * r / nominal_sound_speed);
  task.echoes.u = u;
  task.echoes.amplitude.assign(amplitude.begin(), amplitude.end());
  return task;
}

/// The first null of the middle beam of a fan of three.
double first_null(const SonarHead& head) {
  const double wavelength = nominal_sound_speed / centre_frequency;
  const auto response = [&](double u) { return array_response(head.array, wavelength, u, 0).real(); };
  double low = 0, high = 0;
  for (high = 1e-4; response(high) > 0; high += 1e-4) low = high;
  return bisected(low, high, [&](double u) { return response(u) > 0; }).first;
}

}  // namespace

std::vector<EngineTask> engine_tasks(std::size_t echoes, std::uint64_t seed) {
  std::vector<EngineTask> tasks;
  const auto add = [&](std::string name, const Variation& v) {
    tasks.push_back({std::move(name), [=] { return task_for(v, echoes, seed); }});
  };
  const SonarHead head = head_of({});
  const double array_length = static_cast<double>(head.array.elements()) * head.array.spacing;
  add("narrow band", {.bandwidth = 3e3, .bins = 64});
  add("usual", {});
  add("wide band", {.bandwidth = 200e3});
  add("near 0.3 lengths", {.bandwidth = 60e3, .min_range = 0.3 * array_length, .bins = 32});
  add("near 1 length", {.bandwidth = 60e3, .min_range = array_length, .bins = 32});
  add("near 3 lengths", {.bandwidth = 60e3, .min_range = 3 * array_length, .bins = 32});
  add("moving", {.speed = 5});
  add("one beam", {.field_of_view = radians(1), .beams = 1});
  add("130 degrees", {.field_of_view = radians(130), .beams = 96});
  add("planar", {.beams = 24, .rows = 4});
  add("sweep", {.sweep = 1e-3});
  add("wide sweep", {.bandwidth = 200e3, .sweep = 5e-4});
  add("moving in a narrow band", {.bandwidth = 3e3, .min_range = 20, .bins = 64, .speed = 5});
  return tasks;
}

std::vector<EngineTask> stability_tasks(std::uint64_t seed) {
  const auto vary = [seed](const Variation& v) { return [=] { return task_for(v, 200, seed); }; };
  const Variation three{.field_of_view = radians(6), .beams = 3};
  return {{"two echoes 300 dB apart",
           [] {
             return with_echoes({}, {3.3, 4.6}, {0.1, -0.1}, {1e8, 1e-7});
           }},
          {"pulse of one cycle", vary({.bandwidth = centre_frequency})},
          {"1e-3 m", vary({.bandwidth = 60e3, .min_range = 1e-3, .bins = 32})},
          {"1e4 m", vary({.min_range = 1e4})},
          {"grazing fan", vary({.field_of_view = radians(178), .beams = 90, .from_u = 0.999})},
          {"scatterer on a null", [=] { return with_echoes(three, {4}, {first_null(head_of(three))}, {1}); }}};
}

}  // namespace insonify
