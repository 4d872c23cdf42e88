// SPDX-License-Identifier: BSD-3-Clause
#include "run_scenes/parts_of_pings.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "core/units.hpp"
#include "files/memory_limit.hpp"
#include "run/ping_setup.hpp"
#include "scene/posed_scene.hpp"
#include "survey/mesh_source.hpp"

namespace insonify {
namespace {

using Eigen::Vector3d;
using nlohmann::ordered_json;

/// Adds the scene file, perhaps with a line, to what `body` refuses; what was wrong with an argument is wrong with the
/// file, unless it stays as `of_argument`.
template <typename Body>
auto in_scene_file(const std::string& where, const Body& body, ErrorKind of_argument = ErrorKind::content) {
  try {
    return body();
  } catch (const Error& error) {
    fail(error.kind() == ErrorKind::argument ? of_argument : error.kind(), where, ": ", error.what());
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

constexpr const char* says_itself = "says itself how each part is read; give it there";

}  // namespace

double memory_for_tiles(double limit_gib) { return limit_gib > 0 ? limit_gib * (1 << 30) : available_memory(); }

SceneBody PartsOfPings::load_body(const PartFile& file, const std::string& name, bool captured, PartFiles& files) {
  file_of_[name] = file.path;
  SceneBody body = file.kind == SceneKind::tiles && captured ? read_ground(file, name) : files.body_of(file, captured);
  body.name = name;
  return body;
}

/// Reads the ground of captured tiles beneath what is to rest: a ball that holds all of it.
SceneBody PartsOfPings::read_ground(const PartFile& file, const std::string& name) {
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

PartsOfPings::PartsOfPings(const SceneOptions& how, const OpenSceneOptions& options)
    : OpenScene(how, options), file_((require_no_loading_options(how, says_itself), load_scene_file(how.path))) {
  const std::string& path = file_.path;
  const auto at_line = [&](int line, const auto& body) { in_scene_file(path + ":" + std::to_string(line), body); };
  report_.path = path, report_.format = "insonify scene of parts";
  PartFiles files(options_, report_);
  std::vector<PartDefinition> parts;
  for (const ScenePartEntry& entry : file_.parts)
    at_line(entry.file.line, [&] {
      SceneBody body = load_body(entry.file, entry.name, entry.placement.captured, files);
      body.label = entry.label;
      parts.push_back({std::move(body), entry.placement});
    });
  std::vector<SceneScatter> scatters;
  for (const SceneScatterEntry& entry : file_.scatters) {
    SceneScatter& scatter = scatters.emplace_back();
    scatter.rule = entry.rule;
    for (std::size_t f = 0; f < entry.files.size(); ++f)
      at_line(entry.line, [&] {
        SceneBody body = load_body(entry.files[f], entry.names[f], false, files);
        body.label = entry.labels[f];
        scatter.bodies.push_back(std::move(body));
      });
  }
  random_ = files.is_random() || report_.triangles_read > 0 || !file_.scatters.empty();
  const RunDraws& draws = options_.draws;
  const bool drawn_anew = options_.drawn_at_will || draws.rule.pings_per_draw > 0;
  parts_ = in_scene_file(path, [&] {
    return std::make_shared<const SceneParts>(std::move(parts), std::move(scatters), draws.seed, drawn_anew);
  });
}

void PartsOfPings::prepare() const {
  if (!has_tiles()) whole();
}

std::vector<PlacedPart> PartsOfPings::placed_at(const SceneMoment& moment) const {
  std::vector<PlacedPart> all = resting();
  for (PlacedPart& part : others_at(moment)) all.push_back(std::move(part));
  return all;
}

std::vector<PlacedPart> PartsOfPings::others_at(const SceneMoment& moment) const {
  const auto others = [&] { return parts_->others_at(moment.time, moment.draw); };
  return in_scene_file(file_.path, others, ErrorKind::argument);
}

Bounds PartsOfPings::box_at(const SceneMoment& moment) const {
  Bounds box;
  const auto add = [&](const Bounds& of) { box = {box.min.cwiseMin(of.min), box.max.cwiseMax(of.max)}; };
  for (const PlacedPart& part : placed_at(moment)) add(part.absent ? Bounds{} : box_of(part));
  for (const auto& [name, tiled] : tiles_) add(tiled.info().box);
  return box;
}

std::vector<PlacedPart> PartsOfPings::resting() const {
  std::vector<PlacedPart> all;
  for (const PlacedPart& part : parts_->resting())
    if (!tiles_.contains(part.name)) all.push_back(part);
  return all;
}

std::vector<PlacedPart> PartsOfPings::resting_with_tiles() const {
  std::vector<PlacedPart> all = resting();
  for (const auto& [name, tiled] : tiles_) {
    SceneCloud cloud = tiled.load(tiled.select_all(), 0, options_.threads);
    cloud.part_of.reset();
    all.push_back({name, "", std::make_shared<const SceneCloud>(std::move(cloud)), true});
  }
  return all;
}

LoadedScene PartsOfPings::take_whole(const SceneMoment& moment) {
  std::vector<PlacedPart> all = resting_with_tiles();
  for (PlacedPart& part : others_at(moment)) all.push_back(std::move(part));
  return {merge_parts(all, parts_->materials()), report_};
}

std::shared_ptr<const PreparedScene> PartsOfPings::surfels_of(const PingSimulator& simulator, const PingEvent& event,
                                                              LoadReport& report, ordered_json* json) const {
  const SceneMoment moment = moment_of(event.time, event.number);
  if (json) (*json)["parts"] = parts_json(moment);
  if (!has_tiles()) return whole_at(moment);
  const double memory = memory_for_tiles(options_.memory_limit);
  std::vector<PlacedPart> all = placed_at(moment);
  // The reach of a ping is that of its largest surfels, wherever they are.
  WholeScene whole = all.empty() ? WholeScene{} : whole_of(merge_parts(all));
  for (const auto& [name, tiled] : tiles_) whole = together(whole, tiled.info().whole);
  for (const auto& [name, tiled] : tiles_) {
    const TileSelection near = tiled.select(simulator.reach(whole, event));
    require_memory(near, bytes_to_ping, memory, tiled.info().path);
    report.notes.push_back(fmt::format("{}: {} of {} surfels read, in {} of {} tiles", tiled.info().path, near.surfels,
                                       tiled.info().surfels, near.tiles.size(), tiled.info().tiles));
    SceneCloud cloud = tiled.load(near, memory, options_.threads);
    const bool none = cloud.size() == 0;
    all.push_back({name, "", std::make_shared<const SceneCloud>(std::move(cloud)), true});
    all.back().absent = none;
  }
  SceneCloud near = merge_parts(all, parts_->materials());
  near.part_of = whole;
  return std::make_shared<PreparedScene>(std::move(near), simulator.options().threads);
}

std::shared_ptr<const PreparedScene> PartsOfPings::shared() const {
  return !has_tiles() && parts_->still() ? whole_at({}) : nullptr;
}

const PartsSource& PartsOfPings::whole() const {
  const std::scoped_lock lock(guard_);
  if (!whole_) {
    auto resting = has_tiles() ? std::optional(resting_with_tiles()) : std::nullopt;
    whole_.emplace(parts_, options_.draws.rule, options_.threads, true, std::move(resting));
  }
  return *whole_;
}

std::shared_ptr<const PreparedScene> PartsOfPings::whole_at(const SceneMoment& moment) const {
  const PartsSource& source = whole();
  return in_scene_file(
      file_.path, [&] { return source.scene_at(moment); }, ErrorKind::argument);
}

std::shared_ptr<const SceneCloud> PartsOfPings::cloud_at(const SceneMoment& moment) const {
  const std::shared_ptr<const PreparedScene> whole = whole_at(moment);
  return {whole, &whole->scene()};
}

ordered_json PartsOfPings::parts_json(const SceneMoment& moment) const {
  ordered_json list = ordered_json::array();
  for (const auto& [name, tiled] : tiles_)
    list.push_back(
        {{"name", name}, {"file", tiled.info().path}, {"surfels", tiled.info().surfels}, {"placed", "captured"}});
  for (const PlacedPart& part : placed_at(moment)) {
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
