// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include "core/error.hpp"
#include "files/sha256.hpp"
#include "run/run_settings.hpp"
#include "run/scene_reach.hpp"
#include "run_scenes/parts_of_pings.hpp"
#include "run_scenes/scene_source_of.hpp"
#include "run_scenes/stored_levels.hpp"
#include "store/environment_file.hpp"
#include "store/material_library.hpp"
#include "tool/run/world_reference.hpp"
#include "tool/survey/survey.hpp"

namespace insonify::tool {
namespace {

constexpr std::size_t most_block_bytes = std::size_t{32} << 20, most_block_pings = 64;
constexpr std::size_t most_covering_pings = 16;  // each lists every surfel that it insonifies

/// Pings of a block: as asked for, as a survey that was begun has them, or as many as fill the bytes of a block.
std::size_t block_size(const SurveyOptions& o, const SurveyRun& begun, const std::string& head, std::size_t ping_bytes,
                       bool coverage) {
  if (o.pings_per_block > 0) return static_cast<std::size_t>(o.pings_per_block);
  for (const SurveyRunHead& there : begun.heads)
    if (there.name == head) return there.pings_per_block;
  return std::clamp<std::size_t>(most_block_bytes / ping_bytes, 1, coverage ? most_covering_pings : most_block_pings);
}

/// Throws Error(content) "file: head 'name', ping i at t s: ..." about a ping.
template <typename... Parts>
[[noreturn]] void refuse_ping(const SurveySetup& s, const SurveyPing& ping, const Parts&... parts) {
  fail(ErrorKind::content, s.file.path, ": head '", s.file.mission.heads[ping.head].name, "', ping ", ping.number,
       " at ", ping.time, " s: ", parts...);
}

/// Adds the scene file to what `body` refuses.
template <typename Body>
void at_scene_file(const std::string& path, const Body& body) {
  try {
    body();
  } catch (const Error& error) {
    fail(error.kind(), path, ": ", error.what());
  }
}

/// A sentence about pings that gaps of the trajectory leave out; empty if there are none.
std::string gap_note(const SurveySetup& s) {
  const Mission& mission = s.survey->mission();
  if (mission.random_pings > 0) return {};
  Mission flown = mission;
  flown.max_gap = std::numeric_limits<double>::infinity();
  const std::vector<SurveyPing> all = survey_pings(flown);
  TrajectoryGap longest{};
  std::size_t left_out = 0;
  for (const SurveyPing& ping : all)
    if (const auto gap = gap_at(mission.trajectory, ping.time, mission.max_gap)) {
      ++left_out;
      if (gap->to - gap->from > longest.to - longest.from) longest = *gap;
    }
  if (left_out == 0) return {};
  return fmt::format(
      "{}: {} of {} pings lie in gaps of more than {:g} s and are left out; the longest is from {:g} to {:g} s. "
      "max_gap_s = {:g} in [trajectory] flies over it in a straight line",
      s.file.trajectory, left_out, all.size(), mission.max_gap, longest.from, longest.to, longest.to - longest.from);
}

/// Throws Error(content) for a mission whose anchor cannot be that of its way.
void require_anchored(const SurveySetup& s) {
  if (!s.file.anchor) return;
  std::vector<Eigen::Vector3d> ends{s.file.random_poses.low, s.file.random_poses.high};
  if (s.file.mission.random_pings == 0)
    ends = {s.file.mission.trajectory.pose.front().translation(), s.file.mission.trajectory.pose.back().translation()};
  at_scene_file(s.file.path, [&] {
    for (const Eigen::Vector3d& end : ends) require_plausible(Georeference{{}, *s.file.anchor}, end, "[survey.anchor]");
  });
}

void require_in_water(const SurveySetup& s) {
  for (const SurveyPing& ping : s.survey->pings()) {
    const Environment environment = s.survey->environment_of(ping);
    const double z = event_of(s.file.mission, ping).world_from_head.translation().z();
    if (const auto surface = surface_height(environment); surface && z >= *surface)
      refuse_ping(s, ping, "is at z = ", z, " m, above the sea surface at ", *surface,
                  " m; lower the trajectory or the box, or give surface.height_m in the frame of the scene");
    try {
      environment_at(environment, z, "environment");
    } catch (const Error& error) {
      refuse_ping(s, ping, error.what());
    }
    if (environment.bottom && z <= environment.bottom->height)
      refuse_ping(s, ping, "is at z = ", z, " m, below the bottom at ", environment.bottom->height, " m");
  }
}

/// Pings of heads that look down from beside a scene, where it has no bed below them.
struct PingsOutside {
  std::size_t all = 0, beside = 0;
  double farthest = 0;  // [m]

