// SPDX-License-Identifier: BSD-3-Clause
#include "run_scenes/open_scene.hpp"

#include <cmath>
#include <filesystem>
#include <map>
#include <mutex>
#include <utility>

#include <fmt/format.h>

#include "core/error.hpp"
#include "files/sha256.hpp"
#include "run/ping_setup.hpp"
#include "run/run_settings.hpp"
#include "run_scenes/parts_of_pings.hpp"
#include "run_scenes/run_folder.hpp"
#include "run_scenes/scene_source_of.hpp"
#include "run_scenes/stored_levels.hpp"
#include "run_scenes/stored_run.hpp"
#include "sampling/scene_cut.hpp"
#include "scene_io/cloud_field.hpp"
#include "scene_io/describe_file.hpp"
#include "simulate/resolve_ping.hpp"
#include "store/scene_file.hpp"
#include "survey/mesh_source.hpp"

namespace insonify {
namespace {

namespace fs = std::filesystem;

LoadOptions loading_of_file(const SceneOptions& how, const OpenSceneOptions& o) {
  LoadOptions loading = load_options(how, o.draws.seed, o.threads);
  loading.keep_columns = o.keep_columns;
  return loading;
}

/// A cloud or mesh that is in memory whole.
class SceneOfFile : public OpenScene {
 public:
  SceneOfFile(const SceneOptions& how, const OpenSceneOptions& options, const std::string& note)
      : OpenScene(how, options),
        loaded_(std::make_shared<LoadedScene>(load_scene(how.path, loading_of_file(how, options)))) {
    if (!note.empty()) loaded_->report.notes.push_back(note);
  }

  const LoadReport& report() const override { return loaded_->report; }
  Bounds box_at(const SceneMoment&) const override { return bounds(loaded_->scene); }
  std::shared_ptr<const SceneCloud> cloud_at(const SceneMoment&) const override { return {loaded_, &loaded_->scene}; }
  LoadedScene take_whole(const SceneMoment&) override { return std::move(*loaded_); }
  std::shared_ptr<const PreparedScene> shared() const override { return loaded_->mesh ? nullptr : overview(); }
  const LoadedScene* loaded() const override { return loaded_.get(); }
  bool leave_points() override {
    const bool is_field = loaded_->mesh && loaded_->columns.heights;
    if (is_field) loaded_->mesh.reset();
    return is_field;
  }

 private:
  std::shared_ptr<const PreparedScene> surfels_of(const PingSimulator& simulator, const PingEvent& event,
                                                  LoadReport& report, nlohmann::ordered_json*) const override {
    if (!loaded_->mesh) return overview();
    MeshSample fine = mesh_sample_for(*loaded_->mesh, loaded_->scene.size(), options_.memory_limit, simulator, event);
    if (!fine.note.empty()) report.notes.push_back(std::move(fine.note));
    if (!fine.scene) return overview();
    return std::make_shared<const PreparedScene>(std::move(*fine.scene), simulator.options().threads);
  }
  std::vector<Eigen::Vector3d> positions_of(const SceneCloud&, const Pose& pose) const override {
    return sampled_positions(loaded_->scene, pose);
  }
  /// Returns all surfels of a cloud, those of a mesh's overview; prepared when they are first asked for.
  std::shared_ptr<const PreparedScene> overview() const {
    const std::scoped_lock lock(guard_);
    if (!overview_) overview_ = std::make_shared<const PreparedScene>(cloud_at({}), options_.threads);
    return overview_;
  }

  std::shared_ptr<LoadedScene> loaded_;
  mutable std::mutex guard_;
  mutable std::shared_ptr<const PreparedScene> overview_;
};

/// Tiles on disk, or a cloud and its levels, of which each ping reads what it reaches.
class SceneOfTiles : public OpenScene {
 public:
  SceneOfTiles(const SceneOptions& how, const OpenSceneOptions& options, TiledScene tiles)
      : OpenScene(how, options), tiled_(std::move(tiles)) {
    report_.path = how.path;
    report_.format = "insonify tiles";
    report_.meaning.system = {tiled_.info().system, MeaningOrigin::file};
  }

