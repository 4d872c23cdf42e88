// SPDX-License-Identifier: BSD-3-Clause
// insonify._insonify: all that needs neither PCL nor VTK. _insonify_io is loaded by the first function that needs it.
#include <pybind11/eigen.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "core/error.hpp"
#include "core/message.hpp"
#include "files/final_names.hpp"
#include "python/binding_internal.hpp"
#include "scene/built_in_scenes.hpp"
#include "store/environment_file.hpp"
#include "store/sonar_keys.hpp"

namespace insonify::python {
namespace {

using namespace py::literals;
using Path = std::filesystem::path;

/// Error, and ArgumentError, which is a ValueError, too.
void add_errors(py::module_& m) {
  static PyObject* const error = PyErr_NewExceptionWithDoc(
      "insonify.Error", "What functions of insonify raise: what was wrong, where, and what to do.", nullptr, nullptr);
  static PyObject* const argument =
      PyErr_NewExceptionWithDoc("insonify.ArgumentError", "An argument breaks a rule; the text names it.",
                                py::make_tuple(py::handle(error), py::handle(PyExc_ValueError)).ptr(), nullptr);
  m.attr("Error") = py::handle(error);
  m.attr("ArgumentError") = py::handle(argument);
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      std::rethrow_exception(thrown);
    } catch (const insonify::Error& caught) {
      PyErr_SetString(caught.kind() == ErrorKind::argument ? argument : error,
                      message_line(with_final_names(in_keywords(caught.what()))).c_str());
    }
  });
}

void add_heads(py::module_& m) {
  Sonar any_sonar;
  Environment any_environment;
  py::class_<Sonar> sonar(m, "Sonar", "A sonar head; made by sonar(). It pickles, as all but scenes.");
  add_property(sonar, "name", "str, of the preset or file", [](const Sonar& s) { return s.spec.name; });
  add_property(sonar, "toml", "str: all keys, as a file", [](const Sonar& s) {
    Sonar written = s;
    return sonar_as_toml(s.spec) + (s.file.mounting.isZero() ? "" : keys_as_toml({mounting_key(written.file)}));
  });
  const auto find = [](const Path& name, const py::kwargs& keys) {
    Sonar found{find_sonar(name.string()), {}};
    found.spec = found.file.spec;
    set_keywords(keywords(found), keys, "sonar");
    require_valid(found.spec, "sonar");
    return found;
  };
  m.def(
      "sonar", find, "name"_a,
      signed_docs("sonar", "name", "A preset by name (see sonars()), or a file (.toml), with other values of its keys.",
                  keywords(any_sonar)));
  const auto names = [] {
    std::vector<std::string> all;
    for (const SonarFile& file : list_sonars()) all.push_back(file.spec.name);
    return all;
  };
  m.def("sonars", names, signed_docs("sonars", "", "Names of all presets."));
  const auto make = [](const std::optional<Path>& path, const py::kwargs& keys) {
    Environment environment = path ? load_environment(path->string()) : Environment{};
    set_keywords(keywords(environment), keys, "Environment");
    require_valid(environment, "Environment");
    return environment;
  };
  const auto signed_as = [&](const char* name, const char* fixed, const char* text) {
    return signed_docs(name, fixed, text, keywords(any_environment));
  };
  py::class_<Environment> environment(
      m, "Environment",
      signed_as("Environment", "path=None", "Water, surface, bottom, wind and noise around a scene."));
  environment.def(
      py::init(make), "path"_a = py::none(),
      signed_as("__init__", "self, path=None", "Standard water, or a file (.toml), with other values of its keys."));
  add_property(environment, "toml", "str: all keys, as a file", &environment_as_toml);
  add_pickling(sonar, environment);
}

constexpr const char* arrays_of_scene =
    "points, *, normals=None, areas=None, material=None, instance=None, triangles=None";

