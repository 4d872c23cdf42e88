// SPDX-License-Identifier: BSD-3-Clause
// insonify._insonify_io: what needs PCL, VTK and the files of runs.
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "core/error.hpp"
#include "python/binding_internal.hpp"
#include "run/run_settings.hpp"
#include "run/scene_reach.hpp"
#include "run_scenes/parts_of_pings.hpp"
#include "run_scenes/run_folder.hpp"
#include "scene_io/pcl_bridge.hpp"
#include "tool/run/vtk_pictures.hpp"
#include "view/ping_record.hpp"

namespace insonify::python {
namespace {

using namespace py::literals;
using Path = std::filesystem::path;

std::shared_ptr<Scene> scene_of_parts(const std::shared_ptr<const PartsOfPings>& parts, const SceneOptions& how,
                                      std::uint64_t seed) {
  MovingScene moving{parts, [parts](const SceneMoment& moment) { return parts->whole_at(moment); },
                     parts->scene().begin(), seed};
  moving.edit = [parts]() -> std::shared_ptr<EditedScene> {
    const SceneParts& scene = parts->scene();
    if (!scene.still())
      fail(ErrorKind::argument, parts->file().path,
           ": parts of it move or are drawn anew, so that it cannot be edited; load a scene without them, and move "
           "parts by Scene.move");
    std::vector<PlacedPart> all = parts->resting_with_tiles();
    for (PlacedPart& part : scene.others_at(0, 0)) all.push_back(std::move(part));
    return std::make_shared<EditedScene>(std::move(all), scene.materials());
  };
  return std::make_shared<Scene>(std::move(moving), parts->report(), how);
}

/// Adds what another scene holds as a part; a mesh is sampled `spacing` [m] apart, 0: as its size says.
std::uint32_t add(Scene& scene, const Scene& body, const std::optional<std::string>& name,
                  const std::optional<std::string>& label, const py::object& pose, const py::object& velocity,
                  const py::object& turn_rate, double spacing) {
  const bool of_parts = body.moving || body.edited;
  LoadedScene loaded = of_parts ? LoadedScene{body.now()->scene(), {}} : *body.loaded;
  PlacedPart part{.name = name.value_or("")};
  if (!name) part.name = fmt::format("part {}", next_id(scene));
  PartFile how;
  how.path = part.name, how.spacing = spacing;
  SceneBody own = body_of_loaded(std::move(loaded), how, false);
  part.label = label.value_or(part.name), part.cloud = own.cloud;
  part.file_origin = -own.centre, part.size = own.size;
  return add_part(scene, std::move(part), pose, velocity, turn_rate);
}

std::shared_ptr<Scene> load(const Path& path, const py::kwargs& keys) {
  SceneOptions how;
  how.path = path.string();
  std::uint64_t seed = 1;
  Keywords all = keywords(how);
  all.keys.push_back(keys_of({seed_setting(seed)}).front());
  set_keywords(all, keys, "load_scene");
  const py::gil_scoped_release release;
  const auto scene = open_scene(how, {{seed, {}}});
  if (const PartsOfPings* parts = scene->parts()) return scene_of_parts({scene, parts}, how, seed);
  return std::make_shared<Scene>(scene->take_whole({}), how, instances_of_scene(how.path));
}

/// Completes arrays as load_scene completes files.
void complete(const py::capsule& capsule) {
  PointArrays& arrays = *capsule.get_pointer<PointArrays>();
  using Field = pcl::PCLPointField;
  struct Row {
    double position[3];
    float normal[3], area;
    std::uint32_t id, label;
  };
  pcl::PCLPointCloud2 cloud;
  const auto add = [&](bool is_there, const char* name, std::size_t offset, std::uint8_t type) {
    pcl::PCLPointField field;
    field.name = name, field.offset = static_cast<std::uint32_t>(offset), field.datatype = type, field.count = 1;
    if (is_there) cloud.fields.push_back(field);
  };
  const bool normals = !arrays.normal.empty(), areas = !arrays.area.empty(), labels = !arrays.label.empty();
  for (const std::size_t axis : {0, 1, 2}) {
    add(true, (const char*[]){"x", "y", "z"}[axis], 8 * axis, Field::FLOAT64);
    add(normals, (const char*[]){"normal_x", "normal_y", "normal_z"}[axis], offsetof(Row, normal) + 4 * axis,
        Field::FLOAT32);
  }
  add(areas, "area", offsetof(Row, area), Field::FLOAT32);
  add(labels, "label", offsetof(Row, label), Field::UINT32);
  add(true, "id", offsetof(Row, id), Field::UINT32);
  std::vector<Row> rows;
  for (std::size_t i = 0; i < arrays.point.size(); ++i) {
    const Eigen::Vector3d p = arrays.point[i], n = normals ? arrays.normal[i] : p;
    rows.push_back({{p.x(), p.y(), p.z()},
                    {float(n.x()), float(n.y()), float(n.z())},
                    areas ? static_cast<float>(arrays.area[i]) : 0,
                    static_cast<std::uint32_t>(i),
                    labels ? arrays.label[i] : 0U});
  }
  cloud.height = 1, cloud.width = static_cast<std::uint32_t>(rows.size()), cloud.point_step = sizeof(Row);
  cloud.row_step = cloud.width * cloud.point_step;
  const auto* bytes = reinterpret_cast<const std::uint8_t*>(rows.data());
  cloud.data.assign(bytes, bytes + cloud.row_step);
  const py::gil_scoped_release release;
  if (arrays.triangle.empty()) {
    arrays.loaded = from_pcl(cloud, arrays.options);
    return;
  }
  pcl::PolygonMesh mesh;
  mesh.cloud = std::move(cloud);
  for (const auto& corners : arrays.triangle) {
    pcl::Vertices& polygon = mesh.polygons.emplace_back();
    polygon.vertices.assign(corners.begin(), corners.end());
  }
  arrays.loaded = from_pcl(mesh, arrays.options);
}

/// A ping as the tool has it before its folder is written.
struct ToolPing {
  PingSetup setup;  ///< with the notes of its head at its depth, and of its scene
  PingSimulator simulator;
  PingScene scene;
};

ToolPing tool_ping_of(const MadePing& ping) {
  const Scene& of = *ping.scene;
  const Simulator& by = *ping.by;
  PingSetup setup = ping.setup;
  const PingEvent& event = setup.event;
  setup.notes =
      set_up_head(by.sonar.file, by.sonar.spec, setup.environment, event.world_from_head.translation().z()).notes;
  if (std::string note = number_note(event, setup.run.placement); !note.empty()) setup.notes.push_back(std::move(note));
  PingSimulator simulator = by.simulator->with(setup.simulation);
  const auto pinged = surfels_of(ping, simulator);
  const bool moves = of.moving && !ping.arrangement;
  const SceneCloud& whole = moves || ping.arrangement ? pinged->scene() : of.loaded->scene;
  PingScene scene{pinged, of.loaded->report, sampled_positions(whole, event.world_from_head),
                  scene_json(of.loaded->report, pinged->scene())};
  Bounds box = bounds(whole);
  if (moves) {
    const SceneMoment moment{event.time, static_cast<std::uint64_t>(setup.run.placement.draw)};
    box = of.moving->parts->box_at(moment), scene.json["parts"] = of.moving->parts->parts_json(moment);
  }
  for (std::string& note : fit_notes(whole, box, setup)) setup.notes.push_back(std::move(note));
  return {std::move(setup), std::move(simulator), std::move(scene)};
}

/// Returns what the tool notes on the same ping, but for what it notes on loading.
std::vector<std::string> notes(const MadePing& ping) {
  if (!ping.scene) return ping.noted;
  const py::gil_scoped_release release;
  const ToolPing sent = tool_ping_of(ping);
  std::vector<std::string> all = sent.setup.notes;
  for (std::string& note : ping_notes(ping.made, sent.setup, sent.scene.positions)) all.push_back(std::move(note));
  return all;
}

void save(const MadePing& ping, const Path& path, bool force, bool picture) {
  if (!ping.scene)
    fail(ErrorKind::argument,
         "save: the ping was unpickled or is of a mission, and has no scene; save it in the process that made it, "
         "and run a mission into a folder by insonify survey");
  const py::gil_scoped_release release;
  const Scene& scene = *ping.scene;
  ToolPing sent = tool_ping_of(ping);
  Run& run = sent.setup.run;
  run.scene = scene.options;
  if (ping.arrangement) run.scene.path.clear();  // no file holds the edits
  run.output.folder = path.string(), run.output.force = force, run.output.no_picture = !picture;
  if (const std::uint64_t seed = run.simulation.seed;
      scene.moving && !ping.arrangement && scene.moving->parts->is_random() && scene.moving->seed != seed)
    fail(ErrorKind::argument, "save: seed = ", seed, ", but the scene is drawn with seed ", scene.moving->seed,
         ", and a run has one seed; load it by load_scene(path, seed=", seed, ")");
  const tool::VtkPictures pictures;
  RunObserver silent;
  RunFolder folder(sent.setup, {run.scene.path, run.head.sonar}, pictures, silent);
  if (folder.options_for(sent.scene.scene->scene()).outputs.contributor_sink)
    folder.take(ping.made.outputs.contributors, 0);
  folder.write(ping.made, sent.simulator.plan(*sent.scene.scene, sent.setup.event), sent.scene, scene.instances);
  folder.commit();
}

void draw(const MadePing& ping, const Path& path, int width, int height, const std::optional<std::string>& title,
          const std::string& colour_map, double min_db, double max_db, bool dark) {
  const py::gil_scoped_release release;
  const Ping& made = ping.made.ping;
  PictureOptions options;
  options.width = width, options.height = height, options.dark = dark, options.trim = true;
  options.title = title ? *title : picture_title(ping.by->setup.head.name, made);
  options.colour_map = colour_map, options.min_db = min_db, options.max_db = max_db;
  show_fan(level_image(made, Tvg{40, made.absorption_db_per_m}), options, path.string());
}

}  // namespace

PYBIND11_MODULE(_insonify_io, m) {
  const PictureOptions usual;
  m.def("load_scene", &load, "path"_a);
  m.def("complete", &complete, "arrays"_a);
  m.def("add", &add, "scene"_a, "body"_a, "name"_a, "label"_a, "pose"_a, "velocity"_a, "turn_rate"_a, "spacing"_a);
  m.def("notes", &notes, "ping"_a);
  m.def("save", &save, "ping"_a, "path"_a, "force"_a, "picture"_a);
  m.def("draw_fan", &draw, "ping"_a, "path"_a, py::kw_only(), "width"_a = usual.width, "height"_a = usual.height,
        "title"_a = py::none(), "colour_map"_a = usual.colour_map, "min_db"_a = usual.min_db, "max_db"_a = usual.max_db,
        "dark"_a = false);
  add_missions(m);
  add_views(m);
}

}  // namespace insonify::python