  const LoadReport& report() const override { return report_; }
  const TiledScene* tiles() const override { return &tiled_; }
  Bounds box_at(const SceneMoment&) const override { return tiled_.info().box; }
  std::shared_ptr<const SceneCloud> cloud_at(const SceneMoment&) const override {
    return std::make_shared<const SceneCloud>(load_scene(how_.path, loading_of_file(how_, options_)).scene);
  }
  LoadedScene take_whole(const SceneMoment&) override { return load_scene(how_.path, loading_of_file(how_, options_)); }

 private:
  /// Reads what a ping reaches, or levels of detail as fine as its head resolves.
  std::shared_ptr<const PreparedScene> surfels_of(const PingSimulator& simulator, const PingEvent& event,
                                                  LoadReport& report, nlohmann::ordered_json* json) const override {
    require_no_loading_options(how_, "is prepared already; give it to insonify prepare instead");
    const TiledSceneInfo& info = tiled_.info();
    nlohmann::ordered_json read = {{"surfels", info.surfels}, {"tiles", info.tiles}, {"bytes", info.bytes}};
    if (info.path != how_.path) read["path"] = info.path;
    const double memory = memory_for_tiles(options_.memory_limit);
    const int threads = simulator.options().threads;
    const ResolvedPing ping =
        resolve_ping(info.whole, simulator.head(), event, simulator.environment(), simulator.options(), "ping");
    SceneCloud scene;
    if (merges_surfels({}, ping.options)) {
      const SamplingSettings& sampling = ping.options.sampling;
      const CutOptions cutting{sampling.detail_width, sampling.detail_spacing, ping.view.sampling.range_resolution,
                               threads};
      TiledCut cut = tiled_.cut(ping.region, ping.view.fan, ping.view.gate, cutting, memory / bytes_to_ping);
      scene = std::move(cut.scene);
      report.notes.push_back(fmt::format("{} surfels and nodes of {} surfels, from {} of {} bytes", scene.size(),
                                         info.surfels, cut.bytes, info.bytes));
      read["bytes_read"] = cut.bytes;
    } else {
      const TileSelection selected = tiled_.select(ping.region);
      require_memory(selected, bytes_to_ping, memory, how_.path);
      scene = tiled_.load(selected, memory, threads);
      report.notes.push_back(fmt::format("{} of {} surfels read, in {} of {} tiles", selected.surfels, info.surfels,
                                         selected.tiles.size(), info.tiles));
      read["tiles_read"] = selected.tiles.size();
    }
    report.points_read = scene.size();
    read["surfels_read"] = scene.size();
    if (json) (*json)["tiles"] = std::move(read);
    return std::make_shared<const PreparedScene>(std::move(scene), threads);
  }
  std::vector<Eigen::Vector3d> positions_of(const SceneCloud&, const Pose& pose) const override {
    std::vector<Eigen::Vector3d> positions;
    for (const Eigen::Vector3d& position : tiled_.positions())
      positions.push_back(pose.linear().transpose() * (position - pose.translation()));
    return positions;
  }

