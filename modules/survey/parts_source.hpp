// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "scene/posed_pool.hpp"
#include "survey/scene_parts.hpp"
#include "survey/scene_source.hpp"

namespace insonify {

/// The values that determine the positions of the parts of a scene.
struct SceneMoment {
  double time = 0;         ///< [s]
  std::uint64_t draw = 0;  ///< number of the draw of the scattered bodies
  bool operator==(const SceneMoment&) const = default;
};

/// The rule for the draw of each ping.
struct DrawRule {
  std::int64_t pings_per_draw = 0;  ///< pings of a head between draws; 0: all pings have `draw`
  std::uint64_t draw = 0;
};
/// Returns the moment of a ping: its time, and the draw that follows from its number among the pings of its head.
SceneMoment moment_of(const DrawRule& rule, double time, std::int64_t number);

/// A scene of parts for many pings. Resting parts are prepared once for each scene that is in use at the same time.
/// Moving parts are placed by the time of the ping, drawn bodies by its draw. Several threads may ask at once.
class PartsSource : public SceneSource {
 public:
  /// Keeps the parts, and prepares scenes with `threads` threads (0: all cores). With `prepare`, the constructor
  /// prepares the first scene, so that errors appear there; otherwise each scene is prepared when it is needed.
  /// `resting` replaces parts->resting(). Throws as PosedScene.
  explicit PartsSource(std::shared_ptr<const SceneParts> parts, const DrawRule& rule = {}, int threads = 0,
                       bool prepare = true, std::optional<std::vector<PlacedPart>> resting = {});

  /// Returns scene_at of the moment of the event.
  std::shared_ptr<const PreparedScene> scene_for(const PingSimulator& simulator, const PingEvent& event) const override;
  /// Returns the scene at a moment: one that is in use if the poses of its parts are the same. Any thread may release
  /// it. Throws as SceneParts::others_at.
  std::shared_ptr<const PreparedScene> scene_at(const SceneMoment& moment) const;
  /// Returns the moment of a ping.
  SceneMoment moment_for(const PingEvent& event) const { return moment_of(rule_, event.time, event.number); }

 private:
  std::shared_ptr<const SceneParts> parts_;
  DrawRule rule_;
  PosedPool<SceneMoment> pool_;
};

}  // namespace insonify
