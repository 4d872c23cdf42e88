// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <array>
#include <cmath>
#include <functional>
#include <future>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include "core/error.hpp"
#include "core/ordered_work.hpp"
#include "returns/label_objects.hpp"
#include "run/ping_setup.hpp"
#include "scene/posed_scene.hpp"
#include "store/key_table.hpp"
#include "survey/parts_source.hpp"

namespace insonify {
class PartsOfPings;
}

// Private to python: the members of its classes, and the functions that read arguments. Errors name the argument.
namespace insonify::python {

namespace py = pybind11;

/// The keys of one object, bound to it.
struct Keywords {
  std::vector<Key> keys{};
  std::string main{};  ///< the section whose keys need no prefix
};
struct Sonar;
Keywords keywords(Sonar& sonar);
Keywords keywords(Environment& environment);
Keywords keywords(SceneOptions& options);
/// Returns the keywords of a simulator, or of one of its pings.
Keywords keywords(Run& run, bool of_ping = false);
/// Returns the text of an error with keywords of Python in place of options of the tool: "force=True" for "--force".
std::string in_keywords(const std::string& text);

/// Sets keys by keywords. A keyword is the key, after the name of its section unless that is the main one or no other
/// section has the key; the units m, Hz, s and m/s at its end may be left out. None leaves a key as it is. Throws
/// Error(argument), its text after `who`, for unknown keywords with the nearest one, and for values that break a rule.
void set_keywords(const Keywords& of, const py::dict& given, const std::string& who);
/// Returns `text` with one line for each keyword: name, unit, rule, help. The text lives as long as the module.
const char* with_docs(const char* text, const Keywords& of);
/// Returns the docs of a function with its signature, from which Python makes inspect.signature: `fixed` are the
/// arguments before the keywords, "scene, position, yaw=0". The text lives as long as the module.
const char* signed_docs(const std::string& name, const std::string& fixed, const char* text, const Keywords& of = {});

/// Returns finite numbers of shape (rows, columns), or (rows,) if columns is 0; rows = -1 allows any number of rows.
/// Throws Error(argument) with the argument, its value and the rule.
using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;
Numbers numbers_of(const py::handle& value, const std::string& name, py::ssize_t columns, py::ssize_t rows = -1);
/// Returns the whole numbers of an argument, one a row, each within 0 and `most`. Throws as numbers_of.
template <typename T>
std::vector<T> whole_numbers(const py::handle& value, const std::string& name, py::ssize_t rows, double most) {
  const Numbers numbers = numbers_of(value, name, 0, rows);
  std::vector<T> whole;
  for (py::ssize_t i = 0; i < numbers.shape(0); ++i) {
    const double x = numbers.at(i);
    if (x != std::floor(x) || x < 0 || x > most)
      fail(ErrorKind::argument, name, "[", i, "] = ", x, ", must be a whole number within 0 and ", most);
    whole.push_back(static_cast<T>(x));
  }
  return whole;
}
/// Returns the value of a keyword, and a Python object of such a value.
TomlValue value_of(const py::handle& value, const std::string& name);
py::object object_of(const TomlValue& value);

/// Returns the keywords by which a simulator gets the settings of a run.
std::vector<std::pair<std::string, TomlValue>> given_settings(const Run& run);

/// A sonar as its file describes it, and as keywords have changed it.
struct Sonar {
  SonarFile file;
  SonarSpec spec;
};

/// A cloud in arrays, which may be empty but for the points, and the scene that it becomes.
struct PointArrays {
  std::vector<Eigen::Vector3d> point, normal;            ///< [m]; normals of any length
  std::vector<std::array<std::uint32_t, 3>> triangle{};  ///< corners of a mesh; empty: a cloud
  std::vector<double> area;                              ///< [m^2]
  std::vector<std::uint16_t> label;                      ///< labels of materials
  LoadOptions options;
  LoadedScene loaded;
};

using By = std::shared_ptr<const struct Simulator>;
using Of = std::shared_ptr<const struct Scene>;
/// A scene of parts, which another extension has loaded, at moments.
struct MovingScene {
  std::shared_ptr<const PartsOfPings> parts;
  std::function<std::shared_ptr<const PreparedScene>(const SceneMoment&)> at;
  double begin = 0;  ///< time at which all parts are there [s]
  std::uint64_t seed = 1;
  std::function<std::shared_ptr<EditedScene>()> edit{};  ///< the same for edits; throws if parts move or are drawn
};

/// A scene that is prepared once for many pings.
struct Scene {
  Scene(LoadedScene loaded, SceneOptions how = {}, SceneInstances of = {});
  Scene(MovingScene of, LoadReport report, SceneOptions how);
  std::shared_ptr<const LoadedScene> loaded;      ///< the scene as loaded; of a scene of parts the report alone
  std::shared_ptr<const PreparedScene> prepared;  ///< the scene for pings; one of parts as it is when all are there
  std::optional<MovingScene> moving;
  SceneOptions options;  ///< how it was completed, for run.toml
  SceneInstances instances;
  std::shared_ptr<EditedScene> edited{};  ///< what it is since its first edit

