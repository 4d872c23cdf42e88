// SPDX-License-Identifier: BSD-3-Clause
// The pings of a mission file over a scene of any kind.
#include <pybind11/eigen.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "python/binding_internal.hpp"
#include "run_scenes/open_scene.hpp"
#include "run_scenes/scene_source_of.hpp"
#include "survey/simulate_survey.hpp"

namespace insonify::python {
namespace {

using namespace py::literals;

/// A mission with its open scene and the simulators of its heads.
class LoadedMission {
 public:
  /// Throws as load_mission, set_up_survey_head, scene_source_of and draw_poses.
  explicit LoadedMission(const std::string& path) : file_(load_mission(path)) {
    std::vector<PingSimulator> simulators;
    bool labels = false;
    for (std::size_t h = 0; h < file_.sonars.size(); ++h) {
      PingSetup setup = set_up_survey_head(file_, h);
      labels |= setup.simulation.outputs.labels;
      Sonar sonar{find_sonar(setup.run.head.sonar), setup.spec};
      heads_.push_back(std::make_shared<Simulator>(std::move(sonar), std::move(setup)));
      simulators.push_back(*heads_.back()->simulator);
    }
    scene_ = scene_source_of(file_);
    draw_poses(file_, *scene_);
    if (labels) instances_ = instances_of_scene(file_.scene);
    survey_.emplace(file_.mission, simulators, SurveySettings{file_.randomise, file_.seed});
  }

  const Survey& survey() const { return *survey_; }
  /// Returns the survey in which each head has decided whether its pings merge surfels.
  Survey decided(int threads) const { return survey_->decided(*scene_, threads); }
  /// Returns the head of a ping by its name.
  const std::string& head_of(const SurveyPing& ping) const { return file_.mission.heads[ping.head].name; }

  /// Returns a ping as `decided` makes it, with place and motion as its cube has them. Throws Error naming the ping.
  std::shared_ptr<MadePing> make(const Survey& decided, const SurveyPing& of) const try {
    PingOutcome outcome = decided.simulate(of, *scene_);
    const By& by = heads_[of.head];
    auto made = std::make_shared<MadePing>(MadePing{by, nullptr, by->setup});
    made->setup.event = {outcome.ping.world_from_head, outcome.ping.motion, of.time, of.number};
    made->head = head_of(of), made->copied = instances_, made->noted = by->setup.notes;
    for (const PingNote& note : outcome.notes) made->noted.push_back(note.text);
    made->made.ping = std::move(outcome.ping), made->made.soundings = std::move(outcome.soundings);
    return made;
  } catch (const Error& error) {
    fail(error.kind(), file_.path, ": ping ", of.number, " of head ", head_of(of), ": ", error.what());
  }

 private:
  MissionFile file_;
  std::vector<By> heads_;
  std::shared_ptr<const SceneSource> scene_;
  SceneInstances instances_;  ///< those of the scene, if pings have labels
  std::optional<Survey> survey_;
};

std::unique_ptr<Pings> pings_of(const std::shared_ptr<const LoadedMission>& mission, std::int64_t first,
                                std::optional<std::int64_t> count, int threads) {
  const auto all = static_cast<std::int64_t>(mission->survey().pings().size());
  if (threads < 0 || threads > 1024) fail(ErrorKind::argument, "pings: threads = ", threads, ", must be 0 to 1024");
  if (first < 0 || first > all) fail(ErrorKind::argument, "pings: first = ", first, ", must be 0 to ", all);
  if (count && (*count < 0 || *count > all - first))
    fail(ErrorKind::argument, "pings: count = ", *count, ", must be 0 to ", all - first, ", those from ping ", first);
  const auto decided = decided_once([mission, threads] { return mission->decided(threads); });
  const auto make = [mission, decided, first](std::size_t i) {
    return mission->make(decided(), mission->survey().pings()[static_cast<std::size_t>(first) + i]);
  };
  return std::make_unique<Pings>(static_cast<std::size_t>(count.value_or(all - first)), thread_count(threads), make);
}

/// Returns position and axes of the head at each ping, (n, 4, 4).
py::array_t<double> poses_of(const LoadedMission& mission) {
  const auto& pings = mission.survey().pings();
  py::array_t<double> poses({static_cast<py::ssize_t>(pings.size()), py::ssize_t{4}, py::ssize_t{4}});
  for (std::size_t i = 0; i < pings.size(); ++i)
    Eigen::Map<Eigen::Matrix<double, 4, 4, Eigen::RowMajor>>(poses.mutable_data(static_cast<py::ssize_t>(i))) =
        mission.survey().event_of(pings[i]).world_from_head.matrix();
  return poses;
}

/// Returns get(ping) of each ping.
template <typename Get>
auto of_each(const LoadedMission& mission, const Get& get) {
  std::vector<std::decay_t<decltype(get(SurveyPing{}))>> all;
  for (const SurveyPing& ping : mission.survey().pings()) all.push_back(get(ping));
  return all;
}

}  // namespace

void add_missions(py::module_& m) {
  const auto load = [](const std::filesystem::path& path) {
    const py::gil_scoped_release release;
    return std::make_shared<LoadedMission>(path.string());
  };
  py::class_<LoadedMission, std::shared_ptr<LoadedMission>>(m, "Mission")
      .def(py::init(load), "path"_a)
      .def("heads", [](const LoadedMission& of) { return of_each(of, [&](const auto& p) { return of.head_of(p); }); })
      .def("times", [](const LoadedMission& of) { return of_each(of, [](const auto& ping) { return ping.time; }); })
      .def("poses", &poses_of)
      .def("pings", &pings_of, "first"_a, "count"_a, "threads"_a);
}

}  // namespace insonify::python
