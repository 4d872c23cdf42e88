// SPDX-License-Identifier: BSD-3-Clause
#include "accuracy/accuracy_task.hpp"

#include <algorithm>
#include <cmath>

#include "acoustics/direct_echoes.hpp"
#include "core/error.hpp"
#include "core/random.hpp"
#include "simulate/resolve_ping.hpp"
#include "sonar/receive_array.hpp"
#include "sonar/sonar_spec.hpp"

namespace insonify {
namespace {

double field_of(const TaskSpec& t) {
  const double all_beams = 2 * t.beam_width * static_cast<double>(t.beams);
  return t.field_of_view > 0 ? t.field_of_view : std::min(radians(120), all_beams);
}

SonarHead head_of(const TaskSpec& t) {
  SonarSpec s;
  s.name = "accuracy";
  s.centre_frequency = 600e3;
  s.bandwidth = t.bandwidth;
  s.beams = t.beams;
  s.field_of_view = field_of(t);
  s.beam_width = t.beam_width;
  s.elevation_width = radians(20);
  s.min_range = t.min_range;
  s.bin_size = 0.44 * nominal_sound_speed / (2 * t.bandwidth);
  s.max_range = t.min_range + (static_cast<double>(t.bins) - 0.5) * *s.bin_size;
  if (t.rows > 1) {
    s.column_beam_width = radians(4);
    for (std::size_t k = 0; k < t.rows; ++k) s.elevations.push_back(radians(3.0 * static_cast<double>(k)));
  }
  SonarHead head = make_head(s, nominal_sound_speed);
  if (t.sweep > 0) head.pulse.shape = PulseShape::linear_fm, head.pulse.duration = t.sweep;
  return head;
}

Medium medium_of(const TaskSpec& task, const SonarHead& head) {
  const double fc = head.pulse.centre_frequency, length = head.gate.max_range - head.gate.min_range;
  Medium m;
  m.sound_speed = nominal_sound_speed;
  m.absorption.a0 = task.dynamic_range_db * nepers_per_db / (2 * length);
  if (task.absorption_order >= 1) m.absorption.a1 = m.absorption.a0 / fc;
  if (task.absorption_order >= 2) m.absorption.a2 = m.absorption.a0 / (fc * fc);
  return m;
}

/// Returns entries of a list, or none of an empty one.
template <typename T>
std::vector<T> entries(const std::vector<T>& all, const std::vector<std::size_t>& which) {
  std::vector<T> some;
  for (const std::size_t i : which)
    if (!all.empty()) some.push_back(all[i]);
  return some;
}

}  // namespace

AccuracyTask make_task(const TaskSpec& t) {
  AccuracyTask task;
  task.head = head_of(t);
  task.medium = medium_of(t, task.head);
  task.name = t.name;
  const double length = task.head.gate.max_range - t.min_range, rows = static_cast<double>(t.rows - 1);
  for (std::size_t i = 0; i < t.scatterers; ++i) {
    const auto at = random_uniform(t.seed, RandomStage::scene_points, {i, 0, 0});
    const auto by = random_uniform(t.seed, RandomStage::scene_points, {i, 1, 0});
    Echoes& e = task.echoes;
    const double range = t.min_range + length * ((1 + 2 * t.beyond) * at[0] - t.beyond);
    e.delay.push_back(2 * range / nominal_sound_speed);
    e.u.push_back(std::max(std::sin((at[1] - 0.5) * (field_of(t) + t.beam_width)), t.from_u));
    e.amplitude.push_back(random_complex_normal(t.seed, RandomStage::surface_amplitude, {i, 0, 0}));
    if (t.rows > 1) e.v.push_back(std::sin(by[0] * radians(3.0 * rows)));
    const double speed = (2 * by[1] - 1) * t.speed;
    if (t.speed > 0) e.doppler.push_back(2 * speed * task.head.pulse.centre_frequency / nominal_sound_speed);
  }
  return task;
}

AccuracyTask task_of(const SceneCloud& scene, const SonarHead& head, const Pose& world_from_head,
                     const Environment& environment, const SimulationOptions& options) {
  if (head.column || fan_rows(head.fan).size() != 1 || !has_line(head))
    fail(ErrorKind::argument, "task_of: ", head.name, " has several rows of beams or a curved array; the sweep takes ",
         "sonars with one row of a line");
  const ResolvedPing ping = resolve_ping(whole_of(scene), head, {world_from_head}, environment, options, "task_of");
  const Sampling sampling = find_scatterers(scene, world_from_head, head.fan, ping.view.gate, ping.view.sampling);
  AccuracyTask task{head, ping.sent.medium, direct_echoes(sampling.scatterers, scene.materials, ping.sent)};
  if (task.echoes.size() == 0) fail(ErrorKind::content, "task_of: nothing of the scene is in fan and range gate");
  return task;
}

std::vector<std::size_t> picked(std::size_t of, std::size_t count) {
  count = std::min(of, count);
  if (count == 1) return {of / 2};
  std::vector<std::size_t> which;
  for (std::size_t k = 0; k < count; ++k) which.push_back((k * (of - 1) + (count - 1) / 2) / (count - 1));
  return which;
}

Echoes echoes_at(const Echoes& e, const std::vector<std::size_t>& i) {
  return {entries(e.delay, i), entries(e.u, i), entries(e.amplitude, i), entries(e.v, i), entries(e.doppler, i)};
}

Echoes some_echoes(const Echoes& echoes, std::size_t count) { return echoes_at(echoes, picked(echoes.size(), count)); }

SonarHead some_beams(const SonarHead& head, std::size_t count) {
  SonarHead some = head;
  const std::vector<std::size_t> which = picked(head.fan.beams(), count);
  some.fan.azimuth = entries(head.fan.azimuth, which);
  some.fan.elevation = entries(head.fan.elevation, which);
  return some;
}

}  // namespace insonify
