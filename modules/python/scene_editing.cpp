// SPDX-License-Identifier: BSD-3-Clause
// The arrays and parts of a scene, and its edits.
#include <filesystem>
#include <utility>

#include <pybind11/eigen.h>
#include <pybind11/stl.h>

#include "core/error.hpp"
#include "core/pose.hpp"
#include "core/units.hpp"
#include "python/binding_internal.hpp"

namespace insonify::python {
namespace {

using namespace py::literals;
using SceneClass = py::class_<Scene, std::shared_ptr<Scene>>;

/// Returns three numbers; zeros for None.
Eigen::Vector3d vector_of(const py::object& value, const char* name) {
  if (value.is_none()) return Eigen::Vector3d::Zero();
  const Numbers numbers = numbers_of(value, name, 0, 3);
  return {numbers.at(0), numbers.at(1), numbers.at(2)};
}

/// Returns the pose of x, y, z [m], yaw, pitch, roll [deg], or of a matrix (4, 4).
Pose pose_of(const py::object& value) {
  const auto array = py::array::ensure(value);
  PyErr_Clear();
  if (array && array.ndim() == 2) {
    const Numbers m = numbers_of(value, "Scene: pose", 4, 4);
    Pose pose;
    for (int row = 0; row < 4; ++row)
      for (int column = 0; column < 4; ++column) pose.matrix()(row, column) = m.at(row, column);
    if (pose.matrix().row(3) != Eigen::RowVector4d(0, 0, 0, 1))
      fail(ErrorKind::argument, "Scene: pose: the last row of a matrix must be 0, 0, 0, 1");
    return pose;
  }
  const Numbers p = numbers_of(value, "Scene: pose", 0, 6);
  return pose_from_yaw_pitch_roll({p.at(0), p.at(1), p.at(2)}, radians(p.at(3)), radians(p.at(4)), radians(p.at(5)));
}

/// Returns the number that instance images add to the ids of parts: those of given objects come first.
std::uint32_t before_parts(const Scene& scene) { return scene.instances.most; }

std::uint32_t own_id(const Scene& scene, std::int64_t id) {
  const std::int64_t own = id - before_parts(scene);
  if (own < 1) fail(ErrorKind::argument, "Scene: no part has the id ", id, "; parts lists them");
  return static_cast<std::uint32_t>(own);
}

/// Returns the surfels of a scene that is edited from now on, as one captured part with its random numbers.
PlacedPart ground_of(const Scene& scene) {
  const std::string stem = std::filesystem::path(scene.options.path).stem().string();
  PlacedPart ground{.name = stem.empty() ? "scene" : stem, .captured = true, .key = 0};
  ground.cloud = {scene.loaded, &scene.loaded->scene};
  if (ground.cloud->facet.empty() && !ground.cloud->part_of) return ground;
  SceneCloud cloud = *ground.cloud;
  cloud.facet.clear(), cloud.part_of.reset();
  ground.cloud = std::make_shared<const SceneCloud>(std::move(cloud));
  return ground;
}

template <typename Number, typename Rows>
py::array rows_of_three(const Rows& rows, const Eigen::Vector3d& shift) {
  py::array_t<Number> array({static_cast<py::ssize_t>(rows.size()), py::ssize_t{3}});
  auto all = array.mutable_unchecked();
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (int axis = 0; axis < 3; ++axis)
      all(static_cast<py::ssize_t>(i), axis) = static_cast<Number>(double{rows[i][axis]} + shift[axis]);
  return array;
}

template <typename Number>
py::array copy_of(const std::vector<Number>& numbers) {
  return py::array_t<Number>(static_cast<py::ssize_t>(numbers.size()), numbers.data());
}

py::list parts_of_scene(const Scene& scene) {
  py::list all;
  const auto now = scene.now();
  const std::vector<ScenePart>& parts = now->scene().parts;
  std::vector<std::size_t> surfels(parts.size(), 0);
  for (const std::uint16_t part : now->scene().part) ++surfels[part];
  for (std::size_t p = 0; p < parts.size(); ++p) {
    if (surfels[p] == 0) continue;
    const Pose pose = parts[p].world_from_part * Eigen::Translation3d(parts[p].file_origin);
    all.append(py::dict("id"_a = before_parts(scene) + p + 1, "name"_a = parts[p].name, "class"_a = parts[p].label,
                        "pose"_a = pose.matrix(), "velocity"_a = parts[p].velocity, "surfels"_a = surfels[p]));
  }
  return all;
}

}  // namespace

std::shared_ptr<const PreparedScene> Scene::now() const { return edited ? edited->scene_of(edited->now()) : prepared; }

EditedScene& edited(Scene& scene) {
  if (!scene.edited)
    scene.edited = scene.moving
                       ? scene.moving->edit()
                       : std::make_shared<EditedScene>(std::vector{ground_of(scene)}, scene.loaded->scene.materials);
  return *scene.edited;
}

std::uint32_t next_id(Scene& scene) {
  EditedScene& parts = edited(scene);
  const std::size_t all = parts.scene_of(parts.now())->scene().parts.size();
  return before_parts(scene) + static_cast<std::uint32_t>(all) + 1;
}

std::uint32_t add_part(Scene& scene, PlacedPart part, const py::object& pose, const py::object& velocity,
                       const py::object& turn_rate) {
  part.place_file(pose_of(pose), vector_of(velocity, "Scene: velocity"),
                  radians(1) * vector_of(turn_rate, "Scene: turn_rate"));
  return before_parts(scene) + edited(scene).add(std::move(part));
}

void add_scene_editing(SceneClass& type) {
  const auto move = [](Scene& scene, std::int64_t id, const py::object& pose, const py::object& velocity,
                       const py::object& turn_rate) {
    edited(scene).move(own_id(scene, id), pose_of(pose), vector_of(velocity, "Scene: velocity"),
                       radians(1) * vector_of(turn_rate, "Scene: turn_rate"));
  };
  type.def("move", move, "id"_a, "pose"_a, py::kw_only(), "velocity"_a = py::none(), "turn_rate"_a = py::none(),
           signed_docs("move", "self, id, pose, *, velocity=None, turn_rate=None",
                       "Places the axes of a part's file at a pose; it costs the time of the part's own surfels.\n\n"
                       "id: int, as add() returned it, or of parts\n"
                       "pose: x, y, z [m], yaw, pitch, roll [deg], or float (4, 4)\n"
                       "velocity, turn_rate: float (3,) [m/s] and [deg/s], world axes; None: at rest"));
  type.def(
      "remove", [](Scene& scene, std::int64_t id) { edited(scene).remove(own_id(scene, id)); }, "id"_a,
      signed_docs("remove", "self, id", "Takes a part out; the ids and classes of others stay."));
  add_property(type, "points", "float64 (n, 3) [m], centres of the surfels in the world, as they are now",
               [](const Scene& s) {
                 const auto now = s.now();
                 return rows_of_three<double>(now->scene().point, now->scene().origin);
               });
  add_property(type, "normals", "float32 (n, 3), of the surfels",
               [](const Scene& s) { return rows_of_three<float>(s.now()->scene().normal, Eigen::Vector3d::Zero()); });
  add_property(type, "areas", "float32 (n,) [m^2]", [](const Scene& s) { return copy_of(s.now()->scene().area); });
  add_property(type, "materials", "uint16 (n,), index into material_names",
               [](const Scene& s) { return copy_of(s.now()->scene().material); });
  add_property(
      type, "parts",
      "list of dict: of each part that is there its id, name, class, pose (4, 4), velocity and surfels; empty for\n"
      "a scene that is no scene of parts and was not edited",
      &parts_of_scene);
}

}  // namespace insonify::python
