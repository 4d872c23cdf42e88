// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <utility>

#include <fmt/format.h>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "core/pose.hpp"
#include "core/units.hpp"
#include "python/binding_internal.hpp"
#include "returns/sounding_columns.hpp"
#include "survey/mesh_source.hpp"

namespace insonify::python {
namespace {

/// A ping that is still to be made, with the options of its simulator but for `keys`.
MadePing requested(const By& by, const Of& scene, const py::kwargs& keys, const char* who) {
  MadePing ping{by, scene, by->setup};
  set_keywords(keywords(ping.setup.run, true), keys, who);
  if (scene->edited) ping.edited = scene->edited, ping.arrangement = scene->edited->now();
  return ping;
}

MadePing requested_at(MadePing ping, const py::object& position, double yaw, double pitch, double roll) {
  const Numbers at = numbers_of(position, "ping: position", 0, 3);
  const Numbers turn = numbers_of(py::make_tuple(yaw, pitch, roll), "ping: yaw, pitch, roll", 0, 3);
  ping.setup.run.placement.pose = {at.at(0), at.at(1), at.at(2), turn.at(0), turn.at(1), turn.at(2)};
  return ping;
}

/// Takes a keyword out that has a value for each pose, of so many numbers; null if it has one for all.
py::object for_each_pose(const py::dict& keys, const char* name, py::ssize_t numbers = 0) {
  if (!keys.contains(name)) return {};
  const py::object value = keys[name];
  const auto array = py::array::ensure(value);
  PyErr_Clear();
  if (!array || array.ndim() <= (numbers > 0 ? 1 : 0)) return {};
  keys.attr("pop")(name);
  return value;
}

/// Takes the keyword of a vector out, if it has one for each pose; returns the vectors.
std::vector<Eigen::Vector3d> vectors_for_each_pose(const py::dict& keys, const char* name, py::ssize_t poses) {
  std::vector<Eigen::Vector3d> all;
  if (const py::object given = for_each_pose(keys, name, 3)) {
    const Numbers numbers = numbers_of(given, fmt::format("pings: {}", name), 3, poses);
    for (py::ssize_t i = 0; i < poses; ++i) all.emplace_back(numbers.at(i, 0), numbers.at(i, 1), numbers.at(i, 2));
  }
  return all;
}

PingSimulator resolve(MadePing& ping, int threads) {
  PingSetup& setup = ping.setup;
  setup.event = requested_event(setup.run.placement);
  setup.simulation = ping.by->setup.simulation;
  setup.simulation.seed = setup.run.simulation.seed;
  setup.simulation.threads = threads;
  if (ping.detail) setup.simulation.sampling.detail = *ping.detail;
  setup.simulation.outputs = requested_simulation(setup.run).outputs;
  require_valid_settings(setup.run, setup.simulation, NamedBy::keyword);
  return ping.by->simulator->with(setup.simulation);
}

/// Decides whether pings like this one merge surfels, if so many share a scene; returns SamplingSettings::detail.
Choice detail_of(MadePing ping, std::size_t pings, int threads) {
  const Choice requested = ping.by->setup.simulation.sampling.detail;
  if (ping.arrangement || ping.scene->moving || ping.scene->loaded->mesh) return requested;
  try {
    const PingSimulator simulator = resolve(ping, threads);
    return simulator.for_many(pings, *ping.scene->prepared, ping.setup.event).options().sampling.detail;
  } catch (const Error&) {
    return requested;  // the ping itself fails with the reason
  }
}

std::shared_ptr<MadePing> make(MadePing ping, int threads) {
  const PingSimulator simulator = resolve(ping, threads);
  ping.made = simulator.ping(*surfels_of(ping, simulator), ping.setup.event);
  return std::make_shared<MadePing>(std::move(ping));
}

}  // namespace

Scene::Scene(LoadedScene given, SceneOptions how, SceneInstances of)
    : loaded(std::make_shared<const LoadedScene>(std::move(given))),
      prepared(std::make_shared<const PreparedScene>(std::shared_ptr<const SceneCloud>(loaded, &loaded->scene))),
      options(std::move(how)),
      instances(std::move(of)) {}

Scene::Scene(MovingScene of, LoadReport report, SceneOptions how)
    : loaded(std::make_shared<const LoadedScene>(LoadedScene{{}, std::move(report)})),
      prepared(of.at({of.begin, 0})),
      moving(std::move(of)),
      options(std::move(how)) {}

std::shared_ptr<const PreparedScene> surfels_of(const MadePing& ping, const PingSimulator& simulator) {
  const auto draw = static_cast<std::uint64_t>(ping.setup.run.placement.draw);
  if (ping.arrangement) return ping.edited->scene_of(ping.arrangement);
  if (ping.scene->moving) return ping.scene->moving->at({ping.setup.event.time, draw});
  if (!ping.scene->loaded->mesh) return ping.scene->prepared;
  const LoadedScene& loaded = *ping.scene->loaded;
  MeshSample sample =
      mesh_sample_for(*loaded.mesh, loaded.scene.size(), ping.setup.run.memory_limit, simulator, ping.setup.event);
  if (!sample.scene) return ping.scene->prepared;
  return std::make_shared<const PreparedScene>(std::move(*sample.scene), simulator.options().threads);
}

Simulator::Simulator(const Sonar& of, const Environment& environment, const py::kwargs& keys) : sonar(of) {
  Run run;
  set_keywords(keywords(run), keys, "PingSimulator");
  for (const auto& [name, value] : keys)
    if (!value.is_none()) given.emplace_back(py::cast<std::string>(name), value_of(value, "PingSimulator"));
  run.head.sonar = sonar.file.path;
  run.placement.mount = given_mounting(sonar.file);
  setup = set_up(set_up_head(of.file, of.spec, environment), run, {}, NamedBy::keyword);
  simulator.emplace(setup.simulator());
}

Simulator::Simulator(Sonar of, PingSetup ready)
    : sonar(std::move(of)), setup(std::move(ready)), simulator(setup.simulator()) {
  given = given_settings(setup.run);
}

py::object io(const char* function) { return py::module_::import("insonify._insonify_io").attr(function); }

std::shared_ptr<MadePing> next_of(Pings& pings) {
  const py::gil_scoped_release release;
  const auto next = pings.next([] {
    const py::gil_scoped_acquire acquire;
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  });
  return next.value_or(nullptr);
}

std::shared_ptr<MadePing> ping(const By& by, const Of& scene, const py::object& position, double yaw, double pitch,
                               double roll, const py::kwargs& keys) {
  const MadePing ping = requested_at(requested(by, scene, keys, "ping"), position, yaw, pitch, roll);
  Pings one(1, 1, [&ping](std::size_t) { return make(ping, 0); });
  return next_of(one);
}

py::list plan(const By& by, const Of& scene, const py::object& position, double yaw, double pitch, double roll,
              const py::kwargs& keys) {
  MadePing ping = requested_at(requested(by, scene, keys, "plan"), position, yaw, pitch, roll);
  py::list stages;
  const PingSimulator simulator = resolve(ping, 0);
  for (const PlannedStage& s : simulator.plan(*surfels_of(ping, simulator), ping.setup.event).stages) {
    using namespace py::literals;
    stages.append(py::dict("name"_a = s.name, "included"_a = s.included, "why"_a = s.why, "bound_db"_a = s.bound_db));
  }
  return stages;
}

std::unique_ptr<Pings> pings(const By& by, const Of& scene, const py::object& poses, int threads,
                             const py::kwargs& keys) {
  if (threads < 0 || threads > 1024) fail(ErrorKind::argument, "pings: threads = ", threads, ", must be 0 to 1024");
  const Numbers numbers = numbers_of(poses, "pings: poses", 6);
  const std::vector<double> pose(numbers.data(), numbers.data() + numbers.size());
  std::vector<double> time;
  std::vector<int> draw;
  if (const py::object given = for_each_pose(keys, "time")) {
    const Numbers times = numbers_of(given, "pings: time", 0, numbers.shape(0));
    time.assign(times.data(), times.data() + times.size());
  }
  if (const py::object given = for_each_pose(keys, "draw"))
    draw = whole_numbers<int>(given, "pings: draw", numbers.shape(0), 1e9);
  const std::vector<Eigen::Vector3d> velocity = vectors_for_each_pose(keys, "velocity", numbers.shape(0)),
                                     turn_rate = vectors_for_each_pose(keys, "turn_rate", numbers.shape(0));
  const MadePing each = requested(by, scene, keys, "pings");
  const auto requested = [each, pose, time, draw, velocity, turn_rate](std::size_t i) {
    MadePing ping = each;
    Placement& at = ping.setup.run.placement;
    std::copy_n(&pose[6 * i], 6, at.pose.emplace().begin());
    at.number = static_cast<int>(i);
    if (!time.empty()) at.time = time[i];
    if (!draw.empty()) at.draw = draw[i];
    if (!velocity.empty()) at.velocity = velocity[i];
    if (!turn_rate.empty()) at.turn_rate = turn_rate[i];
    return ping;
  };
  const std::size_t count = pose.size() / 6;
  const auto detail = decided_once([=] { return detail_of(requested(count / 2), count, threads); });
  return std::make_unique<Pings>(count, thread_count(threads), [requested, detail](std::size_t i) {
    MadePing ping = requested(i);
    ping.detail = detail();
    record_detail(ping.by->setup.simulation.sampling.detail, *ping.detail, ping.setup.run);
    return make(std::move(ping), 1);
  });
}

py::array array_of(const Soundings& soundings) {
  py::list fields;
  fields.append(py::make_tuple("position", "f8", py::make_tuple(3)));
  each_column(
      [&]<typename T>(const SoundingColumn& column, const std::vector<T>&) {
        fields.append(py::make_tuple(column.name, py::dtype::of<T>()));
      },
      soundings);
  py::array table(py::dtype::from_args(fields), std::vector{static_cast<py::ssize_t>(soundings.size())});
  std::size_t offset = 0;
  const auto fill = [&](const SoundingColumn&, const auto& column) {
    for (std::size_t i = 0; i < column.size(); ++i)
      std::memcpy(static_cast<char*>(table.mutable_data(i)) + offset, &column[i], sizeof(column[0]));
    offset += sizeof(column[0]);
  };
  fill({}, soundings.position);
  each_column(fill, soundings);
  return table;
}

}  // namespace insonify::python
