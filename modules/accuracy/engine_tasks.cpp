// SPDX-License-Identifier: BSD-3-Clause
#include <utility>

#include "accuracy/accuracy_task.hpp"
#include "core/bisect.hpp"

namespace insonify {
namespace {

TaskSpec usual_task(std::size_t echoes, std::uint64_t seed) {
  return {.scatterers = echoes,
          .beams = 48,
          .bins = 256,
          .min_range = 3,
          .dynamic_range_db = 0,
          .beam_width = radians(1.5),
          .field_of_view = radians(45),
          .beyond = 0,
          .seed = seed,
          .name = "usual"};
}

/// Tasks that differ from the usual one.
class Tasks {
 public:
  Tasks(std::size_t echoes, std::uint64_t seed) : usual_(usual_task(echoes, seed)) {}

  /// Adds the task that change(spec) makes of the usual one.
  template <typename Change>
  void add(std::string name, const Change& change) {
    TaskSpec spec = usual_;
    change(spec);
    spec.name = std::move(name);
    made.push_back(make_task(spec));
  }
  std::vector<AccuracyTask> made;

 private:
  TaskSpec usual_;
};

/// Gives a task without echoes one.
void add_echo(AccuracyTask& task, double range, double u, double amplitude) {
  task.echoes.delay.push_back(2 * range / nominal_sound_speed);
  task.echoes.u.push_back(u);
  task.echoes.amplitude.emplace_back(amplitude);
}

/// Returns the first null of the middle beam of an odd fan.
double first_null(const SonarHead& head) {
  const double wavelength = nominal_sound_speed / head.pulse.centre_frequency;
  const auto response = [&](double u) { return array_response(head.array, wavelength, u, 0).real(); };
  double low = 0, high = 0;
  for (high = 1e-4; response(high) > 0; high += 1e-4) low = high;
  return bisected(low, high, [&](double u) { return response(u) > 0; }).first;
}

}  // namespace

std::vector<AccuracyTask> engine_tasks(std::size_t echoes, std::uint64_t seed) {
  Tasks tasks(echoes, seed);
  const LineArray array = make_task(usual_task(0, 0)).head.array;
  const double length = static_cast<double>(array.elements()) * array.spacing;
  const auto near = [length](double lengths) {
    return [=](TaskSpec& t) { t.bandwidth = 60e3, t.min_range = lengths * length, t.bins = 32; };
  };
  tasks.add("narrow band", [](TaskSpec& t) { t.bandwidth = 3e3, t.bins = 64; });
  tasks.add("usual", [](TaskSpec&) {});
  tasks.add("wide band", [](TaskSpec& t) { t.bandwidth = 200e3; });
  tasks.add("near 0.3 lengths", near(0.3));
  tasks.add("near 1 length", near(1));
  tasks.add("near 3 lengths", near(3));
  tasks.add("moving", [](TaskSpec& t) { t.speed = 5; });
  tasks.add("one beam", [](TaskSpec& t) { t.field_of_view = radians(1), t.beams = 1; });
  tasks.add("130 degrees", [](TaskSpec& t) { t.field_of_view = radians(130), t.beams = 96; });
  tasks.add("planar", [](TaskSpec& t) { t.beams = 24, t.rows = 4; });
  tasks.add("sweep", [](TaskSpec& t) { t.sweep = 1e-3; });
  tasks.add("wide sweep", [](TaskSpec& t) { t.bandwidth = 200e3, t.sweep = 5e-4; });
  tasks.add("moving in a narrow band",
            [](TaskSpec& t) { t.bandwidth = 3e3, t.min_range = 20, t.bins = 64, t.speed = 5; });
  return std::move(tasks.made);
}

std::vector<AccuracyTask> stability_tasks(std::uint64_t seed) {
  Tasks tasks(200, seed);
  tasks.add("two echoes 300 dB apart", [](TaskSpec& t) { t.scatterers = 0; });
  add_echo(tasks.made.back(), 3.3, 0.1, 1e8);
  add_echo(tasks.made.back(), 4.6, -0.1, 1e-7);
  tasks.add("pulse of one cycle", [](TaskSpec& t) { t.bandwidth = 600e3; });
  tasks.add("1e-3 m", [](TaskSpec& t) { t.bandwidth = 60e3, t.min_range = 1e-3, t.bins = 32; });
  tasks.add("1e4 m", [](TaskSpec& t) { t.min_range = 1e4; });
  tasks.add("grazing fan", [](TaskSpec& t) { t.field_of_view = radians(178), t.beams = 90, t.from_u = 0.999; });
  tasks.add("scatterer on a null", [](TaskSpec& t) { t.scatterers = 0, t.field_of_view = radians(6), t.beams = 3; });
  add_echo(tasks.made.back(), 4, first_null(tasks.made.back().head), 1);
  return std::move(tasks.made);
}

}  // namespace insonify
