// SPDX-License-Identifier: BSD-3-Clause
// Random poses of a vehicle over a scene of any kind.
#include <utility>

#include "core/error.hpp"
#include "run_scenes/parts_of_pings.hpp"
#include "run_scenes/scene_source_of.hpp"
#include "scene/ground.hpp"
#include "survey/randomise.hpp"

namespace insonify {
namespace {

/// Returns the surfels of tiles beneath the box of a rule: those within a ball that holds it and the bed below.
SceneCloud tiles_below(const TiledScene& tiles, const RandomPoses& rule) {
  const Bounds& bed = tiles.info().box;
  Eigen::Vector3d low = rule.low, high = rule.high;
  low.z() = std::min(low.z(), bed.min.z()), high.z() = std::max(high.z(), bed.max.z());
  const double radius = (high - low).norm() / 2 + rule.clearance;
  return tiles.load(tiles.select(region_around((low + high) / 2, radius)));
}

/// The ground below a vehicle at any ping of a scene.
class GroundOfPings {
 public:
  GroundOfPings(const OpenScene& scene, const RandomPoses& rule) : scene_(scene) {
    if (rule.clearance == 0) return;
    if (const PartsOfPings* parts = scene.parts()) {
      parts_ = &parts->scene();
      for (const PlacedPart& part : parts->resting_with_tiles()) add(part, resting_);
      return;
    }
    PlacedPart all{.name = "scene", .captured = true};
    all.cloud =
        scene.tiles() ? std::make_shared<const SceneCloud>(tiles_below(*scene.tiles(), rule)) : scene.cloud_at({});
    add(all, resting_);
  }

  /// Returns the ground at the time and with the draw of a ping.
  Ground at(const PingEvent& event) const {
    Ground ground = resting_;
    if (!parts_ || parts_->still()) return ground;
    const SceneMoment moment = scene_.moment_of(event.time, event.number);
    for (const PlacedPart& part : parts_->others_at(moment.time, moment.draw)) add(part, ground);
    return ground;
  }

 private:
  static void add(const PlacedPart& part, Ground& ground) {
    if (!part.absent && part.cloud && part.cloud->size() > 0) ground.add(part);
  }

  const OpenScene& scene_;
  const SceneParts* parts_ = nullptr;
  Ground resting_;
};

}  // namespace

void draw_poses(MissionFile& file, const SceneSource& scene) {
  if (file.random_poses.pings == 0) return;
  const auto* open = dynamic_cast<const OpenScene*>(&scene);
  if (!open) fail(ErrorKind::argument, "draw_poses: the scene must be one that scene_source_of has opened");
  const GroundOfPings ground(*open, file.random_poses);
  std::vector<Pose> poses;
  for (std::int64_t number = 0; number < file.random_poses.pings; ++number) {
    const SurveyPing ping{0, number, static_cast<double>(number), 0, 0};
    try {
      const Ground below = ground.at({{}, {}, ping.time, random_stream_of(ping)});
      poses.push_back(drawn_pose(file.random_poses, file.seed, number, below));
    } catch (const Error& error) {
      fail(error.kind(), file.path, ": [randomise.pose] ", error.what());
    }
  }
  file.mission.poses = std::move(poses);
}

}  // namespace insonify