  /// Returns the scene as pings find it now.
  std::shared_ptr<const PreparedScene> now() const;
};
/// Returns the scene for edits, which the first call makes. Throws Error(argument) if its parts move or are drawn anew.
EditedScene& edited(Scene& scene);
/// Returns the id that the next part gets.
std::uint32_t next_id(Scene& scene);
/// Adds a part that is there already; its axes stand at `pose`. Returns its id in instance images.
std::uint32_t add_part(Scene& scene, PlacedPart part, const py::object& pose, const py::object& velocity,
                       const py::object& turn_rate);
/// Adds edits and what a scene holds to its class.
void add_scene_editing(py::class_<Scene, std::shared_ptr<Scene>>& type);

/// A head in an environment with its options; throws Error(argument) as set_up_ping, but for the pose.
struct Simulator {
  Simulator(const Sonar& sonar, const Environment& environment, const py::kwargs& keys);
  /// A head that is set up already, of a mission.
  Simulator(Sonar sonar, PingSetup setup);
  Sonar sonar;
  std::vector<std::pair<std::string, TomlValue>> given{};  ///< its keywords
  PingSetup setup;                                         ///< without an event
  std::optional<PingSimulator> simulator;
};

/// A ping, and what saving it needs.
struct MadePing {
  By by;
  Of scene;
  PingSetup setup;                 ///< that of the simulator, with seed, place and what to keep
  std::optional<Choice> detail{};  ///< SamplingSettings::detail, if it was decided for many pings
  SimulatedPing made{};
  std::shared_ptr<const EditedScene> edited{};  ///< the scene if it was edited, and what it held
  std::shared_ptr<const SceneArrangement> arrangement{};
  SceneInstances copied{};           ///< instances of a ping without its scene
  std::vector<std::string> noted{};  ///< notes of a ping without its scene
  std::string head{};                ///< name of the head of a mission; empty: a simulator's

  /// Returns the instances of the surfels of its scene.
  const SceneInstances& instances() const { return scene ? scene->instances : copied; }
};
/// Adds pickling to the classes of heads, environments, simulators and pings.
void add_pickling(py::class_<Sonar>& sonar, py::class_<Environment>& environment);
void add_pickling(py::class_<Simulator, std::shared_ptr<Simulator>>& simulator);
void add_pickling(py::class_<MadePing, std::shared_ptr<MadePing>>& ping);
/// Adds arrays of what a ping keeps beside its pictures.
void add_kept_arrays(py::class_<MadePing, std::shared_ptr<MadePing>>& ping);
using Pings = OrderedWork<std::shared_ptr<MadePing>>;
/// Returns the surfels of a ping: all of a cloud, those of a mesh that the beams resolve, parts at their positions at that
/// time.
std::shared_ptr<const PreparedScene> surfels_of(const MadePing& ping, const PingSimulator& simulator);

/// Adds a property that is read by get(object).
template <typename Class, typename Get>
void add_property(Class& type, const char* name, const char* docs, Get get) {
  type.def_property_readonly(name, get, docs);
}
/// Adds the class of pings.
void add_ping(py::module_& m);

/// Returns a function of the second extension, which loads PCL and VTK.
py::object io(const char* function);

/// Adds the class of missions to the second extension.
void add_missions(py::module_& m);

/// Adds the functions of images with labels to the second extension.
void add_views(py::module_& m);

/// The arrays that a scene is made of; None: not given.
struct GivenArrays {
  py::object normals, areas, material, instance, triangles;
};
std::shared_ptr<Scene> scene_of_arrays(const py::object& points, const GivenArrays& given, const py::kwargs& keys);
/// Returns one ping at a position [m] and angles [deg], or its plan as a dict for each stage.
std::shared_ptr<MadePing> ping(const By& by, const Of& scene, const py::object& position, double yaw, double pitch,
                               double roll, const py::kwargs& keys);
py::list plan(const By& by, const Of& scene, const py::object& position, double yaw, double pitch, double roll,
              const py::kwargs& keys);
/// Returns pings at rows of position and angles; time and draw may be given for each.
std::unique_ptr<Pings> pings(const By& by, const Of& scene, const py::object& poses, int threads,
                             const py::kwargs& keys);
/// Returns a function with the result of `decide`: the first thread that asks decides, the others wait.
template <typename Decide>
auto decided_once(const Decide& decide) {
  return [result = std::async(std::launch::deferred, decide).share()]() -> const auto& { return result.get(); };
}
/// Returns the next ping, or nullptr after the last. Waits without the GIL, which it takes only to test for signals.
std::shared_ptr<MadePing> next_of(Pings& pings);

/// Returns the numbers at `data` as a read-only array, without a copy; `owner` lives as long as the array.
template <typename T>
py::array view_of(const T* data, const std::vector<py::ssize_t>& shape, const py::handle& owner) {
  py::array_t<T> array(shape, data, owner);
  py::detail::array_proxy(array.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  return array;
}
/// Returns soundings as a structured array: position [m] (three float64) and the columns of files.
py::array array_of(const Soundings& soundings);

}  // namespace insonify::python