void add_scene(py::module_& m) {
  SceneOptions any;
  py::class_<Scene, std::shared_ptr<Scene>> scene(
      m, "Scene",
      signed_docs("Scene", arrays_of_scene,
                  "A scene that is prepared once for many pings, and may be edited between them.", keywords(any)));
  const auto of_arrays = [](const py::object& points, const py::object& normals, const py::object& areas,
                            const py::object& material, const py::object& instance, const py::object& triangles,
                            const py::kwargs& keys) {
    return scene_of_arrays(points, {normals, areas, material, instance, triangles}, keys);
  };
  scene.def(
      py::init(of_arrays), "points"_a, py::kw_only(), "normals"_a = py::none(), "areas"_a = py::none(),
      "material"_a = py::none(), "instance"_a = py::none(), "triangles"_a = py::none(),
      signed_docs("__init__", std::string("self, ") + arrays_of_scene,
                  "A scene of n surfels in world axes, z up, or of a mesh.\n\n"
                  "points: float (n, 3) [m], or corners of triangles\n"
                  "normals: float (n, 3), of any length; None: estimated\n"
                  "areas: float (n,) [m^2]; None: estimated\n"
                  "material: int (n,) labels, str (n,) names, or the name of one material for all; None: the default\n"
                  "instance: int (n,), the object of each surfel, for Ping.instance_image; 0: none\n"
                  "triangles: int (m, 3), corners of a mesh by rows of points, counter-clockwise from outside",
                  keywords(any)));
  scene.def("__len__", [](const Scene& s) { return s.now()->scene().size(); });
  add_property(scene, "origin", "float64 (3,) [m]: world place from which points count in single precision",
               [](const Scene& s) { return s.now()->scene().origin; });
  add_property(
      scene, "material_names",
      "list of str, by the numbers of materials, Ping.material_image and true_material; edits add to its end alone",
      [](const Scene& s) {
        std::vector<std::string> names;
        const auto now = s.now();
        for (const Material& material : now->scene().materials) names.push_back(material.name);
        return names;
      });
  add_property(scene, "given_instances", "dict of int: the id given to an object, by the number that stands for it",
               [](const Scene& s) { return s.instances.renumbered; });
  add_property(scene, "notes", "list of str: what was dropped, repaired or assumed on loading",
               [](const Scene& s) { return loading_notes(s.loaded->report); });
  const auto load = [](const Path& path, const py::kwargs& keys) { return io("load_scene")(path, **keys); };
  add_scene_editing(scene);
  m.def("load_scene", load, "path"_a,
        signed_docs("load_scene", "path, *, seed=None",
                    "A cloud, mesh, raster or scene of parts from a file, completed with what it lacks.\n\n"
                    "seed: int, of samples of meshes and of the scatters of a scene of parts",
                    keywords(any)));
  const auto built_in = [](const std::string& name, std::size_t points, std::uint64_t seed) {
    return std::make_shared<Scene>(LoadedScene{make_built_in_scene(name, {.points = points, .seed = seed}), {}});
  };
  m.def("make_scene", built_in, "name"_a, "points"_a = 200000, "seed"_a = 1,
        signed_docs("make_scene", "name, points=200000, seed=1",
                    "A built-in scene of about so many points: harbour, reef, river, plane, sphere, wall or poles."));
}

void add_simulator(py::module_& m) {
  Run any;
  py::class_<Simulator, std::shared_ptr<Simulator>> type(
      m, "PingSimulator",
      signed_docs("PingSimulator", "sonar, environment=...", "A head in an environment, checked once.", keywords(any)));
  type.def(py::init<const Sonar&, const Environment&, const py::kwargs&>(), "sonar"_a, "environment"_a = Environment{},
           signed_docs("__init__", "self, sonar, environment=...",
                       "A simulator of pings; what forms its beams is made in the first one.", keywords(any)));
  add_pickling(type);
  constexpr const char* one = "self, scene, position, yaw=0, pitch=0, roll=0";
  type.def(
      "ping", &ping, "scene"_a, "position"_a, "yaw"_a = 0, "pitch"_a = 0, "roll"_a = 0,
      signed_docs("ping", one,
                  "One ping, on all cores, without the GIL; Ctrl-C ends it.\n\n"
                  "position: float (3,) [m], world axes, z up; of the vehicle, if the sonar's file mounts the head\n"
                  "yaw, pitch, roll: float [deg], positive to port, nose down, starboard down",
                  keywords(any, true)));
  type.def(
      "pings", &pings, "scene"_a, "poses"_a, "threads"_a = 0,
      signed_docs("pings", "self, scene, poses, threads=0",
                  "An iterator over pings in the order of their poses: one on each core at a time, without the "
                  "GIL,\nand at most two for each core in memory. Ctrl-C ends it within a second.\n\n"
                  "poses: float (n, 6): x, y, z [m], yaw, pitch, roll [deg], as for ping(); the i-th has number i\n"
                  "time: float (n,) [s], draw: int (n,), by which parts of the scene stand; or one for all\n"
                  "velocity, turn_rate: float (n, 3) [m/s], [deg/s]; or (3,), one for all\n"
                  "threads: int; 0: all cores. The pings do not depend on it",
                  keywords(any, true)));
  type.def("plan", &plan, "scene"_a, "position"_a, "yaw"_a = 0, "pitch"_a = 0, "roll"_a = 0,
           signed_docs("plan", one,
                       "What the same ping() computes and leaves out: for each stage a dict of name, included, why and "
                       "bound_db,\nthe most that leaving it out costs [dB].",
                       keywords(any, true)));
  const auto next = [](Pings& of) {
    auto ping = next_of(of);
    return ping ? ping : throw py::stop_iteration();
  };
  py::class_<Pings>(m, "Pings", "An iterator over pings; made by PingSimulator.pings().")
      .def("__iter__", [](const py::object& self) { return self; })
      .def("__len__", &Pings::count)
      .def("__next__", next);
}

}  // namespace

PYBIND11_MODULE(_insonify, m) {
  m.attr("__version__") = INSONIFY_VERSION;
  py::options options;
  options.disable_function_signatures();  // signed_docs writes those that Python reads
  add_errors(m);
  add_heads(m);
  add_scene(m);
  add_ping(m);
  add_simulator(m);
}

}  // namespace insonify::python
