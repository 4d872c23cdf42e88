// SPDX-License-Identifier: BSD-3-Clause
// The class of pings.
#include <pybind11/eigen.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "core/error.hpp"
#include "python/binding_internal.hpp"
#include "returns/looks.hpp"

namespace insonify::python {
namespace {

using namespace py::literals;

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
py::list parts_of(const PixelLabels& labels, std::uint32_t before) {
  using namespace py::literals;
  const auto both = [](const PartView::Extent& extent) { return py::make_tuple(extent.least, extent.most); };
  py::list all;
  for (std::size_t p = 0; p < labels.views.size(); ++p) {
    const PartView& view = labels.views[p];
    all.append(py::dict("part"_a = labels.part_names[p], "class"_a = labels.part_labels[p], "number"_a = before + p + 1,
                        "world_from_part"_a = view.world_from_part.matrix(), "scale"_a = view.scale,
                        "size_m"_a = view.size, "visible_share"_a = view.visible_share,
                        "azimuth_rad"_a = both(view.azimuth), "elevation_rad"_a = both(view.elevation),
                        "range_m"_a = both(view.range)));
  }
  return all;
}

void add_pictures(py::class_<MadePing, std::shared_ptr<MadePing>>& type) {
  add_property(type, "pressure",
               "complex64 (beams, bins) [Pa], analytic baseband; a view of the ping, as all its pictures",
               &picture_of<&Ping::pressure>);
  add_property(type, "layers", "dict of complex64 (beams, bins) [Pa] by kind of echo, if layers is set",
               [](const py::object& p) {
                 py::dict all;
                 for (const Layer& layer : py::cast<const MadePing&>(p).made.ping.layers)
                   all[layer.name.c_str()] = picture(layer.pressure, p);
                 return all;
               });
  add_property(type, "intensity", "float32 (beams, bins) [Pa^2], mean over looks; None unless looks_... ask for it",
               &picture_of<&Ping::intensity>);
  add_property(type, "unknown", "uint8 (beams, bins), 1 at holes of the scan; None unless keep has mask",
               &picture_of<&Ping::unknown>);
  add_property(type, "display_cells",
               "bool, whether pressure holds display cells: roots of mean intensities, without phase",
               [](const MadePing& p) { return p.made.ping.display_cells; });
  const auto level = [](const MadePing& p, double floor_db) { return shown_level_db(p.made.ping, floor_db); };
  type.def("level_db", level, "floor_db"_a = silence_db,
           signed_docs("level_db", "self, floor_db=-200.0",
                       "float32 (beams, bins) [dB re 1 uPa rms], of intensity if there are looks, as pictures of the "
                       "tool show it;\nfloor_db: float [dB], of what is less"));
  add_property(type, "material_image", "uint16 (beams, bins): class of every pixel; 65535: no surface, 65534: shadow",
               [](const MadePing& p) { return material_image(labels_of(p, "material_image")); });
  const auto of_cells = [&type](const char* name, const char* about, auto map) {
    add_property(type, name, about, [map](const py::object& p) {
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
  add_property(type, "class_names", "list of str, by the numbers of material_image, as label_names of the cube",
               [](const MadePing& p) { return labels_of(p, "class_names").names; });
  add_property(type, "part_names",
               "list of str: the part whose number in instance_image is its place + 1; empty: no parts",
               [](const MadePing& p) { return labels_of(p, "part_names").part_names; });
  add_property(
      type, "parts",
      "list of dict: of each part its pose, its scale and size along the axes of its file, the share of it that the\n"
      "head sees, and the extents of all that it would see of the part alone; NaN: none",
      [](const MadePing& p) { return parts_of(labels_of(p, "parts"), p.instances().most); });
  add_property(
      type, "instance_image",
      "uint32 (beams, bins): object of every pixel; 0: none. The number of an object is the same in all pings of a\n"
      "scene; connected pixels without a given object have numbers above all these",
      [](const MadePing& p) { return instance_image(labels_of(p, "instance_image"), p.instances()); });
}

}  // namespace

void add_ping(py::module_& m) {
  py::class_<MadePing, std::shared_ptr<MadePing>> type(m, "Ping", "What one transmission gave.");
  add_pictures(type);
  add_kept_arrays(type);
  add_pickling(type);
  add_property(type, "range", "float64 (bins,) [m], centres of the bins", [](const MadePing& p) {
    const RangeGate& gate = p.made.ping.gate;
    return Eigen::VectorXd::NullaryExpr(gate.bins(), [&](Eigen::Index bin) { return gate.centre(bin); }).eval();
  });
  add_property(type, "azimuth", "float64 (beams,) [rad], positive to port", &angles_of<&BeamFan::azimuth>);
  add_property(type, "elevation", "float64 (beams,) [rad], positive up", &angles_of<&BeamFan::elevation>);
  add_property(
      type, "soundings",
      "structured (n,): position [m] (3,), level_db [dB re 1 uPa], range [m], azimuth, elevation [rad], ping, beam, "
      "bin, true_elevation [rad], true_surfel, true_material",
      [](const MadePing& p) { return array_of(p.made.soundings); });
  add_property(type, "world_from_head", "float64 (4, 4) [m]; head axes are x forward, y to port, z up",
               [](const MadePing& p) { return p.setup.event.world_from_head.matrix(); });
  add_property(type, "head", "str: name of the head in its mission, else of the sonar",
               [](const MadePing& p) { return p.head.empty() ? p.by->sonar.spec.name : p.head; });
  add_property(type, "number", "int", [](const MadePing& p) { return p.setup.event.number; });
  add_property(type, "time", "float [s], of transmission", [](const MadePing& p) { return p.setup.event.time; });
  add_property(type, "seed", "int, of all random numbers", [](const MadePing& p) { return p.setup.simulation.seed; });
  add_property(type, "sound_speed", "float [m/s], at the head",
               [](const MadePing& p) { return p.made.ping.sound_speed; });
  add_property(type, "notes", "list of str: what the tool notes on the same ping: limits of its accuracy, silence",
               [](const py::object& p) { return io("notes")(p); });
  const auto save = [](const py::object& self, const std::filesystem::path& path, bool force, bool picture) {
    io("save")(self, path, force, picture);
  };
  type.def("save", save, "path"_a, "force"_a = false, "picture"_a = true,
           signed_docs("save", "self, path, force=False, picture=True",
                       "Writes the run folder of `insonify ping`, with the same bytes but for seconds and memory of "
                       "its manifest.\n\n"
                       "force: bool, replace an existing folder\npicture: bool, draw fan.png"));
  const auto draw = [](const py::object& ping, const std::filesystem::path& path, const py::kwargs& keys) {
    io("draw_fan")(ping, path, **keys);
  };
  m.def("draw_fan", draw, "ping"_a, "path"_a,
        signed_docs("draw_fan",
                    "ping, path, *, width=1400, height=1050, title=None, colour_map='bronze', min_db=..., max_db=..., "
                    "dark=False",
                    "Draws a ping as a fan into a PNG, range-compensated as fan.png, without a display.\n\n"
                    "width, height: int [pixels]; title, colour_map: str; min_db, max_db: float [dB]; dark: bool"));
}

}  // namespace insonify::python
