// SPDX-License-Identifier: BSD-3-Clause
// Images of pings with labels, for views() of insonify/views.py.
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>
#include <utility>

#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include "core/error.hpp"
#include "core/text.hpp"
#include "python/binding_internal.hpp"
#include "returns/looks.hpp"
#include "returns/quantise.hpp"
#include "tool/dataset/labelled_image.hpp"

namespace insonify::python {
namespace {

using namespace py::literals;

constexpr int least_pixels = 20;  // pixels of an object, as data sets have it

/// How a batch of views looks.
struct ViewForm {
  bool fan;
  int width, height;
  double min_contrast;
  bool box_dark;
  std::vector<std::string> stuff;  ///< classes that have no objects
};

struct SeenObject {
  Annotation where;
  std::optional<double> contrast;
  bool boxed;
};

/// A view before it becomes arrays.
struct Shown {
  Grid<std::uint8_t> image, mask;
  Grid<std::uint16_t> instance;
  Grid<float> elevation;
  GreyWindow window;
  std::vector<SeenObject> objects;
  tool::ObjectsOf of;
  std::vector<std::string> classes;
};

/// Returns the raster of a fan that fits into width x height pixels.
FanRaster fitting_raster(const BeamFan& fan, const RangeGate& gate, int width, int height) {
  FanRaster raster = fan_raster(fan, gate, width);
  for (int columns = width; raster.beam.rows() > height;) {
    columns =
        std::min<int>(columns - 1, static_cast<int>(static_cast<Eigen::Index>(columns) * height / raster.beam.rows()));
    raster = fan_raster(fan, gate, columns);
  }
  return raster;
}

/// Returns a picture in the middle of one of the form's size.
template <typename Value>
Grid<Value> in_form(const Grid<Value>& picture, const ViewForm& form, Value beside) {
  if (!form.fan) return picture;
  Grid<Value> all = Grid<Value>::Constant(form.height, form.width, beside);
  all.block((form.height - picture.rows()) / 2, (form.width - picture.cols()) / 2, picture.rows(), picture.cols()) =
      picture;
  return all;
}

/// Returns the window of 60 dB whose top, a multiple of 5 dB, one pixel in 1000 exceeds.
GreyWindow usual_window(const Grid<float>& level_db) {
  std::vector<float> levels(level_db.data(), level_db.data() + level_db.size());
  const auto top = levels.end() - 1 - static_cast<std::ptrdiff_t>(levels.size() / 1000);
  std::nth_element(levels.begin(), top, levels.end());
  const double max_db = 5 * std::ceil(static_cast<double>(*top) / 5);
  return {max_db - 60, max_db};
}

/// Returns the elevation from which the surface of every pixel is received; NaN where it shows none. In a fan it is that
/// of the loudest cell of its class among those about the middle of the pixel.
Grid<float> elevations_of(const Ping& ping, const tool::LabelledSamples& samples, const Grid<std::uint8_t>& shown,
                          const FanRaster* raster) {
  constexpr float none = std::numeric_limits<float>::quiet_NaN();
  const auto is_surface = [](std::uint8_t category) { return category > tool::shadow_class; };
  if (!raster) {
    const Grid<float> elevation = polar_picture(ping.labels.elevation, ping.fan);
    return shown.unaryExpr(is_surface).select(elevation, none);
  }
  Grid<float> found = Grid<float>::Constant(shown.rows(), shown.cols(), none);
  const Eigen::Index beams = samples.category.rows(), bins = samples.category.cols();
  for (Eigen::Index i = 0; i < found.size(); ++i) {
    if (raster->beam(i) < 0 || !is_surface(shown(i))) continue;
    float loudest = -std::numeric_limits<float>::infinity();
    for (Eigen::Index b = std::max(0, raster->beam(i) - 1); b < std::min<Eigen::Index>(beams, raster->beam(i) + 2); ++b)
      for (Eigen::Index n = std::max(0, raster->bin(i) - 2); n < std::min<Eigen::Index>(bins, raster->bin(i) + 3); ++n)
        if (samples.category(b, n) == shown(i) && samples.level_db(b, n) > loudest)
          loudest = samples.level_db(b, n), found(i) = ping.labels.elevation(b, n);
  }
  return found;
}

/// Lists the objects of an image, and which of them have a box.
std::vector<SeenObject> seen_objects(const tool::LabelledImage& image, const tool::ObjectsOf& of,
                                     const FanRaster* raster, const ViewForm& form) {
  std::vector<SeenObject> objects;
  for (Annotation a : annotations_of(image.map)) {
    if (const auto known = of.classes.find(a.instance); known != of.classes.end()) a.category = known->second;
    const std::optional<double> contrast = tool::contrast_db(image.level_db, image.map.instance, a, raster);
    const bool boxed =
        !contrast || *contrast >= form.min_contrast || (form.box_dark && -*contrast >= form.min_contrast);
    if (raster) {
      a.left += static_cast<int>((form.width - image.level_db.cols()) / 2);
      a.top += static_cast<int>((form.height - image.level_db.rows()) / 2);
    }
    objects.push_back({std::move(a), contrast, boxed});
  }
  return objects;
}

/// Returns the numbers of classes; throws Error(argument) for a name that no class has.
std::set<std::uint8_t> numbers_of_stuff(const std::vector<std::string>& stuff,
                                        const std::vector<std::string>& classes) {
  std::set<std::uint8_t> numbers;
  for (const std::string& name : stuff) {
    const auto at = std::ranges::find(classes, name);
    if (at == classes.end())
      fail(ErrorKind::argument, "views: stuff = ", name, " is no class of the scene; it has ", joined(classes, ", "));
    numbers.insert(static_cast<std::uint8_t>(at - classes.begin()));
  }
  return numbers;
}

Shown shown_of(const Ping& ping, const SceneInstances& instances, const ViewForm& form,
               const std::optional<std::pair<double, double>>& window) {
  Shown shown;
  const std::optional<FanRaster> raster =
      form.fan ? std::optional(fitting_raster(ping.fan, ping.gate, form.width, form.height)) : std::nullopt;
  const FanRaster* const at = raster ? &*raster : nullptr;
  const bool labelled = !ping.labels.empty();
  Grid<float> level = apply_tvg(shown_level_db(ping), ping.gate, Tvg{40, ping.absorption_db_per_m});
  tool::LabelledSamples samples{level,
                                Grid<std::uint8_t>::Zero(level.rows(), level.cols()),
                                Grid<std::uint16_t>::Zero(level.rows(), level.cols()),
                                {}};
  tool::ImageRules rules{tool::least_label_share, {tool::shadow_class}, least_pixels, {}};
  if (labelled) {
    shown.classes = tool::class_names(ping.labels);
    rules.stuff.merge(numbers_of_stuff(form.stuff, shown.classes));
    samples = tool::labelled_samples(ping, std::move(level), instances, shown.classes, rules);
  }
  const tool::LabelledImage image =
      at ? tool::fan_image(samples, ping, *at, rules) : tool::polar_image(samples, ping.fan);
  shown.window = window ? GreyWindow{window->first, window->second} : usual_window(image.level_db);
  shown.image = in_form(quantise_8(image.level_db, shown.window), form, std::uint8_t{0});
  if (!labelled) return shown;
  shown.objects = seen_objects(image, samples.objects, at, form);
  shown.elevation =
      in_form(elevations_of(ping, samples, image.map.category, at), form, std::numeric_limits<float>::quiet_NaN());
  shown.mask = in_form(image.map.category, form, std::uint8_t{0});
  shown.instance = in_form(image.map.instance, form, std::uint16_t{0});
  shown.of = samples.objects;
  return shown;
}

/// Turns an object into a dict; what is not known is None.
py::dict dict_of(const SeenObject& object, const Shown& shown, const PixelLabels& labels) {
  const Annotation& a = object.where;
  py::dict seen("id"_a = a.instance, "class"_a = shown.classes.at(a.category), "name"_a = py::none(),
                "pose"_a = py::none(), "size_m"_a = py::none(), "visible_share"_a = py::none(),
                "box"_a = py::make_tuple(a.left, a.top, a.width, a.height), "contrast_db"_a = object.contrast,
                "boxed"_a = object.boxed, "pixels"_a = a.area);
  const auto part = shown.of.parts.find(a.instance);
  if (part == shown.of.parts.end()) return seen;
  const PartView& view = labels.views.at(part->second);
  seen["name"] = labels.part_names.at(part->second);
  seen["pose"] = view.world_from_part.matrix();
  seen["size_m"] = view.size, seen["visible_share"] = view.visible_share;
  return seen;
}

py::dict view_of_ping(const MadePing& made, bool fan, int width, int height, double min_contrast, bool box_dark,
                      const std::vector<std::string>& stuff, const std::optional<std::pair<double, double>>& window) {
  const ViewForm form{fan, width, height, min_contrast, box_dark, stuff};
  std::optional<Shown> shown;
  Ping row;
  {
    const py::gil_scoped_release release;
    const Ping& ping = made.made.ping;
    if (tool::rows_of(ping) > 1) row = tool::row_of(ping, tool::rows_of(ping) / 2);
    shown = shown_of(tool::rows_of(ping) > 1 ? row : ping, made.instances(), form, window);
  }
  const auto array = [](const auto& grid) -> py::object {
    return grid.size() == 0 ? py::object(py::none()) : py::cast(grid);
  };
  py::list objects;
  std::vector<std::array<int, 4>> boxes;
  for (const SeenObject& object : shown->objects) {
    objects.append(dict_of(object, *shown, made.made.ping.labels));
    const Annotation& a = object.where;
    if (object.boxed) boxes.push_back({a.left, a.top, a.width, a.height});
  }
  return py::dict("image"_a = array(shown->image), "mask"_a = array(shown->mask),
                  "instances"_a = array(shown->instance), "elevation"_a = array(shown->elevation), "boxes"_a = boxes,
                  "objects"_a = objects, "class_names"_a = shown->classes,
                  "window"_a = py::make_tuple(shown->window.min_db, shown->window.max_db));
}

/// Returns the display cells that views of a simulator need: rows of polar images, or half a pixel of a fan.
int cells_of_view(const Simulator& by, bool fan, int width, int height) {
  if (!fan) return height;
  const SonarHead& head = by.setup.head;
  BeamFan row = head.fan;
  const std::vector<FanRow> rows = fan_rows(head.fan);
  const std::vector<std::size_t>& beams = rows[rows.size() / 2].beams;
  row.azimuth.clear(), row.elevation.clear();
  for (const std::size_t b : beams)
    row.azimuth.push_back(head.fan.azimuth[b]), row.elevation.push_back(head.fan.elevation[b]);
  const double pixel = fitting_raster(row, head.gate, width, height).metres_per_pixel;
  return static_cast<int>(std::min(65536.0, std::ceil((head.gate.max_range - head.gate.min_range) / (0.5 * pixel))));
}

/// Returns the number of beams of the images of a simulator.
std::size_t beams_of_view(const Simulator& by) {
  const std::vector<FanRow> rows = fan_rows(by.setup.head.fan);
  return rows[rows.size() / 2].beams.size();
}

}  // namespace

void add_views(py::module_& m) {
  m.def("view_of_ping", &view_of_ping, "ping"_a, "fan"_a, "width"_a, "height"_a, "min_contrast"_a, "box_dark"_a,
        "stuff"_a, "window"_a);
  m.def("cells_of_view", &cells_of_view, "simulator"_a, "fan"_a, "width"_a, "height"_a);
  m.def("beams_of_view", &beams_of_view, "simulator"_a);
}

}  // namespace insonify::python
