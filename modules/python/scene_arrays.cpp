// SPDX-License-Identifier: BSD-3-Clause
// Scenes that are made of arrays.
#include <algorithm>
#include <utility>

#include <fmt/format.h>
#include <pybind11/stl.h>

#include "core/error.hpp"
#include "python/binding_internal.hpp"

namespace insonify::python {
namespace {

std::vector<Eigen::Vector3d> vectors_of(const Numbers& numbers) {
  const auto* rows = reinterpret_cast<const Eigen::Vector3d*>(numbers.data());
  return {rows, rows + numbers.shape(0)};
}

/// Makes the scene of arrays that lack nothing, without PCL.
void complete(PointArrays& arrays) {
  SceneCloud& scene = arrays.loaded.scene;
  Eigen::Vector3d low = arrays.point.front(), high = low;
  for (const Eigen::Vector3d& p : arrays.point) low = low.cwiseMin(p), high = high.cwiseMax(p);
  scene.origin = ((low + high) / 2).array().round();
  scene.materials = arrays.options.materials;
  const int most = arrays.label.empty() ? 0 : *std::ranges::max_element(arrays.label);
  for (int label = 0; arrays.options.materials.empty() && label <= most; ++label)
    scene.materials.push_back(Material{.name = arrays.label.empty() ? "default" : fmt::format("label {}", label)});
  for (std::size_t i = 0; i < arrays.point.size(); ++i)
    add_surfel(scene, arrays.point[i], arrays.normal[i].normalized(), arrays.area[i],
               arrays.label.empty() ? arrays.options.material.value_or(0) : arrays.label[i]);
  arrays.loaded.report.points_read = scene.size();
}

/// Returns the corners of triangles, as many as rows.
std::vector<std::array<std::uint32_t, 3>> triangles_of(const py::object& given, py::ssize_t points) {
  const Numbers rows = numbers_of(given, "Scene: triangles", 3);
  const py::array flat = py::array(rows).attr("ravel")();
  const auto corners = whole_numbers<std::uint32_t>(flat, "Scene: triangles", -1, static_cast<double>(points - 1));
  if (corners.empty()) fail(ErrorKind::argument, "Scene: triangles has no row, must have one or more");
  std::vector<std::array<std::uint32_t, 3>> triangles(corners.size() / 3);
  for (std::size_t t = 0; t < triangles.size(); ++t)
    triangles[t] = {corners[3 * t], corners[3 * t + 1], corners[3 * t + 2]};
  return triangles;
}

void take_vectors(const GivenArrays& given, py::ssize_t n, PointArrays& arrays) {
  if (!given.normals.is_none()) arrays.normal = vectors_of(numbers_of(given.normals, "Scene: normals", 3, n));
  for (std::size_t i = 0; i < arrays.normal.size(); ++i)
    if (arrays.normal[i].isZero(0)) fail(ErrorKind::argument, "Scene: normals: row ", i, " is zero, has no direction");
  if (!given.areas.is_none()) {
    const Numbers areas = numbers_of(given.areas, "Scene: areas", 0, n);
    arrays.area.assign(areas.data(), areas.data() + n);
  }
  for (std::size_t i = 0; i < arrays.area.size(); ++i)
    if (arrays.area[i] < 0) fail(ErrorKind::argument, "Scene: areas[", i, "] = ", arrays.area[i], ", must be >= 0");
}

/// Returns the names of materials, one a row; empty for an array of numbers.
std::vector<std::string> names_of_materials(const py::object& material, py::ssize_t n) {
  const auto array = py::array::ensure(material);
  PyErr_Clear();
  if (!array || array.ndim() != 1 || std::string("UO").find(array.dtype().kind()) == std::string::npos) return {};
  if (array.shape(0) != n)
    fail(ErrorKind::argument, "Scene: material has ", array.shape(0), " names, must have ", n, ", one for each point");
  std::vector<std::string> names;
  for (const py::handle name : array) {
    if (!py::isinstance<py::str>(name))
      fail(ErrorKind::argument, "Scene: material[", names.size(), "] is a ", Py_TYPE(name.ptr())->tp_name,
           ", must be the name of a material");
    names.push_back(py::cast<std::string>(name));
  }
  return names;
}

/// Sets the labels by names of materials: those of the table, which is that of insonify unless `how` names another.
void take_names(const std::vector<std::string>& names, SceneOptions how, PointArrays& arrays) {
  how.material = names.front();
  arrays.options = load_options(how);
  arrays.options.material.reset();
  const std::vector<Material>& table = arrays.options.materials;
  for (const std::string& name : names) {
    auto found = std::ranges::find(table, name, &Material::name);
    if (found == table.end()) {
      how.material = name;
      load_options(how);  // names what is near
      fail(ErrorKind::argument, "Scene: material '", name, "' is unknown");
    }
    arrays.label.push_back(static_cast<std::uint16_t>(found - table.begin()));
  }
}

}  // namespace

std::shared_ptr<Scene> scene_of_arrays(const py::object& points, const GivenArrays& given, const py::kwargs& keys) {
  const Numbers positions = numbers_of(points, "Scene: points", 3);
  const py::ssize_t n = positions.shape(0);
  if (n == 0) fail(ErrorKind::argument, "Scene: points has no row, must have one or more");
  PointArrays arrays;
  arrays.point = vectors_of(positions);
  if (!given.triangles.is_none()) arrays.triangle = triangles_of(given.triangles, n);
  take_vectors(given, n, arrays);
  SceneOptions how;
  set_keywords(keywords(how), keys, "Scene");
  std::vector<std::string> names;
  if (py::isinstance<py::str>(given.material))
    how.material = py::cast<std::string>(given.material);
  else if (!given.material.is_none() && (names = names_of_materials(given.material, n)).empty())
    arrays.label = whole_numbers<std::uint16_t>(given.material, "Scene: material", n, 65533);
  std::vector<std::pair<std::uint32_t, std::uint32_t>> objects;
  if (!given.instance.is_none())
    for (const auto of : whole_numbers<std::uint32_t>(given.instance, "Scene: instance", n, 4294967294.0))
      objects.emplace_back(static_cast<std::uint32_t>(objects.size()), of);
  if (names.empty())
    arrays.options = load_options(how);
  else
    take_names(names, how, arrays);
  if (arrays.normal.empty() || arrays.area.empty() || !arrays.triangle.empty())
    io("complete")(py::capsule(&arrays));
  else
    complete(arrays);
  arrays.loaded.report.format = "arrays";
  const py::gil_scoped_release release;
  return std::make_shared<Scene>(std::move(arrays.loaded), std::move(how), number_instances(objects));
}

}  // namespace insonify::python
