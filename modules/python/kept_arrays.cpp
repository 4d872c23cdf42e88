// SPDX-License-Identifier: BSD-3-Clause
// Arrays of what a ping keeps beside its pictures.
#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include "core/error.hpp"
#include "python/binding_internal.hpp"

namespace insonify::python {
namespace {

using namespace py::literals;

/// The contributors of a ping, as contributors.h5 has them.
py::object contributors_of(const py::object& self) {
  const Contributors& all = py::cast<const MadePing&>(self).made.outputs.contributors;
  if (all.empty()) return py::none();
  const auto n = [](std::size_t count) { return static_cast<py::ssize_t>(count); };
  const std::vector<py::ssize_t> pixels{n(all.beams), n(all.bins)}, shape{n(all.beams), n(all.bins), n(all.per_pixel)};
  py::dict arrays("surfel"_a = view_of(all.surfel.data(), shape, self), "id"_a = view_of(all.id.data(), shape, self),
                  "share"_a = view_of(all.share.data(), shape, self),
                  "elevation"_a = view_of(all.elevation.data(), shape, self),
                  "material"_a = view_of(all.material.data(), shape, self),
                  "path"_a = view_of(reinterpret_cast<const std::uint8_t*>(all.path.data()), shape, self));
  if (!all.surfel_before.empty()) arrays["surfel_before"] = view_of(all.surfel_before.data(), shape, self);
  if (!all.total.empty()) arrays["total"] = view_of(all.total.data(), pixels, self);
  return arrays;
}

/// The series of the elements of a ping, with the times of its samples.
py::object elements_of(const py::object& self) {
  const ElementSeries& series = py::cast<const MadePing&>(self).made.outputs.elements;
  if (series.pressure.size() == 0) return py::none();
  return py::dict(
      "pressure"_a = view_of(series.pressure.data(), {series.pressure.rows(), series.pressure.cols()}, self),
      "start"_a = series.start, "step"_a = series.step);
}

py::dict poses_of_parts(const MadePing& ping) {
  py::dict poses;
  const auto add = [&](const std::string& name, const Pose& pose) { poses[name.c_str()] = pose.matrix(); };
  const PixelLabels& labels = ping.made.ping.labels;
  if (!ping.scene) {
    for (std::size_t p = 0; p < labels.views.size(); ++p) add(labels.part_names[p], labels.views[p].world_from_part);
    return poses;
  }
  if (!ping.arrangement && !ping.scene->moving) return poses;
  const auto scene = surfels_of(ping, ping.by->simulator->with(ping.setup.simulation));
  for (const ScenePart& part : scene->scene().parts)
    if (part.spacing > 0) add(part.name, part.world_from_part * Eigen::Translation3d(part.file_origin));
  return poses;
}

}  // namespace

void add_kept_arrays(py::class_<MadePing, std::shared_ptr<MadePing>>& ping) {
  add_property(
      ping, "contributors",
      "dict of (beams, bins, k) of the strongest surfels of every pixel: surfel, id (uint32; 4294967295: none),\n"
      "share, elevation [rad] (float32), material (uint16), path (uint8: direct, one bounce, two bounces, two\n"
      "surfaces), surfel_before if there are double echoes, total [Pa^2] (beams, bins); None unless keep has it",
      &contributors_of);
  add_property(
      ping, "elements",
      "dict of pressure, complex128 (elements, samples) [Pa], start and step [s] of the samples; None unless keep\n"
      "has elements",
      &elements_of);
  add_property(ping, "part_poses",
               "dict of float64 (4, 4) by name: poses of the axes of the files of the scene's parts", &poses_of_parts);
  add_property(ping, "absorption_db_per_m", "float [dB/m], at the head and the centre frequency",
               [](const MadePing& p) { return p.made.ping.absorption_db_per_m; });
}

}  // namespace insonify::python
