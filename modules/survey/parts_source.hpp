// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

#include "scene/posed_scene.hpp"
#include "survey/scene_parts.hpp"
#include "survey/scene_source.hpp"

namespace insonify {

/// A scene of parts for the pings of a survey: what rests is prepared once for each ping that is under way at a time,
/// what moves is placed by the time of the ping, what is drawn by its number.
class PartsSource : public SceneSource {
 public:
  /// `pings_per_draw`: bodies are drawn anew every so many pings of a head; 0: once. threads: of preparing, 0: all
  /// cores. Throws as PosedScene.
  /// `prepare`: one at once, so that what is wrong is known; else each when it is needed.
  explicit PartsSource(std::shared_ptr<const SceneParts> parts, std::int64_t pings_per_draw = 0, int threads = 0,
                       bool prepare = true);

  /// Returns the scene at the time of the event; it may be given back by any thread. Throws as SceneParts::others_at.
  std::shared_ptr<const PreparedScene> scene_for(const PingSimulator& simulator, const PingEvent& event) const override;
  /// Returns the number of the draw for a ping.
  std::uint64_t draw_of(const PingEvent& event) const;
  /// Returns the parts that move or are drawn, at the time of the event.
  std::vector<PlacedPart> others_of(const PingEvent& event) const {
    return parts_->others_at(event.time, draw_of(event));
  }

 private:
  struct Pool {
    std::mutex guard;
    std::vector<std::unique_ptr<PosedScene>> idle;
  };
  struct Loan;
  std::unique_ptr<PosedScene> take() const;

  std::shared_ptr<const SceneParts> parts_;
  std::int64_t pings_per_draw_;
  int threads_;
  std::shared_ptr<Pool> pool_;  ///< shared with the scenes that are out
};

}  // namespace insonify