  const TiledScene tiled_;
  LoadReport report_;
};

}  // namespace

std::shared_ptr<const PreparedScene> OpenScene::scene_for(const PingSimulator& simulator,
                                                          const PingEvent& event) const {
  LoadReport unused;
  return surfels_of(simulator, event, unused, nullptr);
}

PingScene OpenScene::ping_scene(const PingSimulator& simulator, const PingEvent& event) const {
  PingScene result{nullptr, report(), {}, {}};
  nlohmann::ordered_json more = nlohmann::ordered_json::object();
  result.scene = surfels_of(simulator, event, result.report, &more);
  result.positions = positions_of(result.scene->scene(), event.world_from_head);
  result.json = scene_json(result.report, result.scene->scene());
  result.json.update(more);
  return result;
}

std::vector<Eigen::Vector3d> OpenScene::positions_of(const SceneCloud& pinged, const Pose& pose) const {
  return sampled_positions(pinged, pose);
}

std::shared_ptr<OpenScene> open_scene(const SceneOptions& scene, const OpenSceneOptions& options) {
  const SceneKind kind = kind_of_scene(scene.path);
  if (kind == SceneKind::parts) {
    const auto parts = std::make_shared<PartsOfPings>(scene, options);
    parts->prepare();
    return parts;
  }
  if (kind == SceneKind::tiles) return std::make_shared<SceneOfTiles>(scene, options, TiledScene(scene.path));
  StoredLevels levels = find_levels(scene);
  if (levels.tiles) return std::make_shared<SceneOfTiles>(scene, options, std::move(*levels.tiles));
  return std::make_shared<SceneOfFile>(scene, options, levels.note);
}

std::shared_ptr<OpenScene> StoredRun::open_scene(const SceneOptions& scene, int threads, std::uint64_t seed) const {
  return insonify::open_scene(scene,
                              {kind_of_scene(scene.path) == SceneKind::parts ? draws() : RunDraws{seed, {}}, threads});
}

LoadedScene load_any_scene(const SceneOptions& scene, int threads) {
  return open_scene(scene, {{}, threads})->take_whole({});
}

std::shared_ptr<const SceneSource> scene_source_of(const std::string& path, std::uint64_t seed, int threads) {
  return open_scene({path}, {{seed, {}}, threads});
}

std::shared_ptr<const SceneSource> scene_source_of(const MissionFile& file, int threads) {
  Run pinged = load_mission_settings(file.path);
  pinged.scene.path = file.scene;
  const RunDraws draws{file.seed, {file.randomise.scene_pings, 0}};
  return open_scene(pinged.scene, {draws, threads, pinged.memory_limit, false});
}

std::optional<TiledScene> find_tiles(const std::string& path) {
  return kind_of_scene(path) == SceneKind::tiles ? std::optional<TiledScene>(std::in_place, path) : std::nullopt;
}

Bounds box_of_scene(const std::string& path) {
  if (const auto tiled = find_tiles(path)) return tiled->info().box;
  if (kind_of_scene(path) == SceneKind::parts) {
    const PartsOfPings parts({path}, {.drawn_at_will = false});
    return parts.box_at({parts.scene().begin(), 0});
  }
  const FileDescription cloud = describe_file(path);
  return {cloud.min, cloud.max};
}

std::string digest_of_scene(const std::string& path) {
  if (kind_of_scene(path) == SceneKind::parts) {
    Sha256 sha;
    std::map<std::string, std::string> digests;
    for (const std::string& file : files_of(load_scene_file(path))) {
      std::string& digest = digests[file];
      if (digest.empty())
        digest = kind_of_scene(file) == SceneKind::parts ? sha256_of_file(file) : digest_of_scene(file);
      sha.add(fs::path(file).filename().string() + ":" + digest + "\n");
    }
    return sha.digest();
  }
  const auto tiled = find_tiles(path);
  return tiled ? sha256_of(std::to_string(tiled->info().checksum)) : sha256_of_file(path);
}

SceneInstances instances_of_scene(const std::string& path) {
  if (kind_of_scene(path) != SceneKind::file || !has_cloud_field(path, "instance")) return {};
  const CloudField field = load_cloud_field(path, "instance");
  std::vector<std::pair<std::uint32_t, std::uint32_t>> given;
  for (std::size_t i = 0; i < field.value.size(); ++i)
    if (const double value = field.value[i]; value >= 1 && value < 4294967295.0 && value == std::floor(value))
      given.emplace_back(field.id[i], static_cast<std::uint32_t>(value));
  return number_instances(given);
}

std::string loading_option(const SceneOptions& o) {
  SceneOptions given = o, none;
  none.path = o.path;
  const auto settings = scene_settings(given), defaults = scene_settings(none);
  for (std::size_t i = 0; i < settings.size(); ++i)
    if (settings_as_toml({settings[i]}) != settings_as_toml({defaults[i]})) return settings[i].option;
  return {};
}

void require_no_loading_options(const SceneOptions& o, const std::string& why) {
  if (const std::string option = loading_option(o); !option.empty())
    fail(ErrorKind::argument, option, ": ", o.path, " ", why);
}

}  // namespace insonify
