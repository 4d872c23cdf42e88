// SPDX-License-Identifier: BSD-3-Clause
#include "run_scenes/parts_of_pings.hpp"

#include "core/error.hpp"
#include "files/memory_limit.hpp"
#include "run/ping_setup.hpp"
#include "run_scenes/run_folder.hpp"

namespace insonify {
namespace {

constexpr const char* says_itself = "says itself how each part is read; give it there";

PartsOptions loading_of(const OpenSceneOptions& o) {
  return {.seed = o.draws.seed, .threads = o.threads, .drawn_anew = o.drawn_at_will || o.draws.rule.pings_per_draw > 0};
}

/// Adds the scene file to what `body` refuses.
template <typename Body>
auto with_file(const PartsScene& scene, const Body& body) {
  try {
    return body();
  } catch (const Error& error) {
    fail(error.kind(), scene.file().path, ": ", error.what());
  }
}

}  // namespace

double memory_for_tiles(double limit_gib) { return limit_gib > 0 ? limit_gib * (1 << 30) : available_memory(); }

PartsOfPings::PartsOfPings(const SceneOptions& how, const OpenSceneOptions& options)
    : OpenScene(how, options), scene_((require_no_loading_options(how, says_itself), how.path), loading_of(options)) {
  if (!scene_.has_tiles()) source_.emplace(scene_.parts(), options.draws.rule, options.threads);
}

std::shared_ptr<const PreparedScene> PartsOfPings::shared() const {
  return !scene_.has_tiles() && scene_.parts()->still() ? whole_at({}) : nullptr;
}

std::shared_ptr<const PreparedScene> PartsOfPings::scene_for(const PingSimulator& simulator,
                                                             const PingEvent& event) const {
  const SceneMoment moment = moment_of(event.time, event.number);
  if (source_) return with_file(scene_, [&] { return source_->scene_at(moment); });
  LoadedScene near = scene_.scene_of(simulator, event, moment.draw, memory_for_tiles(options_.memory_limit));
  return std::make_shared<PreparedScene>(std::move(near.scene), simulator.options().threads);
}

PingScene PartsOfPings::ping_scene(const PingSimulator& simulator, const PingEvent& event) const {
  const SceneMoment moment = moment_of(event.time, event.number);
  PingScene result{nullptr, report(), {}, {}};
  if (scene_.has_tiles()) {
    LoadedScene near = scene_.scene_of(simulator, event, moment.draw, memory_for_tiles(options_.memory_limit));
    result.report = std::move(near.report);
    result.scene = std::make_shared<const PreparedScene>(std::move(near.scene), simulator.options().threads);
  } else {
    result.scene = whole_at(moment);
  }
  result.positions = sampled_positions(result.scene->scene(), event.world_from_head);
  result.json = scene_json(result.report, result.scene->scene());
  result.json["parts"] = scene_.parts_json(moment.time, moment.draw);
  return result;
}

std::shared_ptr<const PreparedScene> PartsOfPings::whole_at(const SceneMoment& moment) const {
  if (source_) return with_file(scene_, [&] { return source_->scene_at(moment); });
  {
    const std::scoped_lock lock(guard_);
    if (!whole_)
      whole_.emplace(scene_.parts(), options_.draws.rule, options_.threads, true, scene_.resting_with_tiles());
  }
  return with_file(scene_, [&] { return whole_->scene_at(moment); });
}

std::shared_ptr<const SceneCloud> PartsOfPings::cloud_at(const SceneMoment& moment) const {
  const std::shared_ptr<const PreparedScene> whole = whole_at(moment);
  return {whole, &whole->scene()};
}

}  // namespace insonify
