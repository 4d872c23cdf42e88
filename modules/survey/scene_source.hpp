// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <memory>

#include "scene/prepared_scene.hpp"
#include "simulate/ping_simulator.hpp"

namespace insonify {

/// A source of the scenes of pings: one scene in memory, or the part of a larger scene that each ping needs.
class SceneSource {
 public:
  virtual ~SceneSource() = default;
  /// Returns the scene for this ping: the whole scene, or at least the part that simulator.reach names. Several threads
  /// may call it at once.
  virtual std::shared_ptr<const PreparedScene> scene_for(const PingSimulator& simulator,
                                                         const PingEvent& event) const = 0;
};

/// The source of one scene for all pings.
class SceneInMemory : public SceneSource {
 public:
  /// Prepares the scene with `threads` threads (0: all cores). Throws Error for an invalid scene.
  explicit SceneInMemory(SceneCloud scene, int threads = 0)
      : scene_(std::make_shared<PreparedScene>(std::move(scene), threads)) {}
  /// Returns the scene given to the constructor.
  std::shared_ptr<const PreparedScene> scene_for(const PingSimulator&, const PingEvent&) const override {
    return scene_;
  }

 private:
  std::shared_ptr<const PreparedScene> scene_;
};

}  // namespace insonify
