// SPDX-License-Identifier: BSD-3-Clause
// insonify._insonify: all that needs neither PCL nor VTK. _insonify_io is loaded by the first function that needs it.
#include <pybind11/eigen.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "core/error.hpp"
#include "core/message.hpp"
#include "files/final_names.hpp"
#include "python/binding_internal.hpp"
#include "returns/looks.hpp"
#include "scene/built_in_scenes.hpp"
#include "store/environment_file.hpp"
#include "store/sonar_keys.hpp"

namespace insonify::python {
namespace {

using namespace py::literals;
using Path = std::filesystem::path;

/// Adds a property that is read by get(object).
template <typename Class, typename Get>
void add(Class& type, const char* name, const char* docs, Get get) {
  type.def_property_readonly(name, get, docs);
}

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
                      message_line(with_final_names(caught.what())).c_str());
    }
  });
}

void add_heads(py::module_& m) {
  Sonar any_sonar;
  Environment any_environment;
  py::class_<Sonar> sonar(m, "Sonar", "A sonar head; made by sonar().");
  add(sonar, "name", "str, of the preset or file", [](const Sonar& s) { return s.spec.name; });
  add(sonar, "toml", "str: all keys, as a file", [](const Sonar& s) {
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
  m.def("sonar", find, "name"_a,
        with_docs("A preset by name (see sonars()), or a file (.toml), with other values of its keys.",
                  keywords(any_sonar)));
  const auto names = [] {
    std::vector<std::string> all;
    for (const SonarFile& file : list_sonars()) all.push_back(file.spec.name);
    return all;
  };
  m.def("sonars", names, "Names of all presets.");
  const auto make = [](const std::optional<Path>& path, const py::kwargs& keys) {
    Environment environment = path ? load_environment(path->string()) : Environment{};
    set_keywords(keywords(environment), keys, "Environment");
    require_valid(environment, "Environment");
    return environment;
  };
  py::class_<Environment> environment(m, "Environment", "Water, surface, bottom, wind and noise around a scene.");
  environment.def(
      py::init(make), "path"_a = py::none(),
      with_docs("Standard water, or a file (.toml), with other values of its keys.", keywords(any_environment)));
  add(environment, "toml", "str: all keys, as a file", &environment_as_toml);
}

void add_scene(py::module_& m) {
  SceneOptions any;
  py::class_<Scene, std::shared_ptr<Scene>> scene(m, "Scene", "A scene that is prepared once for many pings.");
  scene.def(py::init(&scene_of_arrays), "points"_a, py::kw_only(), "normals"_a = py::none(), "areas"_a = py::none(),
            "material"_a = py::none(), "instance"_a = py::none(),
            with_docs("A scene of n surfels in world axes, z up.\n\n"
                      "points: float (n, 3) [m]\n"
                      "normals: float (n, 3), of any length; None: estimated\n"
                      "areas: float (n,) [m^2]; None: estimated\n"
                      "material: int (n,) labels, or the name of one material for all; None: the default one\n"
                      "instance: int (n,), the object of each surfel, for Ping.instance_image; 0: none",
                      keywords(any)));
  scene.def("__len__", [](const Scene& s) { return s.prepared->scene().size(); });
  add(scene, "origin", "float64 (3,) [m]: world place from which points count in single precision",
      [](const Scene& s) { return s.prepared->scene().origin; });
  add(scene, "material_names",
      "list of str, by the numbers of Ping.material_image and of true_material: the same for all pings of a scene",
      [](const Scene& s) {
        std::vector<std::string> names;
        for (const Material& material : s.prepared->scene().materials) names.push_back(material.name);
        return names;
      });
  add(scene, "given_instances", "dict of int: the id given to an object, by the number that stands for it",
      [](const Scene& s) { return s.instances.renumbered; });
  add(scene, "notes", "list of str: what was dropped, repaired or assumed on loading",
      [](const Scene& s) { return loading_notes(s.loaded->report); });
  const auto load = [](const Path& path, const py::kwargs& keys) { return io("load_scene")(path, **keys); };
  m.def("load_scene", load, "path"_a,
        with_docs("A cloud, mesh, raster or scene of parts from a file, completed with what it lacks.\n\n"
                  "seed: int, of samples of meshes and of the scatters of a scene of parts",
                  keywords(any)));
  const auto built_in = [](const std::string& name, std::size_t points, std::uint64_t seed) {
    return std::make_shared<Scene>(LoadedScene{make_built_in_scene(name, {.points = points, .seed = seed}), {}});
  };
  m.def("make_scene", built_in, "name"_a, "points"_a = 200000, "seed"_a = 1,
        "A built-in scene of about so many points: harbour, reef, river, plane, sphere, wall or poles.");
}

void add_simulator(py::module_& m) {
  PingOptions any;
  py::class_<Simulator, std::shared_ptr<Simulator>> type(m, "PingSimulator", "A head in an environment, checked once.");
  type.def(py::init<const Sonar&, const Environment&, const py::kwargs&>(), "sonar"_a, "environment"_a = Environment{},
           with_docs("A simulator of pings; what forms its beams is made in the first one.", keywords(any)));
  type.def("ping", &ping, "scene"_a, "position"_a, "yaw"_a = 0, "pitch"_a = 0, "roll"_a = 0,
           with_docs("One ping, on all cores, without the GIL; Ctrl-C ends it.\n\n"
                     "position: float (3,) [m], world axes, z up; of the vehicle, if the sonar's file mounts the head\n"
                     "yaw, pitch, roll: float [deg], positive to port, nose down, starboard down",
                     keywords(any, true)));
  type.def(
      "pings", &pings, "scene"_a, "poses"_a, "threads"_a = 0,
      with_docs("An iterator over pings in the order of their poses: one on each core at a time, without the GIL,\n"
                "and at most two for each core in memory. Ctrl-C ends it within a second.\n\n"
                "poses: float (n, 6): x, y, z [m], yaw, pitch, roll [deg], as for ping(); the i-th has number i\n"
                "time: float (n,) [s], draw: int (n,), by which parts of the scene stand; or one for all\n"
                "threads: int; 0: all cores. The pings do not depend on it",
                keywords(any, true)));
  type.def("plan", &plan, "scene"_a, "position"_a, "yaw"_a = 0, "pitch"_a = 0, "roll"_a = 0,
           "What the same ping() computes and leaves out: for each stage a dict of name, included, why and bound_db,\n"
           "the most that leaving it out costs [dB].");
  const auto next = [](Pings& of) {
    auto ping = next_of(of);
    return ping ? ping : throw py::stop_iteration();
  };
  py::class_<Pings>(m, "Pings", "An iterator over pings; made by PingSimulator.pings().")
      .def("__iter__", [](const py::object& self) { return self; })
      .def("__len__", &Pings::count)
      .def("__next__", next);
}

/// A picture of a ping, without a copy; None if it is empty.
template <typename T>
py::object picture(const Grid<T>& grid, const py::handle& ping) {
  return grid.size() == 0 ? py::none() : py::object(view_of(grid.data(), {grid.rows(), grid.cols()}, ping));
}
template <auto Member>
py::object picture_of(const py::object& self) {
  return picture(py::cast<const MadePing&>(self).made.ping.*Member, self);
}

template <auto Member>
py::array angles_of(const py::object& self) {
  const std::vector<double>& angles = py::cast<const MadePing&>(self).made.ping.fan.*Member;
  return view_of(angles.data(), {static_cast<py::ssize_t>(angles.size())}, self);
}

const PixelLabels& labels_of(const MadePing& ping, const char* property) {
  if (ping.made.ping.labels.empty())
    fail(ErrorKind::argument, property,
         ": is there only if the ping keeps labels, by keep=\"labels\" or keep=\"contributors\"");
  return ping.made.ping.labels;
}

/// How the head sees each part of the scene, by the keys of meta.jsonl of data sets.
py::list parts_of(const PixelLabels& labels) {
  using namespace py::literals;
  const auto both = [](const PartView::Extent& extent) { return py::make_tuple(extent.least, extent.most); };
  py::list all;
  for (std::size_t p = 0; p < labels.views.size(); ++p) {
    const PartView& view = labels.views[p];
    all.append(py::dict("part"_a = labels.part_names[p], "class"_a = labels.part_labels[p], "number"_a = p + 1,
                        "world_from_part"_a = view.world_from_part.matrix(), "scale"_a = view.scale,
                        "size_m"_a = view.size, "visible_share"_a = view.visible_share,
                        "azimuth_rad"_a = both(view.azimuth), "elevation_rad"_a = both(view.elevation),
                        "range_m"_a = both(view.range)));
  }
  return all;
}

void add_pictures(py::class_<MadePing, std::shared_ptr<MadePing>>& type) {
  add(type, "pressure", "complex64 (beams, bins) [Pa], analytic baseband; a view of the ping, as all its pictures",
      &picture_of<&Ping::pressure>);
  add(type, "layers", "dict of complex64 (beams, bins) [Pa] by kind of echo, if layers is set",
      [](const py::object& p) {
        py::dict all;
        for (const Layer& layer : py::cast<const MadePing&>(p).made.ping.layers)
          all[layer.name.c_str()] = picture(layer.pressure, p);
        return all;
      });
  add(type, "intensity", "float32 (beams, bins) [Pa^2], mean over looks; None unless looks_... ask for it",
      &picture_of<&Ping::intensity>);
  add(type, "unknown", "uint8 (beams, bins), 1 at holes of the scan; None unless keep has mask",
      &picture_of<&Ping::unknown>);
  add(type, "display_cells", "bool, whether pressure holds display cells: roots of mean intensities, without phase",
      [](const MadePing& p) { return p.made.ping.display_cells; });
  const auto level = [](const MadePing& p, double floor_db) { return shown_level_db(p.made.ping, floor_db); };
  type.def(
      "level_db", level, "floor_db"_a = silence_db,
      "float32 (beams, bins) [dB re 1 uPa rms], of intensity if there are looks, as pictures of the tool show it;\n"
      "floor_db: float [dB], of what is less");
  add(type, "material_image", "uint16 (beams, bins): class of every pixel; 65535: no surface, 65534: shadow",
      [](const MadePing& p) { return material_image(labels_of(p, "material_image")); });
  const auto of_cells = [&type](const char* name, const char* about, auto map) {
    add(type, name, about, [map](const py::object& p) {
      return picture(labels_of(py::cast<const MadePing&>(p), "labels of cells").*map, p);
    });
  };
  of_cells("label_share", "float32 (beams, cells), share of the class in the energy of the cell", &PixelLabels::share);
  of_cells("label_elevation",
           "float32 (beams, cells) [rad], from which the strongest surface of the class is heard, positive up; None\n"
           "unless keep has labels, as second_image and second_share",
           &PixelLabels::elevation);
  of_cells("second_image", "uint16 (beams, cells): class with the most energy among the others; 65535: none",
           &PixelLabels::second);
  of_cells("second_share", "float32 (beams, cells), its share", &PixelLabels::second_share);
  add(type, "class_names", "list of str, by the numbers of material_image, as label_names of the cube",
      [](const MadePing& p) { return labels_of(p, "class_names").names; });
  add(type, "part_names", "list of str: the part whose number in instance_image is its place + 1; empty: no parts",
      [](const MadePing& p) { return labels_of(p, "part_names").part_names; });
  add(type, "parts",
      "list of dict: of each part its pose, its scale and size along the axes of its file, the share of it that the\n"
      "head sees, and the extents of all that it would see of the part alone; NaN: none",
      [](const MadePing& p) { return parts_of(labels_of(p, "parts")); });
  add(type, "instance_image",
      "uint32 (beams, bins): object of every pixel; 0: none. The number of an object is the same in all pings of a\n"
      "scene; connected pixels without a given object have numbers above all these",
      [](const MadePing& p) { return instance_image(labels_of(p, "instance_image"), p.scene->instances); });
}

void add_ping(py::module_& m) {
  py::class_<MadePing, std::shared_ptr<MadePing>> type(m, "Ping", "What one transmission gave.");
  add_pictures(type);
  add(type, "range", "float64 (bins,) [m], centres of the bins", [](const MadePing& p) {
    const RangeGate& gate = p.made.ping.gate;
    return Eigen::VectorXd::NullaryExpr(gate.bins(), [&](Eigen::Index bin) { return gate.centre(bin); }).eval();
  });
  add(type, "azimuth", "float64 (beams,) [rad], positive to port", &angles_of<&BeamFan::azimuth>);
  add(type, "elevation", "float64 (beams,) [rad], positive up", &angles_of<&BeamFan::elevation>);
  add(type, "soundings",
      "structured (n,): position [m] (3,), level_db [dB re 1 uPa], range [m], azimuth, elevation [rad], ping, beam, "
      "bin, true_elevation [rad], true_surfel, true_material",
      [](const MadePing& p) { return array_of(p.made.soundings); });
  add(type, "world_from_head", "float64 (4, 4) [m]; head axes are x forward, y to port, z up",
      [](const MadePing& p) { return p.event.world_from_head.matrix(); });
  add(type, "number", "int", [](const MadePing& p) { return p.event.number; });
  add(type, "time", "float [s], of transmission", [](const MadePing& p) { return p.event.time; });
  add(type, "seed", "int, of all random numbers", [](const MadePing& p) { return p.simulation.seed; });
  add(type, "sound_speed", "float [m/s], at the head", [](const MadePing& p) { return p.made.ping.sound_speed; });
  add(type, "notes", "list of str: what the tool notes on the same ping: limits of its accuracy, silence",
      [](const py::object& p) { return io("notes")(p); });
  const auto save = [](const py::object& self, const Path& path, bool force, bool picture) {
    io("save")(self, path, force, picture);
  };
  type.def(
      "save", save, "path"_a, "force"_a = false, "picture"_a = true,
      "Writes the run folder of `insonify ping`, with the same bytes but for seconds and memory of its manifest.\n\n"
      "force: bool, replace an existing folder\npicture: bool, draw fan.png");
  const auto draw = [](const py::object& ping, const Path& path, const py::kwargs& keys) {
    io("draw_fan")(ping, path, **keys);
  };
  m.def("draw_fan", draw, "ping"_a, "path"_a,
        "Draws a ping as a fan into a PNG, range-compensated as fan.png, without a display.\n\n"
        "Keywords: width, height: int [pixels]; title, colour_map: str; min_db, max_db: float [dB]; dark: bool");
}

}  // namespace

PYBIND11_MODULE(_insonify, m) {
  m.attr("__version__") = INSONIFY_VERSION;
  add_errors(m);
  add_heads(m);
  add_scene(m);
  add_ping(m);
  add_simulator(m);
}

}  // namespace insonify::python