  void add(const Pose& head, const Bounds& box) {
    constexpr double steep = -0.7;  // z of the axis of a head, below which the head looks down
    const Eigen::Vector2d at = head.translation().head<2>();
    const double away = (at - at.cwiseMax(box.min.head<2>()).cwiseMin(box.max.head<2>())).norm();
    ++all;
    if (away > 0 && head.linear()(2, 0) < steep) ++beside, farthest = std::max(farthest, away);
  }
  std::string note() const {
    if (beside == 0) return {};
    return fmt::format(
        "{} of {} pings look down from beside the scene, up to {:.3g} m off its bounds, where it has no bed; move the "
        "way over the scene, or make these parts a transit (active = false)",
        beside, all, farthest);
  }
};

/// Digest of the mission and of all files that its result depends on.
std::string digest_of(const SurveySetup& s) {
  Sha256 sha;
  const auto add = [&](const std::string& part) { sha.add(std::to_string(part.size()) + ":" + part); };
  for (const std::string& part : {std::string(INSONIFY_VERSION), s.file.text, digest_of_scene(s.file.scene)}) add(part);
  if (const StoredLevels levels = find_levels(s.heads.front().run.scene); levels.tiles)
    add(std::to_string(levels.tiles->info().checksum));
  for (const std::string& path : {s.file.trajectory, s.heads.front().run.scene.materials_file})
    if (!path.empty()) add(sha256_of_file(path_of_materials(path)));
  if (!s.file.water.tide.empty()) add(sha256_of_file(s.file.water.tide));
  for (const MissionHead& head : s.file.mission.heads)  // the mounting may be that of the sonar file
    add(std::string(reinterpret_cast<const char*>(head.vehicle_from_head.data()), 16 * sizeof(double)));
  for (const PingSetup& head : s.heads) add(environment_as_toml(head.environment) + sonar_as_toml(head.spec));
  return sha.digest();
}

}  // namespace

std::size_t image_bytes(const PingSetup& ping) {
  constexpr std::size_t level_bytes = 2, pressure_bytes = 8, label_bytes = 6;
  const SonarHead& head = ping.head;
  const auto cells = static_cast<std::size_t>(ping.simulation.outputs.display_bins);
  const std::size_t samples = head.fan.beams() * (cells > 0 ? cells : head.gate.bins());
  return samples * ((cells > 0 ? level_bytes : pressure_bytes) + (ping.simulation.outputs.labels ? label_bytes : 0));
}

SurveySetup set_up_survey(const SurveyOptions& o) {
  SurveySetup s;
  s.file = load_mission(o.mission);
  Mission& mission = s.file.mission;
  const SurveyRun begun = is_survey_run(o.output) ? load_survey_run(o.output) : SurveyRun{};
  std::vector<std::size_t> per_block;
  for (std::size_t h = 0; h < mission.heads.size(); ++h) {
    s.heads.push_back(set_up_survey_head(s.file, h, o.common.threads));
    const PingSetup& head = s.heads.back();
    mission.heads[h].listening_time = listening_time_of(mission.heads[h], head.head, head.environment);
    per_block.push_back(block_size(o, begun, mission.heads[h].name, image_bytes(head), s.file.coverage));
  }
  std::vector<PingSimulator> simulators;
  for (const PingSetup& head : s.heads) simulators.push_back(head.simulator());
  try {
    s.survey.emplace(mission, simulators, SurveySettings{s.file.randomise, s.file.seed, s.file.coverage});
  } catch (const Error& error) {
    fail(ErrorKind::content, s.file.path, ": ", error.what());
  }
  if (std::string note = gap_note(s); !note.empty()) s.notes.push_back(std::move(note));
  require_anchored(s);
  if (s.file.mission.random_pings == 0) require_in_water(s);  // else when the poses are drawn
  for (const PingSetup& head : s.heads)
    if (s.file.randomise.noise_db > 0 && !(head.simulation.effects.noise && head.environment.self_noise_db))
      fail(ErrorKind::content, s.file.path,
           ": [randomise] noise_db changes the noise of platform and electronics: give ",
           "noise = true in [ping] and self_noise_db in the environment, or leave it out");
  const std::vector<SurveyPing>& pings = s.survey->pings();
  s.blocks = survey_blocks(pings, per_block);
  for (std::size_t h = 0; h < mission.heads.size(); ++h) {
    const auto count = std::count_if(pings.begin(), pings.end(), [h](const SurveyPing& p) { return p.head == h; });
    if (count > 0) s.run.heads.push_back({mission.heads[h].name, static_cast<std::size_t>(count), per_block[h]});
  }
  s.run.mission_sha256 = digest_of(s);
  return s;
}

void decide_detail(const SceneSource& scene, int threads, SurveySetup& setup) {
  setup.survey = setup.survey->decided(scene, threads);
  for (std::size_t h = 0; h < setup.heads.size(); ++h) {
    Choice& detail = setup.heads[h].simulation.sampling.detail;
    record_detail(detail, setup.survey->options_of(h).sampling.detail, setup.heads[h].run);
    detail = setup.survey->options_of(h).sampling.detail;
  }
}

namespace {

/// Throws Error(content) for what a mission asks of a scene of parts in vain.
void require_parts_fit(const SurveySetup& setup, const PartsOfPings& parts, double first, double last) {
  const MissionFile& file = setup.file;
  if (file.coverage)
    fail(ErrorKind::content, file.path, ": coverage counts the pings of each surfel of one cloud, but ", file.scene,
         " is a scene of parts; leave coverage out");
  if (file.randomise.scene_pings > 0 && parts.file().scatters.empty())
    fail(ErrorKind::content, file.path, ": [randomise] scene draws the bodies of [[scatter]] anew, but ", file.scene,
         " has none; leave it out");
  at_scene_file(file.scene, [&] { parts.scene().require_times(first, last); });
}

/// Has each surfel counted that coverage counts. Throws Error(content) for a mesh.
void count_surfels(const SurveySetup& setup, OpenScene& scene, RunObserver& observer) {
  if (!setup.file.coverage) return;
  if (scene.leave_points())
    observer.note(setup.file.scene +
                  ": coverage counts its points, so they are pinged, and not the surface between them");
  if (scene.loaded() && scene.loaded()->mesh)
    fail(ErrorKind::content, setup.file.path,
         ": coverage counts the pings of each surfel, but a mesh has other ones in ", "every ping; make surfels of ",
         setup.file.scene, " by insonify prepare --mesh-spacing METRES, or leave coverage out");
}

/// Throws Error(content) for a ping out of reach of the scene; notes what fits it badly.
void require_reach(const SurveySetup& setup, const Bounds& box, RunObserver& observer) {
  std::vector<double> farthest(setup.heads.size());
  std::vector<PingsOutside> outside(setup.heads.size());
  std::vector<Eigen::Vector3d> lowest(setup.heads.size(), Eigen::Vector3d::Constant(1e300));
  for (const SurveyPing& ping : setup.survey->pings()) {
    const Pose pose = event_of(setup.file.mission, ping).world_from_head;
    const Eigen::Vector3d at = pose.translation();
    outside[ping.head].add(pose, box);
    if (at.z() < lowest[ping.head].z()) lowest[ping.head] = at;
    const double away = (at - at.cwiseMax(box.min).cwiseMin(box.max)).norm();
    const double reach = setup.heads[ping.head].head.gate.max_range;
    if (away > reach)
      refuse_ping(setup, ping, "is ", away, " m from the scene, beyond its max range of ", reach,
                  " m; is the trajectory in another frame, or should this be a transit (active = false)?");
    farthest[ping.head] = std::max(farthest[ping.head], reach_of(box, at, setup.heads[ping.head].environment));
  }
  for (std::size_t h = 0; h < setup.heads.size(); ++h)
    for (const std::string& note : {far_range_note(setup.heads[h], farthest[h]),
                                    shallow_profile_note(setup.heads[h], box, lowest[h]), outside[h].note()})
      if (!note.empty()) observer.note("head " + setup.file.mission.heads[h].name + ": " + note);
}

}  // namespace

std::shared_ptr<const OpenScene> open_survey_scene(SurveySetup& setup, const CommonOptions& common,
                                                   RunObserver& observer) {
  const MissionFile& file = setup.file;
  const Run& pinged = setup.heads.front().run;
  const RunDraws draws{file.seed, {file.randomise.scene_pings, 0}};
  const auto scene = open_scene(pinged.scene, {draws, common.threads, pinged.memory_limit, false});
  double first = std::numeric_limits<double>::infinity(), last = -first;
  for (const SurveyPing& ping : setup.survey->pings())
    first = std::min(first, ping.time), last = std::max(last, ping.time);
  if (scene->parts())
    require_parts_fit(setup, *scene->parts(), first, last);
  else if (file.randomise.scene_pings > 0)
    fail(ErrorKind::content, file.path, ": [randomise] scene draws bodies of a scene of parts, which ", file.scene,
         " is not; leave it out");
  for (const std::string& note : loading_notes(scene->report())) observer.note(note);
  count_surfels(setup, *scene, observer);
  require_same_system(file.path, file.anchor, file.system, scene->report().meaning.system.value);
  if (file.random_poses.pings > 0) {
    draw_poses(setup.file, *scene);
    setup.survey = setup.survey->with_poses(file.mission.poses);
    require_in_water(setup);
  }
  require_reach(setup, scene->box_at({first, 0}), observer);
  return scene;
}

}  // namespace insonify::tool
