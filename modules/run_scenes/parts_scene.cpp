// SPDX-License-Identifier: BSD-3-Clause
#include "run_scenes/parts_scene.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "core/units.hpp"
#include "run/ping_setup.hpp"
#include "run_scenes/open_scene.hpp"
#include "scene/posed_scene.hpp"
#include "survey/mesh_source.hpp"

namespace insonify {
namespace {

using Eigen::Vector3d;
using nlohmann::ordered_json;

/// Adds file and line of the scene to what `body` refuses; what was wrong with an argument is wrong with the file.
template <typename Body>
auto at_line_of_scene(const std::string& path, int line, const Body& body) {
  try {
    return body();
  } catch (const Error& error) {
    const ErrorKind kind = error.kind() == ErrorKind::argument ? ErrorKind::content : error.kind();
    fail(kind, path, ":", line, ": ", error.what());
  }
}

Bounds box_of(const PlacedPart& part) {
  const Bounds own = bounds(*part.cloud);
  if (part.captured) return own;
  Bounds box;
  for (int corner = 0; corner < 8; ++corner) {
    const Vector3d at((corner & 1 ? own.max : own.min).x(), (corner & 2 ? own.max : own.min).y(),
                      (corner & 4 ? own.max : own.min).z());
    const Vector3d there = part.world_from_part * at;
    box = {box.min.cwiseMin(there), box.max.cwiseMax(there)};
  }
  return box;
}

ordered_json vector_json(const Vector3d& v) { return {v.x() + 0.0, v.y() + 0.0, v.z() + 0.0}; }  // no -0

/// The file of a name: that of a part, or of the bodies NAME-1, NAME-2, ...
std::string file_of_name(const std::map<std::string, std::string>& files, const std::string& name) {
  if (const auto found = files.find(name); found != files.end()) return found->second;
  const auto body = files.find(name.substr(0, name.rfind('-')));
  return body == files.end() ? "" : body->second;
}

}  // namespace

SceneBody PartsScene::load_body(const PartFile& file, const std::string& name, bool captured, PartFiles& files) {
  file_of_[name] = file.path;
  SceneBody body = file.kind == SceneKind::tiles && captured ? read_ground(file, name) : files.body_of(file, captured);
  body.name = name;
  return body;
}

/// Reads the ground of captured tiles beneath what is to rest: a ball that holds all of it.
SceneBody PartsScene::read_ground(const PartFile& file, const std::string& name) {
  require_no_loading_options(scene_options_of(file), "is prepared already");
  const TiledScene& tiled = tiles_.try_emplace(name, file.path).first->second;
  const Bounds& bed = tiled.info().box;
  report_.points_read += tiled.info().surfels;
  take_system_of(file.path, tiled.info().system, report_.meaning);
  Bounds rests;
  const auto add = [&](const Eigen::Vector2d& p) {
    for (const double z : {bed.min.z(), bed.max.z()}) {
      rests.min = rests.min.cwiseMin(Vector3d(p.x(), p.y(), z));
      rests.max = rests.max.cwiseMax(Vector3d(p.x(), p.y(), z));
    }
  };
  for (const ScenePartEntry& part : file_.parts)
    if (!part.placement.captured && part.placement.rest != PartRest::none) add(part.placement.position.head<2>());
  for (const SceneScatterEntry& scatter : file_.scatters)
    for (const Eigen::Vector2d& corner : scatter.rule.area) add(corner);
  constexpr double beyond = 10;  // [m] that a part may be wide
  const bool any = rests.min.x() <= rests.max.x();
  const Vector3d middle = any ? Vector3d((rests.min + rests.max) / 2) : Vector3d((bed.min + bed.max) / 2);
  const double radius = any ? (rests.max - rests.min).norm() / 2 + beyond : 0;
  TileSelection near = tiled.select(region_around(middle, radius));
  if (near.tiles.empty()) near = tiled.select(region_around(middle, radius + (bed.max - bed.min).norm()));
  SceneCloud cloud = tiled.load(near, 0, options_.threads);
  return {name, "", std::make_shared<const SceneCloud>(std::move(cloud))};
}

PartsScene::PartsScene(const std::string& path, const PartsOptions& options)
    : file_(load_scene_file(path)), options_(options) {
  report_.path = path, report_.format = "insonify scene of parts";
  PartFiles files(options_, report_);
  std::vector<PartDefinition> parts;
  for (const ScenePartEntry& entry : file_.parts)
    at_line_of_scene(path, entry.file.line, [&] {
      SceneBody body = load_body(entry.file, entry.name, entry.placement.captured, files);
      body.label = entry.label;
      parts.push_back({std::move(body), entry.placement});
    });
  std::vector<SceneScatter> scatters;
  for (const SceneScatterEntry& entry : file_.scatters) {
    SceneScatter& scatter = scatters.emplace_back();
    scatter.rule = entry.rule;
    for (std::size_t f = 0; f < entry.files.size(); ++f)
      at_line_of_scene(path, entry.line, [&] {
        SceneBody body = load_body(entry.files[f], entry.names[f], false, files);
        body.label = entry.labels[f];
        scatter.bodies.push_back(std::move(body));
      });
  }
  random_ = files.is_random() || report_.triangles_read > 0 || !file_.scatters.empty();
  try {
    parts_ =
        std::make_shared<const SceneParts>(std::move(parts), std::move(scatters), options_.seed, options_.drawn_anew);
  } catch (const Error& error) {
    fail(error.kind() == ErrorKind::argument ? ErrorKind::content : error.kind(), path, ": ", error.what());
  }
}

std::vector<PlacedPart> PartsScene::placed_at(double time, std::uint64_t draw) const {
  std::vector<PlacedPart> all = resting();
  for (PlacedPart& part : others_at(time, draw)) all.push_back(std::move(part));
  return all;
}

std::vector<PlacedPart> PartsScene::others_at(double time, std::uint64_t draw) const {
  try {
    return parts_->others_at(time, draw);
  } catch (const Error& error) {
    fail(error.kind(), file_.path, ": ", error.what());
  }
}

Bounds PartsScene::box_at(double time, std::uint64_t draw) const {
  Bounds box;
  const auto add = [&](const Bounds& of) { box = {box.min.cwiseMin(of.min), box.max.cwiseMax(of.max)}; };
  for (const PlacedPart& part : placed_at(time, draw)) add(part.absent ? Bounds{} : box_of(part));
  for (const auto& [name, tiled] : tiles_) add(tiled.info().box);
  return box;
}

std::vector<PlacedPart> PartsScene::resting() const {
  std::vector<PlacedPart> all;
  for (const PlacedPart& part : parts_->resting())
    if (!tiles_.contains(part.name)) all.push_back(part);
  return all;
}

std::vector<PlacedPart> PartsScene::resting_with_tiles() const {
  std::vector<PlacedPart> all = resting();
  for (const auto& [name, tiled] : tiles_) {
    SceneCloud cloud = tiled.load(tiled.select_all(), 0, options_.threads);
    cloud.part_of.reset();
    all.push_back({name, "", std::make_shared<const SceneCloud>(std::move(cloud)), true});
  }
  return all;
}

LoadedScene PartsScene::whole_at(double time, std::uint64_t draw) const {
  std::vector<PlacedPart> all = resting_with_tiles();
  for (PlacedPart& part : others_at(time, draw)) all.push_back(std::move(part));
  return {merge_parts(all, parts_->materials()), report_};
}

LoadedScene PartsScene::scene_of(const PingSimulator& simulator, const PingEvent& event, std::uint64_t draw,
                                 double memory) const {
  std::vector<PlacedPart> all = placed_at(event.time, draw);
  if (!has_tiles()) return {merge_parts(all, parts_->materials()), report_};
  // The reach of a ping is that of its largest surfels, wherever they are.
  WholeScene whole = all.empty() ? WholeScene{} : whole_of(merge_parts(all));
  for (const auto& [name, tiled] : tiles_) whole = together(whole, tiled.info().whole);
  std::vector<std::string> notes;
  for (const auto& [name, tiled] : tiles_) {
    const TileSelection near = tiled.select(simulator.reach(whole, event));
    require_memory(near, bytes_to_ping, memory, tiled.info().path);
    notes.push_back(fmt::format("{}: {} of {} surfels read, in {} of {} tiles", tiled.info().path, near.surfels,
                                tiled.info().surfels, near.tiles.size(), tiled.info().tiles));
    SceneCloud cloud = tiled.load(near, memory, options_.threads);
    const bool none = cloud.size() == 0;
    all.push_back({name, "", std::make_shared<const SceneCloud>(std::move(cloud)), true});
    all.back().absent = none;
  }
  LoadedScene loaded{merge_parts(all, parts_->materials()), report_};
  loaded.scene.part_of = whole;
  loaded.report.notes.insert(loaded.report.notes.end(), notes.begin(), notes.end());
  return loaded;
}

ordered_json PartsScene::parts_json(double time, std::uint64_t draw) const {
  ordered_json list = ordered_json::array();
  for (const auto& [name, tiled] : tiles_)
    list.push_back(
        {{"name", name}, {"file", tiled.info().path}, {"surfels", tiled.info().surfels}, {"placed", "captured"}});
  for (const PlacedPart& part : placed_at(time, draw)) {
    if (part.absent) continue;
    const std::size_t there = part.surfels.empty() ? part.cloud->size() : part.surfels.size();
    ordered_json json = {{"name", part.name}, {"file", file_of_name(file_of_, part.name)}};
    if (!part.label.empty()) json["label"] = part.label;
    json["surfels"] = there;
    if (part.captured) {
      json["placed"] = "captured";
    } else {
      const PoseAngles at = pose_angles(part.world_from_file());
      json["position_m"] = vector_json(at.position);
      json["yaw_pitch_roll_deg"] = vector_json(Vector3d(degrees(1) * Vector3d(at.yaw, at.pitch, at.roll)));
      json["scale"] = part.scale;
      json["size_m"] = vector_json(part.size);
    }
    if (part.moves()) {
      const Vector3d arm = part.world_from_part.linear() * part.file_origin;
      json["velocity_mps"] = vector_json(part.velocity + part.turn_rate.cross(arm));
      json["turn_deg_per_s"] = vector_json(degrees(1) * part.turn_rate);
    }
    list.push_back(std::move(json));
  }
  return list;
}

}  // namespace insonify
